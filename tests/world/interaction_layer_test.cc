#include "server/world/interaction_layer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/sea/constants.h"
#include "hwy/targets.h"

namespace onesea::world {
namespace {

RegionAsk Ask(std::uint64_t id, double x_m, double y_m, int side = 128) {
  return {.id = id, .columns = side, .rows = side, .centre_m = {x_m, y_m}};
}

double Volume(InteractionLayer& layer) {
  double sum = 0.0;
  const auto snapshot = layer.Snapshot(0);
  for (const auto& field : snapshot->fields) {
    for (const float height : field->height_m) {
      sum += static_cast<double>(height) * field->cells.cell_m * field->cells.cell_m;
    }
  }
  return sum;
}

double HeightAt(InteractionLayer& layer, Vec2d place) {
  return SampleInteraction(*layer.Snapshot(0), place).height_m;
}

void Splash(InteractionLayer& layer, Vec2d place, int steps) {
  EXPECT_TRUE(layer.AddSource(place, 3.0, 2.0));
  for (int n = 0; n < steps; ++n) layer.Step();
}

TEST(InteractionLayer, AnExplosionAddsItsWater) {
  InteractionLayer layer({});
  ASSERT_TRUE(layer.Place(std::vector{Ask(1, 10, 20)}).ok());
  EXPECT_TRUE(layer.AddSource({12.3, 19.1}, 4.0, 7.5));
  layer.Step();
  EXPECT_NEAR(Volume(layer), 7.5, 2e-3);  // the border takes the first of it
  EXPECT_GT(HeightAt(layer, {12.3, 19.1}), 0.3);
}

// A pressed surface sinks by the weight's water: Archimedes, once the waves have left.
TEST(InteractionLayer, AWeightDisplacesItsWater) {
  InteractionLayer layer({.depth_m = 4.0, .damping_per_s = 1.0});
  ASSERT_TRUE(layer.Place(std::vector{Ask(1, 0, 0)}).ok());
  const double volume_m3 = 3.0;
  for (int n = 0; n < 1800; ++n) {
    EXPECT_TRUE(
        layer.AddPressure({0, 0}, 5.0, volume_m3 * sea::kWaterDensityKgPerM3 * sea::kGravity));
    layer.Step();
  }
  double displaced = 0.0;
  const auto snapshot = layer.Snapshot(0);
  for (double x = -6.0; x <= 6.0; x += 0.5) {
    for (double y = -6.0; y <= 6.0; y += 0.5) {
      displaced -= 0.25 * SampleInteraction(*snapshot, {x, y}).height_m;
    }
  }
  EXPECT_NEAR(displaced, volume_m3, 0.05 * volume_m3);
}

TEST(InteractionLayer, WavesStayWhenTheirRegionMovesGrowsOrMerges) {
  InteractionLayer layer({});
  ASSERT_TRUE(layer.Place(std::vector{Ask(1, 0, 0)}).ok());
  Splash(layer, {4.0, 2.0}, 60);
  ASSERT_TRUE(layer.AddFoam({4.0, 2.0}, 3.0, 0.9));
  std::vector<Vec2d> places;
  for (double x = -5.0; x < 15.0; x += 2.3) {
    for (double y = -8.0; y < 9.0; y += 1.7) places.push_back({x, y});
  }
  const auto before = layer.Snapshot(0);
  const double volume = Volume(layer);
  for (const auto& asks : {std::vector{Ask(1, 16, 0)}, std::vector{Ask(1, 16, 0, 192)},
                           std::vector{Ask(1, 16, 0, 192), Ask(2, 40, 10)}}) {
    ASSERT_TRUE(layer.Place(asks).ok());
    const auto after = layer.Snapshot(0);
    for (const Vec2d place : places) {
      const sea::InteractionSample was = SampleInteraction(*before, place);
      EXPECT_NEAR(SampleInteraction(*after, place).height_m, was.height_m, 1e-9);
      EXPECT_NEAR(SampleInteraction(*after, place).foam, was.foam, 1e-9);
    }
    EXPECT_NEAR(Volume(layer), volume, 0.06);  // the strip that is left behind holds the rest
  }
  EXPECT_EQ(layer.regions().size(), 1u);
}

// Two boats part: their common region splits into two that overlap. Each wave goes into one.
TEST(InteractionLayer, ASplitKeepsEachWaveOnce) {
  InteractionLayer layer({});
  ASSERT_TRUE(layer.Place(std::vector{Ask(1, 0, 0), Ask(2, 16, 16)}).ok());
  ASSERT_EQ(layer.regions().size(), 1u);
  Splash(layer, {20.0, 20.0}, 30);
  const double volume = Volume(layer);
  const double height = HeightAt(layer, {20.0, 20.0});
  ASSERT_TRUE(layer.Place(std::vector{Ask(1, 0, 0), Ask(2, 48, 48)}).ok());
  ASSERT_EQ(layer.regions().size(), 2u);
  EXPECT_NEAR(HeightAt(layer, {20.0, 20.0}), height, 1e-6);
  EXPECT_NEAR(Volume(layer), volume, 0.06);
  // A deposit in the overlap enters one region.
  ASSERT_TRUE(layer.AddSource({24.0, 24.0}, 2.0, 5.0));
  layer.Step();
  EXPECT_NEAR(Volume(layer), volume + 5.0, 0.1);
}

TEST(InteractionLayer, ReplaysFromAState) {
  const auto drive = [](InteractionLayer& layer, int from, int to) {
    for (int n = from; n < to; ++n) {
      const double x = 0.05 * n;
      EXPECT_TRUE(layer.Place(std::vector{Ask(1, x, 0), Ask(2, 60, 0, 64)}).ok());
      EXPECT_TRUE(layer.AddPressure({x, 0.0}, 1.5, 2e4));
      EXPECT_TRUE(layer.AddFoam({x, 0.0}, 1.0, 0.1));
      if (n == 150) {
        EXPECT_TRUE(layer.AddSource({58.0, 1.0}, 2.0, 1.0));
      }
      layer.Step();
    }
  };
  InteractionLayer whole({}), first({}), second({});
  drive(whole, 0, 500);
  drive(first, 0, 260);
  const InteractionState state = first.State();
  ASSERT_TRUE(second.Restore(state).ok());
  EXPECT_EQ(second.Hash(), first.Hash());
  drive(second, 260, 500);
  EXPECT_EQ(second.Hash(), whole.Hash());
  InteractionState wrong = state;
  wrong.regions[0].waves.pop_back();
  EXPECT_FALSE(second.Restore(wrong).ok());
}

TEST(InteractionLayer, FoamGrowsWhereItIsSteepDriftsAndFades) {
  InteractionLayer layer({});
  ASSERT_TRUE(layer.Place(std::vector{Ask(1, 0, 0)}).ok());
  ASSERT_TRUE(layer.AddSource({0, 0}, 2.5, 20.0));
  double greatest = 0.0;
  for (int n = 0; n < 120; ++n) {
    layer.Step();
    const auto snapshot = layer.Snapshot(0);
    if (snapshot->fields[0]->foam == nullptr) continue;
    for (const float share : *snapshot->fields[0]->foam) {
      ASSERT_GE(share, 0.0f);
      ASSERT_LE(share, 1.0f);
      greatest = std::max(greatest, static_cast<double>(share));
    }
  }
  EXPECT_GT(greatest, 0.2);
  for (int n = 0; n < 60 * 60; ++n) layer.Step();
  EXPECT_EQ(SampleInteraction(*layer.Snapshot(0), {0, 0}).foam, 0.0);
}

TEST(InteractionLayer, NonsenseIsRefusedAndHarmsNobody) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  InteractionLayer layer({});
  const absl::Status placed = layer.Place(std::vector{Ask(1, nan, 0), Ask(2, 0, 0)});
  EXPECT_FALSE(placed.ok());
  EXPECT_EQ(layer.regions().size(), 1u);
  EXPECT_FALSE(layer.AddSource({nan, 0}, 1.0, 1.0));
  EXPECT_FALSE(layer.AddSource({0, 0}, 1.0, nan));
  EXPECT_FALSE(layer.AddPressure({0, 0}, nan, 1.0));
  EXPECT_FALSE(layer.AddSource({1e6, 0}, 1.0, 1.0));
  EXPECT_FALSE(layer.AddFoam({0, -1e300}, 1.0, 1.0));
  layer.Step();
  EXPECT_EQ(Volume(layer), 0.0);
  // The wave equation has no speed in infinitely deep water.
  RegionAsk ask = Ask(3, 300, 0);
  ask.kind = SolverKind::kWaveEquation;
  EXPECT_FALSE(layer.Place(std::vector{ask, Ask(2, 0, 0)}).ok());
  EXPECT_EQ(layer.regions().size(), 1u);
}

TEST(InteractionLayer, ForcesBeyondMeasureHarmOneRegionForAMoment) {
  InteractionLayer layer({});
  ASSERT_TRUE(layer.Place(std::vector{Ask(1, 0, 0), Ask(2, 300, 0)}).ok());
  ASSERT_TRUE(layer.AddSource({300, 0}, 2.0, 1.0));
  ASSERT_TRUE(layer.AddPressure({0, 0}, 2.0, 1e45));
  for (int n = 0; n < 12; ++n) layer.Step();
  EXPECT_EQ(layer.resets(), 1);
  EXPECT_EQ(HeightAt(layer, {0, 0}), 0.0);
  EXPECT_NE(HeightAt(layer, {300, 0}), 0.0);
}

// A beach without a transcendental function in its making.
std::shared_ptr<const sea::Terrain> Beach() {
  auto terrain = std::make_shared<sea::Terrain>();
  terrain->west_m = terrain->south_m = -40.0;
  terrain->cell_m = 4.0;
  terrain->columns = terrain->rows = 21;
  for (int n = 0; n < 21 * 21; ++n) {
    const float x = static_cast<float>(n % 21), y = static_cast<float>(n / 21);
    terrain->elevation_m.push_back(-6.0f + 0.02f * x * x - 0.03f * y);
  }
  return terrain;
}

// All kinds, a moving region, deposits, foam and terrain: one hash, whatever the SIMD target,
// compiler, optimisation and machine. It may change only with a commit that says why.
TEST(InteractionLayer, HasOneHashEverywhere) {
  const auto run = [](const std::shared_ptr<const sea::Terrain>& terrain) {
    InteractionLayer layer({.depth_m = 3.0, .terrain = terrain});
    RegionAsk wave = Ask(2, 0, 0, 64), shallow = Ask(3, -20, 10, 64);
    wave.kind = SolverKind::kWaveEquation;
    shallow.kind = SolverKind::kShallowWater;
    for (int n = 0; n < 60; ++n) {
      const double x = -6.0 + 0.25 * n;
      EXPECT_TRUE(layer.Place(std::vector{Ask(1, x, 0, 64), wave, shallow}).ok());
      EXPECT_TRUE(layer.AddPressure({x, 1.0}, 1.5, 3e4));
      EXPECT_TRUE(layer.AddFoam({x, 1.0}, 1.0, 0.2));
      EXPECT_TRUE(layer.AddSolid({-3.0, 4.0}, 1.2, 0.01));
      if (n % 20 == 5) {
        EXPECT_TRUE(layer.AddSource({2.0, -3.0}, 2.0, 6.0));
      }
      layer.Step();
    }
    return layer.Hash();
  };
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    EXPECT_EQ(run(Beach()), 0xc4c98abfa410000eu) << hwy::TargetName(target);
    EXPECT_EQ(run(nullptr), 0x30f0473445f6bbe0u) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace onesea::world
