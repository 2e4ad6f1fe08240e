// The harbour: 200 bodies, four regions of 256 x 256 cells, 60 ticks a second, with what streaming
// them costs. Prints CPU milliseconds a tick and where they go.
//   harbour_bench [--ticks=600]        run it at the root of the source tree
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "common/base/check.h"
#include "common/ingest/terrain_file.h"
#include "common/sea/attenuation.h"
#include "common/sea/recipe.h"
#include "common/wire/frame.h"
#include "common/wire/world_encoder.h"
#include "server/world/body_presets.h"
#include "server/world/world.h"
#include "tests/bench/thread_seconds.h"

namespace onesea::world {
namespace {

constexpr int kTickRateHz = 60;
constexpr int kTicksPerFrame = 2;
constexpr int kWarmTicks = 180;
constexpr int kBodiesOfACluster = 50;

// The sea off the harbour: a swell from the south-west and a wind sea.
std::shared_ptr<const sea::Components> Sea() {
  sea::Recipe recipe;
  recipe.tick_rate_hz = kTickRateHz;
  recipe.depth_m = 28.0;
  recipe.cascades = sea::DefaultCascades();
  recipe.timeline.resize(1);
  sea::JonswapSystem swell;
  swell.hs_m = 1.0;
  swell.tp_s = 9.0;
  swell.wave_to_rad = 0.785;
  sea::JonswapSystem wind_sea;
  wind_sea.hs_m = 0.4;
  wind_sea.tp_s = 3.5;
  recipe.timeline[0].sea.systems = {swell, wind_sea};
  recipe.timeline[0].sea.wind_speed_m_per_s = 5.0;
  auto components = sea::BuildComponents(recipe);
  ONESEA_CHECK(components.ok()) << components.status();
  return *std::move(components);
}

std::shared_ptr<const sea::Terrain> Harbour() {
  auto terrain = ingest::ReadTerrainFile("deploy/terrain/harbour.asc.gz", {});
  ONESEA_CHECK(terrain.ok()) << terrain.status() << "; run it at the root of the source tree";
  return std::make_shared<const sea::Terrain>(*std::move(terrain));
}

// Of ten bodies: a work boat, two motor boats, three buoys, three crates, a raft.
const char* KindOf(int n) {
  constexpr const char* kKinds[] = {"work-boat", "boat",  "boat",  "buoy",  "buoy",
                                    "buoy",      "crate", "crate", "crate", "raft"};
  return kKinds[n % 10];
}

PreparedBody Prepared(const char* preset) {
  wire::BodyDescription named;
  named.preset = preset;
  auto body = PrepareBody(named);
  ONESEA_CHECK(body.ok()) << body.status();
  return *std::move(body);
}

// What a region is and the place in the harbour where it and its bodies begin.
struct Cluster {
  wire::RegionSolver solver;
  Vec2d middle_m;
  bool follows;
};
constexpr Cluster kClusters[] = {
    {wire::RegionSolver::kIwave, {60, -90}, true},           // in the basin
    {wire::RegionSolver::kIwave, {120, -420}, true},         // before the mouth
    {wire::RegionSolver::kShallowWater, {-80, 410}, false},  // at the beach
    {wire::RegionSolver::kWaveEquation, {262, -240}, false}  // in the mouth
};

// Boats start where there is water, 13 m from each other; every second boat is driven.
void Populate(const Cluster& cluster, const sea::Terrain& terrain, World& world) {
  std::uint32_t first = 0;
  int count = 0;
  for (int n = 0; n < 400 && count < kBodiesOfACluster; ++n) {
    const Vec2d place{cluster.middle_m.x + 13.0 * (n % 9 - 4),
                      cluster.middle_m.y + 13.0 * (n / 9 % 9 - 4)};
    if (!(terrain.ElevationAt(place) < -1.5)) continue;
    wire::Kinematics start;
    start.position_m = {place.x, place.y, 0.0};
    const PreparedBody body = Prepared(KindOf(count));
    const auto id = world.Spawn(body, start);
    ONESEA_CHECK(id.ok()) << id.status();
    if (count == 0) first = *id;
    if (!body.model->spec.thrusters.empty() && count % 2 == 0) {
      ONESEA_CHECK(world.Apply(wire::DriveBody{*id, {0.6}, {count % 4 == 0 ? 0.5 : -0.5}}).ok());
    }
    ++count;
  }
  wire::RegionSpec region;
  region.solver = cluster.solver;
  region.middle_m = cluster.middle_m;
  if (cluster.follows) region.follow_body_id = first;
  const auto added = world.Apply(wire::AddRegion{region});
  ONESEA_CHECK(added.ok()) << added.status();
}

// CPU time by stage of the tick.
class Stages {
 public:
  void Begin() { last_ = ThreadSeconds(); }
  void After(WorldStage stage) {
    const double now = ThreadSeconds();
    seconds_[static_cast<int>(stage)] += now - last_;
    last_ = now;
  }
  void Print(int ticks) const {
    constexpr const char* kNames[] = {"place regions",    "sea snapshot", "water around bodies",
                                      "press, obstacles", "feel layer",   "bodies",
                                      "regions",          "publish"};
    for (int n = 0; n < kWorldStages; ++n) {
      std::printf("  %-20s %7.3f ms\n", kNames[n], 1e3 * seconds_[n] / ticks);
    }
  }

 private:
  double last_ = 0.0;
  double seconds_[kWorldStages] = {};
};

struct Cost {
  double step_s = 0.0, encode_s = 0.0, hash_s = 0.0;
  std::size_t bytes = 0;
  int frames = 0;
};

Cost Run(World& world, const std::shared_ptr<const sea::Components>& components, int ticks,
         Stages& stages, Stages*& active) {
  wire::WorldEncoder encoder(1.0 / kTickRateHz);
  Cost cost;
  for (int n = -kWarmTicks; n < ticks; ++n) {
    const Tick tick = n + kWarmTicks + 1;
    active = n < 0 ? nullptr : &stages;
    const double start = ThreadSeconds();
    stages.Begin();
    world.Step(tick, components);
    const double stepped = ThreadSeconds();
    if (n >= 0) cost.step_s += stepped - start;
    if (tick % kTicksPerFrame != 0) continue;
    wire::Frame frame;
    const WorldView& view = *world.view();
    frame.world = encoder.Encode({.tick = tick,
                                  .interaction = view.interaction.get(),
                                  .streaming = view.streaming,
                                  .bodies = view.bodies,
                                  .water_level_m = view.water_level_m,
                                  .spray = {}});
    const std::string bytes = wire::EncodeFrame(frame);
    if (n < 0) continue;
    cost.encode_s += ThreadSeconds() - stepped;
    cost.bytes += bytes.size();
    ++cost.frames;
  }
  cost.hash_s = MedianThreadSeconds([&] {
    volatile std::uint64_t hash = world.Hash();
    (void)hash;
  });
  return cost;
}

int Main(int ticks) {
  const std::shared_ptr<const sea::Terrain> terrain = Harbour();
  const std::shared_ptr<const sea::Components> components = sea::OverTerrain(Sea(), terrain);
  Stages stages;
  Stages* active = nullptr;
  World world({.tick_rate_hz = kTickRateHz,
               .depth_m = 28.0,
               .current_m_per_s = {},
               .terrain = terrain,
               .after_stage = [&](WorldStage stage) {
                 if (active != nullptr) active->After(stage);
               }});
  for (const Cluster& cluster : kClusters) Populate(cluster, *terrain, world);
  const Cost cost = Run(world, components, ticks, stages, active);
  const WorldView& view = *world.view();
  std::printf("%zu bodies, %zu regions:", view.bodies.size(), view.interaction->fields.size());
  for (const auto& field : view.interaction->fields) {
    std::printf(" %d x %d", field->cells.columns, field->cells.rows);
  }
  const double tick_ms = 1e3 * cost.step_s / ticks;
  std::printf("\na tick: %.3f ms CPU, %.1f %% of a core at 60 Hz (goal 4.17 ms, 25 %%)\n", tick_ms,
              tick_ms * kTickRateHz / 10.0);
  stages.Print(ticks);
  const double frame_ms = 1e3 * cost.encode_s / cost.frames;
  std::printf("a frame at 30 Hz: %.3f ms to encode for all viewers, %.1f KB; with it %.1f %%\n",
              frame_ms, 1e-3 * static_cast<double>(cost.bytes) / cost.frames,
              (tick_ms * 60 + frame_ms * 30) / 10.0);
  std::printf("the state hash: %.3f ms; it is %016llx\n", 1e3 * cost.hash_s,
              static_cast<unsigned long long>(world.Hash()));
  return 0;
}

}  // namespace
}  // namespace onesea::world

int main(int argc, char** argv) {
  int ticks = 600;
  if (argc > 1 && std::strncmp(argv[1], "--ticks=", 8) == 0) ticks = std::atoi(argv[1] + 8);
  if (ticks < 1) {
    std::fprintf(stderr, "harbour_bench: --ticks must be at least 1\n");
    return 2;
  }
  return onesea::world::Main(ticks);
}
