// Patches against the snapshot that they were taken from and against the exact sum below the
// surface.
#include "server/world/body_water.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/sea/fake_sea.h"

namespace onesea::world {
namespace {

WaterUnder Round(Vec2d centre_m, double radius_m) {
  return {.centre_m = centre_m, .half_m = {radius_m, radius_m}};
}

class BodyWaterTest : public ::testing::Test {
 protected:
  void SetUp() override {
    components_ = sea::FakeSea({.lengths_m = {613.0, 171.0, 47.0}, .hs_m = 2.0});
    snapshot_ = sea::SnapshotBuilder(components_).At(time_, sea::QueryDetail::kVelocity);
    wavenumbers_ = sea::BandWavenumbers(*components_, time_);
  }
  IncidentSea Sea() const {
    return {.waves = snapshot_.get(), .wavenumber_rad_per_m = wavenumbers_};
  }

  SimTime time_ = SimTime::FromSeconds(33.0);
  std::shared_ptr<sea::Components> components_;
  std::shared_ptr<const sea::SeaSnapshot> snapshot_;
  std::vector<double> wavenumbers_;
};

TEST_F(BodyWaterTest, SurfaceIsTheQueriedOne) {
  BodyWater water;
  water.Add(Round({10, -20}, 1.0));
  const std::size_t boat =
      water.Add({.centre_m = {-300, 155}, .half_m = {3, 3}, .is_in_grid = true});
  IncidentSea sea = Sea();
  sea.level_m = 0.75;
  water.Fill(sea);
  const WaterSampler sampler(water.patch(boat));
  for (double x = -302; x < -298; x += 0.7) {
    const Vec2d place{x, 155.4};
    sea::SurfaceSample queried;
    snapshot_->Sample({&place, 1}, {&queried, 1});
    const WaterPoint point = SampleWater(sampler, {place.x, place.y, -1.0});
    // Between samples 1.4 m apart the shortest waves are cut across.
    EXPECT_NEAR(point.depth_m, queried.height_m + 0.75 + 1.0, 0.05) << x;
    EXPECT_NEAR(water.incident(boat).At(place.x, place.y), queried.height_m + 0.75, 0.05) << x;
  }
}

// A long hull's samples lie along it.
TEST_F(BodyWaterTest, SamplesTurnWithTheHull) {
  BodyWater water;
  const Vec2d along{0.6, 0.8};
  water.Add({.centre_m = {40, -10}, .half_m = {3, 1}, .along = along});
  water.Fill(Sea());
  const WaterPatch& patch = water.patch(0);
  EXPECT_EQ(patch.columns, 6);
  EXPECT_EQ(patch.rows, 3);
  const WaterSampler sampler(patch);
  for (int n = -3; n <= 3; ++n) {
    for (const double aside : {-1.0, 0.0, 1.0}) {
      const Vec2d place{40 + n * along.x - aside * along.y, -10 + n * along.y + aside * along.x};
      sea::SurfaceSample queried;
      snapshot_->Sample({&place, 1}, {&queried, 1});
      const WaterPoint point = SampleWater(sampler, {place.x, place.y, -1.0});
      EXPECT_NEAR(point.depth_m, queried.height_m + 1.0, 0.05) << n << " " << aside;
    }
  }
}

TEST_F(BodyWaterTest, PressureFadesWithDepthAsTheExactSum) {
  BodyWater water;
  double error2 = 0.0, wave2 = 0.0, unfaded2 = 0.0;
  std::vector<Vec2d> places;
  for (int n = 0; n < 40; ++n) places.push_back({37.0 * n, 11.0 * n});
  for (const Vec2d& place : places) water.Add(Round(place, 1.0));
  water.Fill(Sea());
  for (std::size_t n = 0; n < places.size(); ++n) {
    const double depth_m = 4.0;
    sea::DepthSample exact;
    sea::SampleAtDepth(*components_, time_, {&places[n], 1}, {&depth_m, 1}, {&exact, 1});
    const WaterPoint point =
        SampleWater(WaterSampler(water.patch(n)), {places[n].x, places[n].y, -depth_m});
    const double dynamic_head = point.head_m - depth_m;
    const double exact_head =
        exact.dynamic_pressure_pa / (sea::kWaterDensityKgPerM3 * sea::kGravity);
    error2 += (dynamic_head - exact_head) * (dynamic_head - exact_head);
    wave2 += exact_head * exact_head;
    const double unfaded_head = point.depth_m - depth_m;
    unfaded2 += (unfaded_head - exact_head) * (unfaded_head - exact_head);
  }
  // One wavenumber a band, and depth counted from the moving surface instead of the mean: 0.22 of
  // the wave's head. Without any fading it would be 0.41.
  EXPECT_LT(std::sqrt(error2 / wave2), 0.25) << std::sqrt(unfaded2 / wave2);
  EXPECT_GT(std::sqrt(unfaded2 / wave2), 0.35);
}

TEST_F(BodyWaterTest, InteractionLayerAddsItsHeightWithoutFading) {
  BodyWater water;
  water.Add(Round({0, 0}, 1.0));
  const std::vector<sea::InteractionFelt> interaction(water.points_m().size(), {0.25, {0.5, -0.1}});
  water.Fill({});
  water.AddInteraction(interaction);
  const WaterPoint point = SampleWater(WaterSampler(water.patch(0)), {0.1, 0.2, -3.0});
  EXPECT_NEAR(point.depth_m, 3.25, 1e-6);
  EXPECT_NEAR(point.head_m, 3.25, 1e-5);
  EXPECT_NEAR(point.velocity_m_per_s.x, 0.5, 1e-5);
  EXPECT_NEAR(point.velocity_m_per_s.y, -0.1, 1e-5);
  EXPECT_EQ(point.velocity_m_per_s.z, 0.0);
  // A body whose own waves the layer carries must not be moved by their velocity.
  water.Clear();
  water.Add({.centre_m = {}, .half_m = {1, 1}, .is_in_grid = true});
  water.Fill({});
  water.AddInteraction(interaction);
  EXPECT_NEAR(water.incident(0).At(0, 0), 0.0, 1e-9);  // what it displaces is counted from here
  EXPECT_EQ(SampleWater(WaterSampler(water.patch(0)), {0.1, 0.2, -3.0}).velocity_m_per_s.x, 0.0);
}

TEST_F(BodyWaterTest, MemoryIsUsedAgain) {
  BodyWater water;
  for (int tick = 0; tick < 3; ++tick) {
    water.Clear();
    water.Add(Round({1.0 * tick, 0}, 1.0));
    water.Fill(Sea());
    EXPECT_EQ(water.points_m().size(), 25u);
  }
}

TEST_F(BodyWaterTest, TheBottomIsThatOfThePlace) {
  const sea::Terrain slope{.west_m = -100,
                           .south_m = -100,
                           .cell_m = 200,
                           .columns = 2,
                           .rows = 2,
                           .elevation_m = {-20, 0, -20, 0}};
  BodyWater water;
  for (const double x : {-100.0, 0.0, 99.0, 300.0}) water.Add(Round({x, 0}, 1.0));
  IncidentSea sea = Sea();
  sea.depth_m = 15.0;
  sea.level_m = 0.5;
  sea.terrain = &slope;
  water.Fill(sea);
  EXPECT_NEAR(water.patch(0).depth_m, 15.5, 1e-9);
  EXPECT_NEAR(water.patch(1).depth_m, 10.5, 1e-9);
  EXPECT_NEAR(water.patch(2).depth_m, 0.6, 1e-9);
  EXPECT_NEAR(water.patch(3).depth_m, 0.5, 1e-9);
}

}  // namespace
}  // namespace onesea::world
