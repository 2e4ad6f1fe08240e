// What a region is asked to be: damped, rained on, streamed in its own way, remembered.
#include <algorithm>
#include <cmath>

#include "common/wire/tile_store.h"
#include "common/wire/world_encoder.h"
#include "server/world/rain.h"
#include "tests/world/world_scene.h"

namespace onesea::world {
namespace {

double Energy(const World& world) {
  double sum = 0.0;
  for (const auto& field : world.view()->interaction->fields) {
    for (const float height : field->height_m) sum += static_cast<double>(height) * height;
  }
  return sum;
}

double Volume(const World& world) {
  double sum = 0.0;
  for (const auto& field : world.view()->interaction->fields) {
    const double cell_m2 = field->cells.cell_m * field->cells.cell_m;
    for (const float height : field->height_m) sum += cell_m2 * height;
  }
  return sum;
}

// A splash seen twice, one time with the damping that was asked for: what is left after some
// seconds differs by exp(-damping t) of energy, in each solver.
TEST_F(WorldTest, DampingIsWhatWasAskedFor) {
  for (const auto solver : {wire::RegionSolver::kIwave, wire::RegionSolver::kWaveEquation,
                            wire::RegionSolver::kShallowWater}) {
    double energy[2];
    for (const int damped : {0, 1}) {
      WorldOptions options;
      options.depth_m = 3.0;
      World world(options);
      wire::RegionSpec region = Square(128);
      region.solver = solver;
      region.damping_per_s = damped * 0.5;
      ASSERT_TRUE(world.Apply(wire::AddRegion{region}).ok());
      ASSERT_TRUE(world.Apply(wire::Explode{{0, 0, -1}, 1e6}).ok());
      for (Tick tick = 1; tick <= 180; ++tick) world.Step(tick, calm_);
      energy[damped] = Energy(world);
    }
    EXPECT_GT(energy[0], 0.0);
    EXPECT_NEAR(std::log(energy[0] / energy[1]) / 3.0, 0.5, 0.06) << static_cast<int>(solver);
  }
}

// An explosion at the very tick at which its region moves on, or becomes another one.
TEST_F(WorldTest, DepositsStayWhenTheirRegionMoves) {
  const std::uint32_t body = Spawn(Box({1, 1, 1}, 500.0));
  AddRegion(Square(128, body));
  Run(3);  // iWave steps with the next one
  const sea::CellRect before = world_.view()->interaction->fields[0]->cells;
  ASSERT_TRUE(world_.Apply(wire::Explode{{2, 1, -1}, 1e6}).ok());
  // Far enough for another rectangle, near enough for the place of the explosion to be in both.
  ASSERT_TRUE(world_.Apply(wire::ApplyImpulse{body, {500.0 * 150.0, 0, 0}, Vec3d{0, 0, 0}}).ok());
  ASSERT_TRUE(world_.Apply(wire::RemoveBody{body}).ok());
  wire::RegionSpec more = Square(128);
  more.middle_m = {16, 16};
  AddRegion(more);  // merges with the first: the layout changes before any step
  Run(1);
  EXPECT_NE(world_.view()->interaction->fields[0]->cells, before);
  EXPECT_GT(std::abs(HeightAt({2, 1})), 0.3);
}

TEST_F(WorldTest, RegionsAreStreamedAsTheyWereAskedFor) {
  wire::RegionSpec far = Square(64);
  far.height_step_m = 0.02;
  far.frames_per_update = 4;
  AddRegion(far);
  ASSERT_EQ(world_.view()->streaming.size(), 1u);
  ASSERT_TRUE(world_.Apply(wire::Explode{{0, 0, -1}, 3e6}).ok());
  wire::WorldEncoder encoder(1.0 / 60);
  wire::TileStore store;
  int updates = 0;
  double worst = 0.0, highest = 0.0;
  for (int frame = 0; frame < 40; ++frame) {
    Run(2);
    const WorldView& view = *world_.view();
    const wire::WorldUpdate update = encoder.Encode({.tick = tick_,
                                                     .interaction = view.interaction.get(),
                                                     .streaming = view.streaming,
                                                     .bodies = {},
                                                     .water_level_m = 0.0,
                                                     .spray = {}});
    ASSERT_TRUE(store.Apply(update.tiles, frame == 0).ok());
    EXPECT_EQ(store.fields()[0].layout.height_step_m, 0.02);
    if (update.tiles.blobs.empty()) continue;
    ++updates;
    for (std::size_t n = 0; n < view.interaction->fields[0]->height_m.size(); ++n) {
      const double truth = view.interaction->fields[0]->height_m[n];
      highest = std::max(highest, std::abs(truth));
      worst = std::max(worst, std::abs(truth - store.fields()[0].height_m[n]));
    }
  }
  EXPECT_EQ(updates, 11);  // the first at once
  EXPECT_GT(highest, 0.2);
  EXPECT_LE(worst, 0.02 * 1.0001);
}

TEST_F(WorldTest, RainMakesRingsAndNoWater) {
  wire::RegionSpec region = Square(128);
  region.rain_drops_per_m2_s = 2.0;
  AddRegion(region);
  Run(1);
  // Each drop lifts its cell by as much; they are counted by the energy of what one tick brought.
  const double drop = DropHeight(0.5);
  const double expected = 2.0 * 64.0 * 64.0 / 60.0;
  EXPECT_NEAR(Energy(world_) / (1.25 * drop * drop), expected, 0.25 * expected);
  EXPECT_NEAR(Volume(world_), 0.0, 1e-3 * expected * drop);  // but for what the border took
  Run(120);
  EXPECT_NEAR(Volume(world_), 0.0, 0.05);  // the border takes what leaves
  const auto now = world_.view()->interaction->fields[0]->height_m;
  World other{WorldOptions{}};
  ASSERT_TRUE(other.Apply(wire::AddRegion{region}).ok());
  for (Tick tick = 1; tick <= 121; ++tick) other.Step(tick, calm_);
  EXPECT_EQ(other.view()->interaction->fields[0]->height_m, now);
}

TEST_F(WorldTest, KeepsThePastForTwoSecondsAndNotMore) {
  AddRegion(Square(64));
  ASSERT_TRUE(world_.Apply(wire::Explode{{0, 0, -1}, 1e6}).ok());
  Run(1);
  std::vector<double> heights{0.0, HeightAt({3, 2})};  // by tick
  for (int n = 0; n < 400; ++n) {
    Run(1);
    heights.push_back(HeightAt({3, 2}));
  }
  const WorldView& view = *world_.view();
  EXPECT_EQ(view.past->back()->tick, 396);
  EXPECT_LE(view.past->size(), 21u);
  EXPECT_GE(view.past->size(), 20u);
  double highest = 0.0;
  for (Tick tick = view.past->front()->tick; tick <= tick_; ++tick) {
    const auto moment =
        sea::FindMoment(*view.past, *view.interaction, static_cast<double>(tick), 60);
    ASSERT_TRUE(moment.has_value()) << tick;
    const double height = sea::SampleInteraction(*moment, {3, 2}).height_m;
    highest = std::max(highest, std::abs(heights[tick]));
    EXPECT_NEAR(height, heights[tick], 1e-3) << tick;
  }
  EXPECT_GT(highest, 3e-3);
  EXPECT_FALSE(sea::FindMoment(*view.past, *view.interaction, 250.0, 60).has_value());
}

TEST(RegionLayout, MergedRegionsAreStreamedAsTheFinestOfThem) {
  const std::vector<RegionAsk> asks = {{.id = 1, .centre_m = {0, 0}, .traits = {0.01, 2, 0.0}},
                                       {.id = 2, .centre_m = {16, 0}, .traits = {1e-3, 5, 1.0}},
                                       {.id = 3, .centre_m = {16, 0}, .damping_per_s = 0.5}};
  const std::vector<Region> regions = LayOut(SnapAsks(asks, {}));
  ASSERT_EQ(regions.size(), 2u);  // other waves die otherwise: no merging
  EXPECT_EQ(regions[0].traits, (RegionTraits{1e-3, 2, 1.0}));
  EXPECT_EQ(regions[1].damping_per_s, 0.5);
}

}  // namespace
}  // namespace onesea::world
