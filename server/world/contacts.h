#pragma once

#include <map>
#include <memory>

#include "common/sea/terrain.h"
#include "server/world/body_loads.h"
#include "server/world/rope.h"

/// Collisions of hulls with each other and with the ground, by Bullet. The one place that knows it.
namespace onesea::world {

/// A body as it is stepped.
struct SteppedBody {
  std::shared_ptr<const BodyModel> model;
  BodyState state;
  BodyLoads loads;
  Pose start;  ///< before the step
};

/// The Bullet world. Transforms and velocities are set anew every step; what it remembers are
/// contacts, and a new one has none. Not thread-safe.
class Contacts {
 public:
  /// `terrain` valid or null.
  explicit Contacts(std::shared_ptr<const sea::Terrain> terrain);
  ~Contacts();

  void Add(BodyId id, const SteppedBody& body);
  void Remove(BodyId id);

  /// From the poses before the step and the states after it, to the states after contacts. Pre: the
  /// bodies that were added.
  void Step(std::map<BodyId, SteppedBody>& bodies, double step_s);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace onesea::world
