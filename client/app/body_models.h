#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "client/model/local_world.h"
#include "client/render/hull_models.h"
#include "client/render/render_frame.h"

/// What the bodies of a session look like.
namespace onesea::client {

/// Keeps a model for each body that it has seen lately. One thread.
///
/// Streams say shape and name, no looks: a box is drawn as a boat, a raft or a crate by its name
/// ("boat", "raft"; else a crate), a cylinder as a buoy ("buoy") or a drum, a sphere as a fender.
/// Capsules and meshes aren't drawn.
class BodyModels {
 public:
  /// The bodies at `time`, ready to be drawn; the one of `own` as that says, if there is one.
  std::vector<render::HullInstance> At(const WorldView& world, SimTime time,
                                       const std::optional<wire::BodyState>& own = std::nullopt);

 private:
  struct Model {
    render::SharedHullMesh mesh;  // null: isn't drawn
    Vec3d origin_m;               // of the mesh, in the body frame
  };
  static Model MakeModel(const wire::BodyInfo& info);

  std::map<std::shared_ptr<const wire::BodyInfo>, Model> models_;
};

}  // namespace onesea::client
