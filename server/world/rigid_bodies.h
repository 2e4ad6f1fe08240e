#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "common/base/hash.h"
#include "common/sea/terrain.h"
#include "server/world/contacts.h"
#include "server/world/rope.h"

/// All bodies of a session: water, ropes, collisions.
///
/// Each step, for every body in order of id: forces of the water, new velocity (body_loads.h),
/// ropes; then Bullet finds contacts and changes velocities of those that touch. A body that
/// touches nothing is moved by our own integration alone. In contacts a body has the mean of its
/// added masses and the diagonal of its inertia: impacts share momentum by those, not by the full
/// matrix.
/// Hulls collide as convex hulls of at most 90 of their vertices: hollows are filled.
/// Bits: same commands and same binary, same bits; a Restore() of State() continues as the world
/// that was Rebuild() at that tick.
namespace onesea::world {

/// The water of a tick; asked once a body and step.
class WaterSource {
 public:
  virtual ~WaterSource() = default;
  /// For a body within `radius_m` of (x, y); valid until the next call.
  virtual const WaterPatch& Around(Vec3d centre_m, double radius_m) = 0;
};

using RopeId = std::int64_t;

struct RigidBodiesState {
  struct Body {
    BodyId id = kNoBody;
    std::shared_ptr<const BodyModel> model;
    BodyState state;
  };
  struct Rope {
    RopeId id = 0;
    wire::RopeSpec spec;
  };
  std::int64_t next_id = 1;
  std::vector<Body> bodies;  ///< ascending ids
  std::vector<Rope> ropes;
};

/// Not thread-safe.
class RigidBodies {
 public:
  /// Pre: step > 0; `terrain` valid or null.
  RigidBodies(double step_s, std::shared_ptr<const sea::Terrain> terrain);
  ~RigidBodies();

  /// ResourceExhausted beyond kBodiesMax; InvalidArgument for a state that is not finite or a heave
  /// memory of another step.
  absl::StatusOr<BodyId> Add(std::shared_ptr<const BodyModel> model, const BodyState& state);
  /// With its ropes. NotFound.
  absl::Status Remove(BodyId id);

  /// NotFound; InvalidArgument for numbers that are not finite or beyond the limits.
  absl::Status SetDrive(BodyId id, const DriveCommand& command);
  /// Puts it higher by `metres` and lets it rise by so much. Pre: both finite. NotFound.
  absl::Status Raise(BodyId id, double metres, double rise_m_per_s);
  /// At a place in the world; at most kBodyForceMaxN during a second.
  absl::Status ApplyImpulse(BodyId id, Vec3d impulse_n_s, Vec3d place_m);
  /// Of a body that its owner integrates. FailedPrecondition for others.
  absl::Status CheckMotion(BodyId id, const Pose& pose, Vec3d velocity_m_per_s,
                           Vec3d spin_rad_per_s) const;
  absl::Status SetMotion(BodyId id, const Pose& pose, Vec3d velocity_m_per_s, Vec3d spin_rad_per_s);

  /// NotFound for an unknown body, InvalidArgument also for ends further apart than kRopeStretchMax
  /// lengths, ResourceExhausted beyond kRopesMax.
  absl::StatusOr<RopeId> AddRope(const wire::RopeSpec& spec);
  absl::Status RemoveRope(RopeId id);
  /// Null where there is no such rope; valid until the next change.
  const wire::RopeSpec* FindRope(RopeId id) const;

  /// Advances by step_s. Bounded cost whatever the bodies do: at most kBodyContactPairsMax contacts
  /// a body.
  void Step(WaterSource& water, const Air& air);

  std::vector<BodyId> Ids() const;
  /// Null where there is no such body; valid until it is removed or all are Restore()d.
  const SteppedBody* FindBody(BodyId id) const;
  /// Null where there is no such body; valid until the next change.
  const BodyState* FindState(BodyId id) const;
  const BodyModel* FindModel(BodyId id) const;
  const BodyLoads* FindLoads(BodyId id) const;  ///< of the last step
  double TensionOf(RopeId id) const;            ///< of the last step [N]; 0 for none
  /// Steps in which some body's new velocity was not finite and was set to rest.
  std::int64_t fault_count() const { return faults_; }

  RigidBodiesState State() const;
  /// Replaces everything. Pre: a State() of a world of the same step and terrain.
  void Restore(const RigidBodiesState& state);
  /// Forgets contacts and caches: at every tick whose state is stored.
  void Rebuild();
  /// Of all that the next step depends on, contacts apart.
  std::uint64_t Hash() const;

 private:
  struct RopeEntry {
    wire::RopeSpec spec;
    double tension_n = 0.0;
  };

  SteppedBody* Find(BodyId id);
  Vec3d PlaceOf(const wire::RopeEnd& end);
  RopeBody EndOf(const wire::RopeEnd& end);
  void MoveAlone(SteppedBody& entry, WaterSource& water, const Air& air);
  void PullRopes();

  double step_s_;
  std::shared_ptr<const sea::Terrain> terrain_;
  std::int64_t next_id_ = 1;
  std::map<BodyId, SteppedBody> bodies_;
  std::map<RopeId, RopeEntry> ropes_;
  std::unique_ptr<Contacts> contacts_;
  WetScratch scratch_;
  std::int64_t faults_ = 0;
};

}  // namespace onesea::world
