#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "absl/status/statusor.h"
#include "common/sea/components.h"
#include "common/sea/point_query.h"
#include "common/sea/terrain.h"
#include "common/wire/body_encoder.h"
#include "common/wire/world_command.h"
#include "server/world/body_water.h"
#include "server/world/interaction_layer.h"
#include "server/world/obstacles.h"
#include "server/world/rigid_bodies.h"

/// Everything of a session that has history: bodies, regions of the interaction layer, walls.
///
/// A tick, from t to t + step:
///   1. the water around every body: the spectral sea at t in its bands, the interaction layer
///   2. bodies move (rigid_bodies.h)
///   3. what they press on the water goes into the regions (displaced_columns.h)
///   4. the regions advance
/// A hull presses on the interaction layer with the head of the water that it displaces, reckoned
/// from the incident sea. So still water makes room for it, a moving hull leaves its wake, and one
/// that doesn't follow the waves scatters them. The body in turn feels the layer's height plus that
/// same head: 0 for a hull at rest in still water, whatever else is there otherwise.
/// Radiation counts once: a body with Radiation::kCoefficients presses with its shape at rest, so
/// its heaving and rolling make no waves in the grid; one with kGrid presses as it lies.
namespace onesea::world {

struct WorldOptions {
  int tick_rate_hz = 60;
  double depth_m = 0.0;  ///< 0: infinitely deep
  Vec2d current_m_per_s;
  std::shared_ptr<const sea::Terrain> terrain;  ///< null: none
  sea::TransformKind transform = sea::TransformKind::kOwn;
};

/// The world at one tick; immutable, shared by those who stream it and those who query it.
struct WorldView {
  Tick tick = 0;  ///< of an empty world: when it became empty
  double water_level_m = 0.0;
  std::shared_ptr<const sea::InteractionSnapshot> interaction;  ///< never null
  std::vector<wire::BodyView> bodies;                           ///< ascending ids
  bool empty() const { return interaction->fields.empty() && bodies.empty(); }
};

/// A body made ready: reading and checking a hull takes long, and needs no world.
struct PreparedBody {
  std::shared_ptr<const BodyModel> model;
  std::shared_ptr<const std::string> mesh;  ///< the hull's file, or null
  wire::BodyInfo info;                      ///< but for the id
};
/// InvalidArgument.
absl::StatusOr<PreparedBody> PrepareBody(wire::BodyDescription description);

/// Not thread-safe. Same options and same calls, same bits.
class World {
 public:
  explicit World(WorldOptions options);
  ~World();

  /// What a session begins with. InvalidArgument.
  absl::Status Begin(const wire::WorldSpec& spec);

  /// Its id. ResourceExhausted at kBodiesMax; InvalidArgument.
  absl::StatusOr<std::uint32_t> Spawn(const PreparedBody& body, const wire::Kinematics& start);
  /// Every command but SpawnBody (CHECK); leases are the session's business, here they only ask
  /// whether the body exists. Returns the id of what was made or changed. NotFound,
  /// InvalidArgument, ResourceExhausted.
  absl::StatusOr<std::uint32_t> Apply(const wire::WorldCommand& command);
  /// Of a body that its owner integrates; the force of the water on it at the present tick.
  absl::StatusOr<wire::BodyWrench> SetPose(const wire::BodyPose& pose);

  /// Goes on to `tick` in the sea of `components`. Cost: nothing in an empty world; else a
  /// snapshot (1.5 ms), a few µs a body and each region's step.
  void Step(Tick tick, const std::shared_ptr<const sea::Components>& components);

  /// The hull's file of a body, by its hash; null: none.
  std::shared_ptr<const std::string> FindMesh(std::uint64_t hash) const;
  /// Null: none.
  const std::shared_ptr<const sea::Terrain>& terrain() const { return options_.terrain; }
  bool HasBody(std::uint32_t id) const { return bodies_.contains(id); }
  /// As of the last change or step.
  const std::shared_ptr<const WorldView>& view() const { return view_; }
  /// Over all that the next step depends on. Cost: reads every cell.
  std::uint64_t Hash() const;

 private:
  struct Body {
    std::shared_ptr<const BodyModel> model;
    std::shared_ptr<const std::string> mesh;  // file, or null
    std::shared_ptr<const wire::BodyInfo> info;
    double pressed_share = 0.0;  // of the displacement at rest, lagging behind the true one
    bool is_to_float = false;    // on the waves of its first step, which it was spawned without
  };
  class Water;

  absl::StatusOr<std::uint32_t> Do(const wire::RemoveBody& command);
  absl::StatusOr<std::uint32_t> Do(const wire::DriveBody& command);
  absl::StatusOr<std::uint32_t> Do(const wire::ApplyImpulse& command);
  absl::StatusOr<std::uint32_t> Do(const wire::Explode& command);
  absl::StatusOr<std::uint32_t> Do(const wire::SetObstacle& command);
  absl::StatusOr<std::uint32_t> Do(const wire::RemoveObstacle& command);
  absl::StatusOr<std::uint32_t> Do(const wire::AddRegion& command);
  absl::StatusOr<std::uint32_t> Do(const wire::RemoveRegion& command);

  absl::Status PlaceRegions();
  void SampleSea(Tick tick, const std::shared_ptr<const sea::Components>& components);
  void FloatNewBodies();
  void FillWater();
  Air AirAt(const sea::Recipe& recipe, SimTime time) const;
  double LevelAt(SimTime time) const;
  void PressBodies();
  void PressBody(std::uint32_t id, Body& body, const HeightPatch& incident);
  void HoldObstacles();
  std::vector<sea::InteractionField> PressedHeads() const;
  void Feel(std::vector<sea::InteractionField> heads);
  void Publish();

  WorldOptions options_;
  double step_s_;
  Tick tick_ = 0;
  std::vector<wire::WaterLevel> levels_;
  std::optional<Vec2d> wind_m_per_s_;
  RigidBodies rigid_;
  InteractionLayer layer_;
  Obstacles obstacles_;
  std::map<std::uint32_t, Body> bodies_;
  std::map<std::uint32_t, wire::RegionSpec> regions_;  // as they were asked for
  std::uint32_t next_region_id_ = 1, next_obstacle_id_ = 1;

  // The sea of the present tick.
  std::shared_ptr<const sea::Components> components_;
  std::unique_ptr<sea::SnapshotBuilder> builder_;
  std::shared_ptr<const sea::SeaSnapshot> sea_;
  std::vector<double> wavenumbers_;
  BodyWater water_;
  sea::InteractionSnapshot felt_;  // heights plus what the bodies press
  std::vector<double> felt_m_;
  std::vector<RegionForcing*> pressed_;  // where some body presses in this tick
  std::vector<sea::SurfaceSample> obstacle_samples_;
  std::shared_ptr<const WorldView> view_;
};

}  // namespace onesea::world
