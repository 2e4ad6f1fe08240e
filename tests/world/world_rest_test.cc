// Boats that people leave behind: their regions are given back and come back. Ropes as the world
// tells of them.
#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "tests/world/world_scene.h"

namespace onesea::world {
namespace {

using ::testing::HasSubstr;

constexpr double kRestAfterS = 3.0;
constexpr int kTicks = 181;  // of that

wire::RegionSpec Following(std::uint32_t body, int cells = 64) {
  wire::RegionSpec region = Square(cells, body);
  region.rest_after_s = kRestAfterS;
  return region;
}

std::size_t Regions(const World& world) { return world.view()->interaction->fields.size(); }

TEST_F(WorldTest, ARegionIsGivenBackWhileItsBoatIsAtRest) {
  const std::uint32_t boat = Spawn(Boat());
  AddRegion(Following(boat));
  Run(kTicks);
  EXPECT_EQ(Regions(world_), 1u);
  Run(1);
  EXPECT_EQ(Regions(world_), 0u);
  // Whoever takes the helm has it back at once, and for as long as the motor runs.
  ASSERT_TRUE(world_.Apply(wire::DriveBody{boat, {0.3}, {0.0}}).ok());
  Run(1);
  EXPECT_EQ(Regions(world_), 1u);
  Run(3 * kTicks);
  EXPECT_EQ(Regions(world_), 1u);
  // Without the motor it stays until the boat has lost its way.
  ASSERT_TRUE(world_.Apply(wire::DriveBody{boat, {0.0}, {0.0}}).ok());
  Run(kTicks);
  EXPECT_GT(Norm(StateOf(boat).velocity_m_per_s), 0.3);
  EXPECT_EQ(Regions(world_), 1u);
  Run(40 * 60);
  EXPECT_EQ(Regions(world_), 0u);
}

TEST_F(WorldTest, CommandsAndBlowsWakeARegion) {
  const std::uint32_t boat = Spawn(Boat());
  AddRegion(Following(boat));
  const auto rests_again = [&] {
    Run(30 * 60);
    return Regions(world_) == 0u;
  };
  ASSERT_TRUE(rests_again());
  // A lease that is taken, and used every now and then.
  for (int n = 0; n < 3; ++n) {
    ASSERT_TRUE(world_.Apply(wire::TakeLease{boat, "somebody", 60.0}).ok());
    Run(kTicks);
    EXPECT_EQ(Regions(world_), 1u);
  }
  ASSERT_TRUE(rests_again());
  ASSERT_TRUE(world_.Apply(wire::ApplyImpulse{boat, {3000.0, 0, 0}, std::nullopt}).ok());
  Run(1);
  EXPECT_EQ(Regions(world_), 1u);
  ASSERT_TRUE(rests_again());
  // Another one runs it over at full speed; the boat has no command of its own.
  const std::uint32_t other = Spawn(Boat(), {-30, 0.5});
  ASSERT_TRUE(world_.Apply(wire::DriveBody{other, {1.0}, {0.0}}).ok());
  std::size_t most = 0;
  for (int n = 0; n < 20 * 60; ++n) {
    Run(1);
    most = std::max(most, Regions(world_));
  }
  EXPECT_EQ(most, 1u);
}

TEST_F(WorldTest, RegionsThatDoNotAskForItStay) {
  const std::uint32_t boat = Spawn(Boat());
  AddRegion(Square(64, boat));
  Run(10 * kTicks);
  EXPECT_EQ(Regions(world_), 1u);
}

// Waves carry a boat to and fro; that is no way through the water.
TEST_F(WorldTest, ABoatThatWavesRockIsAtRest) {
  const auto sea =
      sea::FakeSea({.lengths_m = {97.0}, .index_max = 4, .hs_m = 1.5, .query_grid_size = 64});
  const std::uint32_t boat = Spawn(Boat());
  AddRegion(Following(boat));
  double fastest = 0.0;
  for (Tick tick = 1; tick <= 40 * 60; ++tick) {
    world_.Step(tick, sea);
    const Vec3d velocity = StateOf(boat).velocity_m_per_s;
    fastest = std::max(fastest, std::hypot(velocity.x, velocity.y));
  }
  EXPECT_GT(fastest, 0.5);  // else this proves nothing
  EXPECT_EQ(Regions(world_), 0u);
}

// Forty people come, drive and go, one after the other; the next one still gets a region.
TEST_F(WorldTest, ThoseWhoCameAndWentLeaveRoom) {
  for (int n = 0; n < 40; ++n) {
    const std::uint32_t boat = Spawn(Boat(), {60.0 * n, 0});
    AddRegion(Following(boat));
    Run(kTicks / 6);
  }
  EXPECT_LE(Regions(world_), 7u);
  EXPECT_GE(Regions(world_), 6u);
  // All of them at once: those who come first get the sixteen there are, no more.
  for (std::uint32_t boat = 1; boat <= 40; ++boat) {
    ASSERT_TRUE(world_.Apply(wire::DriveBody{boat, {0.2}, {0.0}}).ok());
  }
  Run(1);
  EXPECT_EQ(Regions(world_), static_cast<std::size_t>(kRegionsMax));
  const auto refused = world_.Apply(wire::AddRegion{Square(64)});
  EXPECT_EQ(refused.status().code(), absl::StatusCode::kResourceExhausted);
  // The last one was there all the time and keeps its place.
  EXPECT_NE(world_.view()->interaction->fields.size(), 0u);
  const Vec3d last = StateOf(40).position_m;
  const auto covers = [&](Vec3d place) {
    for (const auto& field : world_.view()->interaction->fields) {
      const sea::CellRect& cells = field->cells;
      const Vec2d low = cells.PlaceOf(cells.west, cells.south);
      const Vec2d high = cells.PlaceOf(cells.east(), cells.north());
      if (place.x > low.x && place.x < high.x && place.y > low.y && place.y < high.y) return true;
    }
    return false;
  };
  EXPECT_TRUE(covers(last));
}

// Whoever comes when all are taken waits for the first that is given back.
TEST_F(WorldTest, TheSeventeenthBoatWaitsForItsRegion) {
  for (int n = 0; n < 17; ++n) {
    const std::uint32_t boat = Spawn(Boat(), {100.0 * n, 0});
    ASSERT_TRUE(world_.Apply(wire::DriveBody{boat, {0.01}, {0.0}}).ok());
    AddRegion(Following(boat));
  }
  Run(1);
  EXPECT_EQ(Regions(world_), static_cast<std::size_t>(kRegionsMax));
  EXPECT_EQ(HeightAt({1600, 0}), 0.0);
  Run(60);
  EXPECT_EQ(HeightAt({1600, 0}), 0.0);
  EXPECT_NE(HeightAt({800, 0}), 0.0);
  ASSERT_TRUE(world_.Apply(wire::DriveBody{9, {0.0}, {0.0}}).ok());  // the one there
  Run(kTicks + 1);
  EXPECT_EQ(Regions(world_), static_cast<std::size_t>(kRegionsMax));
  Run(60);
  EXPECT_NE(HeightAt({1600, 0}), 0.0);
  EXPECT_EQ(HeightAt({800, 0}), 0.0);
  // A place in the world where no region fits is refused at once, room or not.
  const std::uint32_t far = Spawn(Boat(), {9.99999e6, 0});
  EXPECT_EQ(world_.Apply(wire::AddRegion{Following(far)}).status().code(),
            absl::StatusCode::kInvalidArgument);
}

TEST_F(WorldTest, ARemovedBoatsRegionGoesToo) {
  const std::uint32_t boat = Spawn(Boat());
  AddRegion(Following(boat));
  Run(10);
  ASSERT_TRUE(world_.Apply(wire::RemoveBody{boat}).ok());
  Run(kTicks - 2);
  EXPECT_EQ(Regions(world_), 1u);  // its wake goes on
  Run(3);
  EXPECT_EQ(Regions(world_), 0u);
  EXPECT_TRUE(world_.view()->empty());
}

// A region that comes back finds a hull there: it makes room as slowly as for a new one.
TEST_F(WorldTest, ARegionComesBackWithoutASplash) {
  const std::uint32_t boat = Spawn(Boat());
  AddRegion(Following(boat, 128));
  Run(20 * 60);
  ASSERT_EQ(Regions(world_), 0u);
  ASSERT_TRUE(world_.Apply(wire::TakeLease{boat, "somebody", 60.0}).ok());
  double highest = 0.0;
  for (int n = 0; n < 5 * 60; ++n) {
    if (n % 60 == 0) {
      ASSERT_TRUE(world_.Apply(wire::TakeLease{boat, "somebody", 60.0}).ok());
    }
    Run(1);
    highest = std::max(highest, std::abs(HeightAt({0, 8})));
  }
  EXPECT_EQ(Regions(world_), 1u);
  EXPECT_LT(highest, 0.02);
}

TEST(WorldRest, ReplaysAndGoesOnAfterItWasSaved) {
  const auto calm = Calm();
  const auto begin = [](World& world) {
    for (int n = 0; n < 3; ++n) {
      ASSERT_TRUE(world.Spawn(*PrepareBody(Boat()), AfloatAt({50.0 * n, 0})).ok());
      ASSERT_TRUE(world.Apply(wire::AddRegion{Following(static_cast<std::uint32_t>(n + 1))}).ok());
    }
  };
  const auto advance = [&](World& world, Tick from, Tick to) {
    std::vector<std::uint64_t> hashes;
    for (Tick tick = from; tick <= to; ++tick) {
      if (tick == 100) {
        EXPECT_TRUE(world.Apply(wire::DriveBody{2, {0.5}, {0.0}}).ok());
      }
      if (tick == 300) {
        EXPECT_TRUE(world.Apply(wire::DriveBody{3, {0.1}, {0.0}}).ok());
      }
      if (tick == 400) {
        EXPECT_TRUE(world.Apply(wire::RemoveBody{2}).ok());
      }
      world.Step(tick, calm);
      hashes.push_back(world.Hash());
    }
    return hashes;
  };
  World a{WorldOptions{}}, b{WorldOptions{}}, restored{WorldOptions{}};
  begin(a), begin(b);
  EXPECT_EQ(advance(a, 1, 250), advance(b, 1, 250));
  EXPECT_EQ(Regions(a), 1u);
  const auto saved = a.Save();
  ASSERT_TRUE(restored.Restore(*saved).ok());
  const auto hashes = advance(a, 251, 700);
  EXPECT_EQ(advance(restored, 251, 700), hashes);
  EXPECT_EQ(Regions(a), 1u);  // of the third boat; the second one's has ended
}

TEST_F(WorldTest, TheViewListsItsRopes) {
  const std::uint32_t boat = Spawn(Boat());
  Run(1);
  EXPECT_EQ(world_.view()->ropes, nullptr);
  const wire::RopeSpec mooring{{boat, {3, 0, 0}}, {0, {9, 0, 1}}, 8.0};
  const auto rope = world_.Apply(wire::AddRope{mooring});
  ASSERT_TRUE(rope.ok()) << rope.status();
  const wire::RopeList list = world_.view()->ropes;
  ASSERT_NE(list, nullptr);
  EXPECT_EQ(*list, (std::vector<wire::TiedRope>{{*rope, mooring}}));
  ASSERT_TRUE(world_.Apply(wire::DriveBody{boat, {0.1}, {0.0}}).ok());
  Run(3);
  EXPECT_EQ(world_.view()->ropes, list);  // the same object: nothing to tell
  const auto saved = world_.Save();
  ASSERT_TRUE(world_.Apply(wire::RemoveBody{boat}).ok());
  EXPECT_EQ(world_.view()->ropes, nullptr);
  ASSERT_TRUE(world_.Restore(*saved).ok());
  ASSERT_NE(world_.view()->ropes, nullptr);
  EXPECT_EQ(*world_.view()->ropes, *list);
  ASSERT_TRUE(world_.Apply(wire::RemoveRope{*rope}).ok());
  EXPECT_EQ(world_.view()->ropes, nullptr);
}

// A start at z = 0 means afloat, on the tide of that moment.
TEST_F(WorldTest, BodiesBeginOnTheTide) {
  const auto box = Box({4, 2, 1}, 4100.0);  // floats with its centre 0.2 m under the water
  wire::WorldSpec spec;
  spec.water_level = {{0.0, 3.0}, {2.0, 3.0}, {4.0, 5.0}};
  spec.bodies.push_back({box, AfloatAt({0, 0})});
  ASSERT_TRUE(world_.Begin(spec).ok());
  EXPECT_NEAR(StateOf(1).position_m.z, 2.8, 0.01);
  Run(1);
  EXPECT_NEAR(StateOf(1).position_m.z, 2.8, 0.01);
  Run(239);
  const std::uint32_t late = Spawn(box, {20, 0});
  EXPECT_NEAR(StateOf(late).position_m.z, 4.8, 0.01);
  Run(1);
  EXPECT_NEAR(StateOf(late).position_m.z, 4.8, 0.01);
  EXPECT_LT(std::abs(StateOf(late).velocity_m_per_s.z), 0.05);
}

TEST_F(WorldTest, AnUnknownPresetIsRefusedByItsPlaceInTheFile) {
  wire::WorldSpec spec;
  wire::BodyDescription boat;
  boat.preset = "boat";
  spec.bodies.push_back({boat, AfloatAt({0, 0})});
  boat.preset = "galleon";
  spec.bodies.push_back({boat, AfloatAt({20, 0})});
  const absl::Status status = world_.Begin(spec);
  EXPECT_EQ(status.code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(
      std::string(status.message()),
      HasSubstr("world.bodies[1].body.preset: there is no body \"galleon\"; there are boat"));
}

}  // namespace
}  // namespace onesea::world
