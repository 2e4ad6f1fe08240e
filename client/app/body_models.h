#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "client/app/mesh_fetcher.h"
#include "client/model/local_world.h"
#include "client/render/hull_models.h"
#include "client/render/render_frame.h"

/// What the bodies of a session look like.
namespace onesea::client {

/// Keeps a model for each body that it has seen lately. One thread.
///
/// Streams say shape and name, no looks: a box is drawn as a boat, a raft or a crate by its name
/// ("boat", "raft"; else a crate), a cylinder as a buoy ("buoy") or a drum, a sphere as a fender. A
/// mesh is drawn as soon as its file is there; the server's own boats get what boats have on deck.
class BodyModels {
 public:
  /// The bodies at `time`, ready to be drawn; the one of `own` as that says, if there is one.
  /// `meshes` may be null: then hulls from files aren't drawn.
  std::vector<render::HullInstance> At(const WorldView& world, SimTime time, MeshFetcher* meshes,
                                       const std::optional<wire::BodyState>& own = std::nullopt);

 private:
  enum class Look : std::uint8_t { kPlain, kBoat, kRaft, kBuoy };
  struct Model {
    Look look = Look::kPlain;
    render::SharedHullMesh mesh;  // null: isn't drawn
    Vec3d origin_m;               // of the mesh, in the body frame
  };
  static Look LookOf(const wire::BodyInfo& info);
  static Model MakeModel(const wire::BodyInfo& info, MeshFetcher* meshes);
  // Of a body seen before or of the same shape and look, else a new one.
  Model ModelFor(const std::shared_ptr<const wire::BodyInfo>& info, MeshFetcher* meshes) const;

  std::map<std::shared_ptr<const wire::BodyInfo>, Model> models_;
};

}  // namespace onesea::client
