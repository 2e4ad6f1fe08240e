#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "common/sea/components.h"
#include "common/sea/interaction_past.h"
#include "common/sea/point_query.h"
#include "common/sea/terrain.h"
#include "common/wire/body_encoder.h"
#include "common/wire/world_command.h"
#include "common/wire/world_encoder.h"
#include "server/world/body_water.h"
#include "server/world/displaced_columns.h"
#include "server/world/interaction_layer.h"
#include "server/world/obstacles.h"
#include "server/world/rigid_bodies.h"
#include "server/world/spray.h"

/// Everything of a session that has history: bodies, regions of the interaction layer, walls.
///
/// A tick, from t to t + step:
///   1. the water around every body: the spectral sea at t in its bands
///   2. what bodies press on the water goes into the regions (displaced_columns.h)
///   3. bodies move (rigid_bodies.h), feeling the layer with that pressure
///   4. the regions advance
/// A hull presses on the interaction layer with the head of the water that it displaces, reckoned
/// from the incident sea. So still water makes room for it, a moving hull leaves its wake, and one
/// that doesn't follow the waves scatters them. The body in turn feels the layer's height plus that
/// same head: 0 for a hull at rest in still water, whatever else is there otherwise.
/// Radiation counts once: a body with Radiation::kCoefficients presses with its shape at rest, so
/// its heaving and rolling make no waves in the grid; one with kGrid presses as it lies.
namespace onesea::world {

/// The parts of a tick, in their order.
enum class WorldStage : std::uint8_t {
  kRegionsPlaced,
  kSeaMade,
  kWaterSampled,
  kPressed,
  kLayerFelt,
  kBodiesMoved,
  kRegionsStepped,
  kPublished,
};
inline constexpr int kWorldStages = 8;

struct WorldOptions {
  int tick_rate_hz = 60;
  double depth_m = 0.0;  ///< 0: infinitely deep
  Vec2d current_m_per_s;
  std::shared_ptr<const sea::Terrain> terrain;  ///< null: none
  sea::TransformKind transform = sea::TransformKind::kOwn;
  std::function<void(WorldStage)> after_stage = {};  ///< for those who measure; may be empty
};

/// How much of the interaction layer is kept for queries about the past: ten snapshots a second for
/// two seconds, but at most so many bytes (16 a cell and snapshot: 21 MB for 256 x 256 cells).
inline constexpr int kPastPerSecond = 10;
inline constexpr double kPastS = 2.0;
inline constexpr std::size_t kPastBytesMax = 64 << 20;

/// The world at one tick; immutable, shared by those who stream it and those who query it.
struct WorldView {
  Tick tick = 0;  ///< of an empty world: when it became empty
  double water_level_m = 0.0;
  std::shared_ptr<const sea::InteractionSnapshot> interaction;  ///< never null
  std::shared_ptr<const sea::InteractionPast> past;             ///< never null; up to kPastS
  std::vector<wire::RegionStreaming> streaming;                 ///< one per region
  std::vector<wire::BodyView> bodies;                           ///< ascending ids
  std::vector<wire::Spray> spray;  ///< thrown up in this tick, at most kSprayMax
  wire::RopeList ropes = nullptr;  ///< null: none; the same object until they change
  bool empty() const { return interaction->fields.empty() && bodies.empty(); }
};

/// A body made ready: reading and checking a hull takes long, and needs no world.
struct PreparedBody {
  std::shared_ptr<const BodyModel> model;
  std::shared_ptr<const std::string> mesh;  ///< the hull's file, or null
  wire::BodyInfo info;                      ///< but for the id
  wire::BodyDescription description;        ///< its preset filled in; without the mesh's bytes
};
/// Fills in what the preset says, if it names one. NotFound for the preset, InvalidArgument.
absl::StatusOr<PreparedBody> PrepareBody(wire::BodyDescription given);

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
  /// Of bodies that their owners integrate: where they are now; until the next pose they keep their
  /// velocity. Answers what water and wind of the present tick do to them there. All or none:
  /// NotFound, FailedPrecondition (it is integrated here), InvalidArgument. A body that jumped
  /// begins anew to press on the water. Cost: the snapshot that the next Step() would make, and
  /// some 20 µs a body.
  absl::StatusOr<std::vector<wire::BodyWrench>> SetPoses(
      std::span<const wire::BodyPose> poses,
      const std::shared_ptr<const sea::Components>& components);

  /// Goes on to `tick` in the sea of `components`. Cost: nothing in an empty world; else a
  /// snapshot (1.5 ms), a few µs a body and each region's step.
  void Step(Tick tick, const std::shared_ptr<const sea::Components>& components);

  /// The hull's file of a body, by its hash; null: none.
  std::shared_ptr<const std::string> FindMesh(std::uint64_t hash) const;
  /// Null: none.
  const std::shared_ptr<const sea::Terrain>& terrain() const { return options_.terrain; }
  bool HasBody(std::uint32_t id) const { return bodies_.contains(id); }
  /// Null: no such rope.
  const wire::RopeSpec* FindRope(std::uint32_t id) const { return rigid_.FindRope(id); }
  /// Everything that the next step depends on. Forgets what Bullet remembers of contacts, so that
  /// this world goes on as one that is restored does: the hash of both is the same from here on.
  struct Saved;
  std::shared_ptr<const Saved> Save();
  /// Into a world of the same options. What was kept for queries about the past is gone.
  /// InvalidArgument: of other options.
  absl::Status Restore(const Saved& saved);

  /// As of the last change or step.
  const std::shared_ptr<const WorldView>& view() const { return view_; }
  /// Over all that the next step depends on. Cost: reads every cell.
  std::uint64_t Hash() const;

 private:
  struct Body {
    std::shared_ptr<const BodyModel> model;
    std::shared_ptr<const std::string> mesh;  // file, or null
    std::shared_ptr<const wire::BodyInfo> info;
    const SteppedBody* stepped = nullptr;  // in rigid_
    Wetness wetness;                       // of the last step
    bool wetness_known = false;
    double pressed_share = 0.0;  // of the displacement at rest, lagging behind the true one
    bool is_to_float = false;    // on the waves of its first step, which it was spawned without
    Vec2d mean_m_per_s;          // through the water, over kRestMeanS
    Tick active_tick = 0;        // the last at which it wasn't at rest
    std::vector<LumpedColumn> columns;       // at rest, for cells of columns_cell_m
    double columns_cell_m = 0.0;             // 0: not made yet
    std::vector<sea::InteractionFelt> felt;  // there in the last step; of owners' bodies
  };
  // A region as it was asked for.
  struct AskedRegion {
    wire::RegionSpec spec;
    Tick since_tick = 0;   // there for so long: who came first keeps his place
    bool resting = false;  // given back until its body is active again
    std::optional<Tick> end_tick = std::nullopt;  // its body is gone
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
  absl::StatusOr<std::uint32_t> Do(const wire::AddRope& command);
  absl::StatusOr<std::uint32_t> Do(const wire::RemoveRope& command);

  void Done(WorldStage stage) const {
    if (options_.after_stage) options_.after_stage(stage);
  }
  RegionAsk AskFor(std::uint32_t id, const wire::RegionSpec& spec) const;
  std::shared_ptr<const BodyModel> Known(const std::shared_ptr<const BodyModel>& model) const;
  absl::Status PlaceRegions();
  bool IsAtRest(const wire::RegionSpec& region) const;
  void WakeRegions();
  void LeaveRegionsOf(std::uint32_t body_id, Vec2d place_m);
  void NoteActivity();
  void NoteCommand(const wire::WorldCommand& command);
  void SampleSea(Tick tick, const std::shared_ptr<const sea::Components>& components);
  void FloatNewBodies();
  std::size_t AddWaterUnder(const Body& body);
  void FillWater();
  void FeelTheLayer();
  Air AirAt(const sea::Recipe& recipe, SimTime time) const;
  double LevelAt(SimTime time) const;
  void PressBodies();
  void SprayFromBodies();
  void SprayFromCrests(const WorldView& view);
  void PressBody(Body& body, const HeightPatch& incident);
  void HoldObstacles();
  enum class Change : std::uint8_t { kTick, kRegions, kBodies };
  void Publish(Change change);
  void ListRopes();
  void KeepPast();

  WorldOptions options_;
  double step_s_;
  Tick tick_ = 0;
  std::vector<wire::WaterLevel> levels_;
  std::optional<Vec2d> wind_m_per_s_;
  RigidBodies rigid_;
  InteractionLayer layer_;
  Obstacles obstacles_;
  std::map<std::uint32_t, Body> bodies_;
  std::map<std::uint32_t, AskedRegion> regions_;
  std::uint32_t next_region_id_ = 1, next_obstacle_id_ = 1;

  // The sea of the present tick.
  std::shared_ptr<const sea::Components> components_;
  std::unique_ptr<sea::SnapshotBuilder> builder_;
  std::shared_ptr<const sea::SeaSnapshot> sea_;
  Tick sea_tick_ = 0;  // of sea_, if there is one
  std::vector<double> wavenumbers_;
  BodyWater water_;
  WetScratch scratch_;
  std::vector<sea::InteractionFelt> felt_;
  std::vector<wire::Spray> spray_;  // since the last tick
  wire::RopeList ropes_;            // those of rigid_, as they are published
  std::vector<sea::SurfaceSample> obstacle_samples_;
  std::shared_ptr<const sea::InteractionPast> past_ =
      std::make_shared<const sea::InteractionPast>();
  std::shared_ptr<const WorldView> view_;
};

}  // namespace onesea::world
