// The whole of a tick: bodies, their wakes, what commands do.
#include "server/world/world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "common/wire/world_encoder.h"
#include "tests/world/world_scene.h"

namespace onesea::world {
namespace {

using ::testing::HasSubstr;

TEST_F(WorldTest, AnEmptyWorldStaysEmpty) {
  Run(3);
  EXPECT_TRUE(world_.view()->empty());
}

TEST_F(WorldTest, ABodyFloatsAtItsDraft) {
  const std::uint32_t id = Spawn(Box({4, 2, 1}, 4100.0));
  Run(600);
  // Archimedes: 4.1 t on 8 m² of salt water draws half a metre, and the centre of mass lies 0.3 m
  // above the bottom.
  EXPECT_NEAR(StateOf(id).position_m.z, -0.5 + 0.3, 0.01);
}

// Whatever the sea does at the place, a body that is launched there neither drops nor pops up.
TEST_F(WorldTest, ABodyIsLaunchedOnTheWavesOfThePlace) {
  const auto sea = sea::FakeSea(
      {.lengths_m = {307.0, 97.0}, .index_max = 8, .hs_m = 4.0, .query_grid_size = 64});
  sea::SnapshotBuilder builder(sea);
  double highest = 0.0;
  for (int n = 0; n < 12; ++n) {
    World world{WorldOptions{}};
    const auto body = PrepareBody(Box({2, 2, 1}, 2050.0));
    const Vec2d place{23.0 * n, -11.0 * n};
    const std::uint32_t id = *world.Spawn(*body, AfloatAt(place));
    sea::SurfaceSample water;
    builder.At({}, sea::QueryDetail::kHeight)->Sample({&place, 1}, {&water, 1});
    highest = std::max<double>(highest, std::abs(water.height_m));
    world.Step(1, sea);
    const wire::BodyState first = world.view()->bodies[0].state;
    // At rest the centre lies 0.2 m under the water: half a metre of draft, 0.3 m above the bottom.
    EXPECT_NEAR(first.position_m.z, water.height_m - 0.2, 0.1) << id;
    for (Tick tick = 2; tick <= 60; ++tick) {
      world.Step(tick, sea);
      const double rise = world.view()->bodies[0].state.velocity_m_per_s.z;
      EXPECT_LT(std::abs(rise - first.velocity_m_per_s.z), 2.0) << n;
    }
  }
  EXPECT_GT(highest, 1.0);  // else this proves nothing
}

TEST_F(WorldTest, StillWaterMakesRoomAndTheBodyDoesNotFeelIt) {
  AddRegion(Square(128));
  const std::uint32_t id = Spawn(Box({4, 2, 1}, 4100.0));
  Run(1500);
  // The surface lies under the hull, but for what the hull's depth blurs of it.
  EXPECT_NEAR(HeightAt({0, 0}), -0.45, 0.05);
  EXPECT_NEAR(HeightAt({12, 9}), 0.0, 0.005);
  EXPECT_NEAR(StateOf(id).position_m.z, -0.2, 0.005);
  EXPECT_NEAR(Norm(Vec2d{StateOf(id).position_m.x, StateOf(id).position_m.y}), 0.0, 0.05);
}

// Dropped from 0.3 m, it comes to rest by the waves that it makes and by friction alone.
TEST_F(WorldTest, RadiationIntoTheGridTakesEnergy) {
  AddRegion(Square(128));
  wire::BodyDescription body = Box({4, 2, 1}, 4100.0);
  body.radiation = wire::Radiation::kGrid;
  const auto prepared = PrepareBody(body);
  wire::Kinematics start;
  start.position_m.z = 0.1;
  const std::uint32_t id = *world_.Spawn(*prepared, start);
  Run(900);
  double largest = 0;
  for (int n = 0; n < 300; ++n) {
    Run(1);
    largest = std::max(largest, std::abs(StateOf(id).position_m.z + 0.2));
  }
  EXPECT_LT(largest, 0.03);
}

TEST_F(WorldTest, ADrivenBoatLeavesAWakeThatRocksAnother) {
  AddRegion(Square(256));
  const std::uint32_t boat = Spawn(Boat(), {-40, 0});
  const std::uint32_t buoy = Spawn(Box({1, 1, 1}, 500.0), {0, 8});
  Run(300);
  const double at_rest = StateOf(buoy).position_m.z;
  ASSERT_TRUE(world_.Apply(wire::DriveBody{boat, {1.0}, {0.0}}).ok());
  double highest = -1, lowest = 1, fastest = 0, wave = 0;
  for (int n = 0; n < 1500; ++n) {
    Run(1);
    const double z = StateOf(buoy).position_m.z - at_rest;
    highest = std::max(highest, z);
    lowest = std::min(lowest, z);
    fastest = std::max(fastest, StateOf(boat).velocity_m_per_s.x);
    wave = std::max(wave, std::abs(HeightAt({-10, 7})));
  }
  EXPECT_GT(fastest, 2.0);
  EXPECT_GT(wave, 0.01);
  EXPECT_GT(highest - lowest, 0.01);  // what the other feels
  EXPECT_LT(highest - lowest, 1.0);
}

TEST_F(WorldTest, ExplosionMakesARingAndMovesBodies) {
  AddRegion(Square(256));
  const std::uint32_t buoy = Spawn(Box({1, 1, 1}, 500.0), {15, 0});
  Run(120);
  const double at_rest = StateOf(buoy).position_m.z;
  ASSERT_TRUE(world_.Apply(wire::Explode{{0, 0, -1}, 4.2e6}).ok());
  double largest = 0;
  for (int n = 0; n < 600; ++n) {
    Run(1);
    largest = std::max(largest, std::abs(StateOf(buoy).position_m.z - at_rest));
  }
  EXPECT_GT(largest, 0.05);
  EXPECT_LT(largest, 5.0);
}

TEST_F(WorldTest, SameCommandsSameHash) {
  const auto run = [this] {
    World world{WorldOptions{}};
    EXPECT_TRUE(world.Apply(wire::AddRegion{Square(64)}).ok());
    const auto boat = PrepareBody(Boat());
    const auto id = world.Spawn(*boat, {});
    std::vector<std::uint64_t> hashes;
    for (Tick tick = 1; tick <= 200; ++tick) {
      if (tick == 50) {
        EXPECT_TRUE(world.Apply(wire::DriveBody{*id, {0.8}, {0.3}}).ok());
      }
      world.Step(tick, calm_);
      hashes.push_back(world.Hash());
    }
    return hashes;
  };
  const auto first = run();
  EXPECT_EQ(first, run());
  EXPECT_NE(first[100], first[101]);
}

TEST_F(WorldTest, RegionsFollowTheirBody) {
  const std::uint32_t boat = Spawn(Boat());
  AddRegion(Square(64, boat));
  Run(10);
  const sea::CellRect before = world_.view()->interaction->fields[0]->cells;
  ASSERT_TRUE(world_.Apply(wire::DriveBody{boat, {1.0}, {0.0}}).ok());
  Run(1200);
  const sea::CellRect after = world_.view()->interaction->fields[0]->cells;
  EXPECT_GT(after.west, before.west);
  EXPECT_GT(StateOf(boat).position_m.x, 10.0);
}

TEST_F(WorldTest, ABoatTowsAnother) {
  const std::uint32_t boat = Spawn(Boat());
  const std::uint32_t barge = Spawn(Box({6, 2, 1}, 3000.0), {-12, 0});
  const auto rope =
      world_.Apply(wire::AddRope{{{boat, {-3, 0, 0}}, {barge, {3, 0, 0}}, 8.0, 2e4, 2e3}});
  ASSERT_TRUE(rope.ok()) << rope.status();
  ASSERT_TRUE(world_.Apply(wire::DriveBody{boat, {1.0}, {0.0}}).ok());
  Run(1800);
  const Vec3d gap = StateOf(boat).position_m - StateOf(barge).position_m;
  EXPECT_GT(StateOf(barge).position_m.x, 0.0);
  EXPECT_NEAR(Norm(gap), 3 + 8 + 3, 0.5);  // taut: hull, rope, hull
  EXPECT_NEAR(StateOf(barge).velocity_m_per_s.x, StateOf(boat).velocity_m_per_s.x, 0.1);
  ASSERT_TRUE(world_.Apply(wire::RemoveRope{*rope}).ok());
  Run(600);
  EXPECT_GT(Norm(StateOf(boat).position_m - StateOf(barge).position_m), 16.0);
}

TEST_F(WorldTest, AMooredBodyStaysAndItsRopeGoesWithIt) {
  wire::WorldSpec spec;
  spec.bodies.push_back({Boat(), {}});
  spec.ropes.push_back({{1, {3, 0, 0}}, {0, {8, 0, 0.5}}, 5.0});
  ASSERT_TRUE(world_.Begin(spec).ok());
  ASSERT_TRUE(world_.Apply(wire::DriveBody{1, {-1.0}, {0.0}}).ok());
  Run(3600);
  // Full astern: the bow stays on the rope, stretched by less than a metre.
  const double bow_x = StateOf(1).position_m.x + 3.0;
  EXPECT_GT(8.0 - bow_x, 4.9);
  EXPECT_LT(8.0 - bow_x, 6.0);
  ASSERT_TRUE(world_.Apply(wire::RemoveBody{1}).ok());
  EXPECT_EQ(world_.FindRope(2), nullptr);
}

TEST_F(WorldTest, ErrorsNameWhatIsMissing) {
  const auto message = [this](const wire::WorldCommand& command) {
    return std::string(world_.Apply(command).status().message());
  };
  EXPECT_THAT(message(wire::RemoveBody{9}), HasSubstr("no body 9"));
  EXPECT_THAT(message(wire::DriveBody{9, {}, {}}), HasSubstr("no body 9"));
  EXPECT_THAT(message(wire::RemoveRegion{4}), HasSubstr("no region 4"));
  EXPECT_THAT(message(wire::RemoveObstacle{5}), HasSubstr("no obstacle 5"));
  EXPECT_THAT(message(wire::RemoveRope{6}), HasSubstr("no rope 6"));
  EXPECT_THAT(message(wire::AddRope{{{9, {}}, {0, {}}}}), HasSubstr("no body 9"));
  EXPECT_THAT(message(wire::SetObstacle{5, {{0, 0}, {1, 0}, {0, 1}}}), HasSubstr("no obstacle 5"));
  EXPECT_THAT(message(wire::Explode{{0, 0, -1}, 1e6}), HasSubstr("no region"));
  const std::uint32_t box = Spawn(Box({1, 1, 1}, 500.0));
  EXPECT_THAT(message(wire::DriveBody{box, {1.0}, {}}), HasSubstr("has 0 thrusters"));
  EXPECT_THAT(message(wire::AddRope{{{box, {}}, {0, {40, 0, 0}}, 10.0}}),
              HasSubstr("rope.length_m: 10, but its ends are 40"));
  EXPECT_FALSE(PrepareBody(Box({1, 1, 1}, 0.0)).ok());
}

// What an encoder of frames refuses would end the server.
TEST_F(WorldTest, RegionsAlwaysFitTheWire) {
  const auto add = [this](int cells, double cell_m, Vec2d middle) {
    wire::RegionSpec spec = Square(cells);
    spec.cell_m = cell_m;
    spec.middle_m = middle;
    return world_.Apply(wire::AddRegion{spec}).status();
  };
  EXPECT_EQ(add(128, 0.5, {-9.99999e6, 0}).code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(add(128, 1000.0, {0, 9.95e6}).code(), absl::StatusCode::kInvalidArgument);
  EXPECT_TRUE(add(128, 0.5, {-9.9e6, 9.9e6}).ok());
  for (int n = 0; n < 3; ++n) EXPECT_TRUE(add(1024, 0.5, {2000.0 * n, 0}).ok()) << n;
  const absl::Status too_many = add(1024, 0.5, {9000, 0});
  EXPECT_EQ(too_many.code(), absl::StatusCode::kResourceExhausted);
  EXPECT_THAT(std::string(too_many.message()), HasSubstr("4194304"));
  Run(1);
  wire::WorldEncoder encoder(1.0 / 60);
  const wire::WorldUpdate update = encoder.Encode({.tick = 1,
                                                   .interaction = world_.view()->interaction.get(),
                                                   .streaming = world_.view()->streaming,
                                                   .bodies = {},
                                                   .water_level_m = 0.0,
                                                   .spray = {}});
  ASSERT_TRUE(update.tiles.layout.has_value());
  EXPECT_TRUE(wire::ValidateLayout(*update.tiles.layout).ok());
  EXPECT_EQ(update.tiles.layout->size(), 4u);
}

TEST_F(WorldTest, OverlappingObstaclesAreFilledOnce) {
  Obstacles obstacles;
  obstacles.Set(1, {{0, 0}, {4, 0}, {4, 2}, {0, 2}});
  obstacles.Set(2, {{2, 1}, {3, 1}, {3, 30}, {2, 30}});
  const sea::CellRect region{.west = -2, .south = -2, .columns = 64, .rows = 64, .cell_m = 0.5};
  const Obstacles::Cells& cells = obstacles.CellsIn(region);
  const std::vector<std::vector<Vec2d>> polygons = {{{0, 0}, {4, 0}, {4, 2}, {0, 2}},
                                                    {{2, 1}, {3, 1}, {3, 30}, {2, 30}}};
  std::vector<std::size_t> expected;
  for (std::size_t n = 0; n < region.cells(); ++n) {
    const Vec2d place =
        region.PlaceOf(-2 + static_cast<int>(n % 64), -2 + static_cast<int>(n / 64));
    if (InsidePolygon(polygons[0], place) || InsidePolygon(polygons[1], place)) {
      expected.push_back(n);
    }
  }
  EXPECT_EQ(cells.index, expected);
  EXPECT_GT(expected.size(), 60u);
}

TEST_F(WorldTest, ObstaclesStandStill) {
  AddRegion(Square(64));
  ASSERT_TRUE(world_.Apply(wire::SetObstacle{0, {{4, -10}, {6, -10}, {6, 10}, {4, 10}}}).ok());
  Run(5);
  ASSERT_TRUE(world_.Apply(wire::Explode{{-3, 0, -1}, 1e5}).ok());
  double before = 0, behind = 0;
  for (int n = 0; n < 240; ++n) {
    Run(1);
    before = std::max(before, std::abs(HeightAt({1, 0})));
    behind = std::max(behind, std::abs(HeightAt({9, 0})));
  }
  EXPECT_GT(before, 0.05);
  EXPECT_LT(behind, 0.5 * before);
}

TEST_F(WorldTest, AWakeStaysWhenItsBodyGoes) {
  const std::uint32_t boat = Spawn(Boat(), {40, 0});
  AddRegion(Square(64, boat));
  Run(300);
  const sea::CellRect before = world_.view()->interaction->fields[0]->cells;
  ASSERT_TRUE(world_.Apply(wire::RemoveBody{boat}).ok());
  Run(5);
  EXPECT_EQ(world_.view()->interaction->fields[0]->cells, before);
  EXPECT_GT(std::abs(HeightAt({40, 0})), 0.01);  // the hole that it leaves
}

TEST_F(WorldTest, RemovedBodiesAreGone) {
  const std::uint32_t id = Spawn(Box({1, 1, 1}, 500.0));
  Run(10);
  ASSERT_TRUE(world_.Apply(wire::RemoveBody{id}).ok());
  EXPECT_TRUE(world_.view()->empty());
  Run(10);
  EXPECT_TRUE(world_.view()->empty());
}

}  // namespace
}  // namespace onesea::world
