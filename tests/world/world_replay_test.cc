// The same commands give the same bits: again, on any thread, and after a world was saved.
#include <cmath>
#include <thread>
#include <vector>

#include "tests/world/world_scene.h"

namespace onesea::world {
namespace {

std::shared_ptr<const sea::Terrain> Beach() {
  auto terrain = std::make_shared<sea::Terrain>();
  terrain->west_m = terrain->south_m = -60.0;
  terrain->cell_m = 4.0;
  terrain->columns = terrain->rows = 31;
  for (int n = 0; n < 31 * 31; ++n) {
    terrain->elevation_m.push_back(-6.0f + 0.25f * static_cast<float>(n % 31));
  }
  return terrain;
}

std::shared_ptr<const sea::Components> Choppy() {
  return sea::FakeSea(
      {.lengths_m = {97.0, 31.0}, .index_max = 6, .hs_m = 0.4, .query_grid_size = 64});
}

WorldOptions OverABeach() {
  WorldOptions options;
  options.depth_m = 6.0;
  options.terrain = Beach();
  return options;
}

PreparedBody Ready(const wire::BodyDescription& body) {
  const auto prepared = PrepareBody(body);
  EXPECT_TRUE(prepared.ok()) << prepared.status();
  return *prepared;
}

// All that there is: three solvers, one of them following, rain, a wall, boats, a pile of crates
// that touch, one body whose waves are the grid's.
void Furnish(World& world) {
  const auto spawn = [&](const wire::BodyDescription& body, Vec3d place) {
    wire::Kinematics start;
    start.position_m = place;
    EXPECT_TRUE(world.Spawn(Ready(body), start).ok());
  };
  spawn(Boat(), {-40, -20, 0});
  for (int n = 0; n < 6; ++n) spawn(Box({1, 1, 1}, 400.0), {-30.0 + 0.9 * n, -5.0, 0.4 * n});
  wire::BodyDescription radiating = Box({3, 2, 1}, 2000.0);
  radiating.radiation = wire::Radiation::kGrid;
  spawn(radiating, {-20, 15, 0.2});
  wire::RegionSpec follows = Square(96, 1);
  follows.rain_drops_per_m2_s = 0.3;
  wire::RegionSpec wave = Square(64), shallow = Square(64);
  wave.solver = wire::RegionSolver::kWaveEquation;
  wave.middle_m = {-22, 14};
  wave.damping_per_s = 0.4;
  shallow.solver = wire::RegionSolver::kShallowWater;
  shallow.middle_m = {20, 0};
  for (const wire::RegionSpec& region : {follows, wave, shallow}) {
    EXPECT_TRUE(world.Apply(wire::AddRegion{region}).ok());
  }
  EXPECT_TRUE(
      world.Apply(wire::SetObstacle{0, {{-30, -12}, {-26, -12}, {-26, -10}, {-30, -10}}}).ok());
  EXPECT_TRUE(world.Apply(wire::DriveBody{1, {0.9}, {0.2}}).ok());
}

// What people do at some ticks.
void Command(World& world, Tick tick) {
  if (tick == 40) {
    EXPECT_TRUE(world.Apply(wire::Explode{{20, 2, -1}, 3e5}).ok());
  }
  if (tick == 70) {
    EXPECT_TRUE(world.Apply(wire::DriveBody{1, {0.5}, {-0.4}}).ok());
  }
  if (tick == 160) {
    EXPECT_TRUE(world.Apply(wire::RemoveBody{3}).ok());
  }
}

std::vector<std::uint64_t> Advance(World& world, Tick from, Tick to,
                                   const std::shared_ptr<const sea::Components>& sea) {
  std::vector<std::uint64_t> hashes;
  for (Tick tick = from; tick <= to; ++tick) {
    Command(world, tick);
    world.Step(tick, sea);
    hashes.push_back(world.Hash());
  }
  return hashes;
}

TEST(WorldReplay, SameHashesOnTwoThreadsAtOnce) {
  const auto sea = Choppy();
  std::vector<std::uint64_t> hashes[3];
  const auto run = [&](int which) {
    World world(OverABeach());
    Furnish(world);
    hashes[which] = Advance(world, 1, 200, sea);
  };
  run(0);
  std::thread one([&] { run(1); }), other([&] { run(2); });
  one.join();
  other.join();
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
  for (std::size_t n = 1; n < hashes[0].size(); ++n) EXPECT_NE(hashes[0][n], hashes[0][n - 1]);
}

TEST(WorldReplay, GoesOnTheSameAfterItWasSaved) {
  const auto sea = Choppy();
  World whole(OverABeach());
  Furnish(whole);
  // In the middle of a second, with crates that touch, wakes and wet foam.
  Advance(whole, 1, 95, sea);
  const auto saved = whole.Save();
  World restored(OverABeach());
  ASSERT_TRUE(restored.Restore(*saved).ok());
  EXPECT_EQ(restored.Hash(), whole.Hash());
  EXPECT_EQ(restored.view()->bodies.size(), whole.view()->bodies.size());
  EXPECT_EQ(restored.view()->interaction->fields.size(), whole.view()->interaction->fields.size());
  const std::vector<std::uint64_t> hashes = Advance(whole, 96, 260, sea);
  EXPECT_EQ(Advance(restored, 96, 260, sea), hashes);
  // And again from the same state, into a world that has gone elsewhere.
  ASSERT_TRUE(restored.Restore(*saved).ok());
  EXPECT_EQ(Advance(restored, 96, 260, sea), hashes);
}

TEST(WorldReplay, EachPartOfTheStateShowsInTheHash) {
  const auto sea = Choppy();
  World a(OverABeach()), b(OverABeach());
  Furnish(a), Furnish(b);
  Advance(a, 1, 20, sea), Advance(b, 1, 20, sea);
  ASSERT_EQ(a.Hash(), b.Hash());
  ASSERT_TRUE(b.Apply(wire::ApplyImpulse{2, {1e-6, 0, 0}, std::nullopt}).ok());
  EXPECT_NE(a.Hash(), b.Hash());
}

}  // namespace
}  // namespace onesea::world
