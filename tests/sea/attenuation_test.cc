#include "common/sea/attenuation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "common/base/hash.h"
#include "common/sea/recipe.h"

namespace onesea::sea {
namespace {

Recipe Swell(double hs_m, double tp_s, double depth_m, double to_rad = 0.0) {
  Recipe recipe;
  recipe.cascades = DefaultCascades();
  recipe.depth_m = depth_m;
  recipe.timeline.resize(1);
  JonswapSystem system;
  system.hs_m = hs_m;
  system.tp_s = tp_s;
  system.gamma = 7.0;
  system.wave_to_rad = to_rad;
  system.spreading = {.kind = SpreadingKind::kCosine2s, .exponent_s = 75.0};
  recipe.timeline[0].sea.systems = {system};
  return recipe;
}

Recipe OneRegularWave(double amplitude_m, double period_s) {
  Recipe recipe = Swell(0.01, 3.0, 0.0);
  recipe.timeline[0].sea.systems.clear();
  RegularWave wave;
  wave.amplitude_m = amplitude_m;
  wave.period_s = period_s;
  recipe.timeline[0].sea.regular_waves = {wave};
  return recipe;
}

constexpr double kWhole[] = {1.0};

// Oracle: the shoaling coefficient √(cg0 / cg) of linear theory, from independent tables.
TEST(Shoaling, RegularWavesShoalAsTheTablesSay) {
  struct Row {
    double period_s, depth_m, coefficient;
  };
  for (const Row row : {Row{4, 10, 0.976091}, Row{4, 3, 0.920437}, Row{4, 1, 1.064117},
                        Row{8, 20, 0.918108}, Row{8, 50, 0.990528}}) {
    const auto components = BuildComponents(OneRegularWave(1e-4, row.period_s)).value();
    const Shoaling shoaling(*components);
    const DepthFactors factors = shoaling.At(kWhole);
    ASSERT_EQ(factors.planes(), static_cast<int>(components->cascades.size()) + 1);
    EXPECT_NEAR(factors.At(factors.planes() - 1, row.depth_m), row.coefficient, 4e-3)
        << row.period_s << " s, " << row.depth_m << " m";
  }
}

TEST(Shoaling, NothingChangesAtTheRecipesDepth) {
  const auto components = BuildComponents(Swell(1.0, 8.0, 30.0)).value();
  const DepthFactors factors = Shoaling(*components).At(kWhole);
  for (int plane = 0; plane < factors.planes(); ++plane) {
    EXPECT_NEAR(factors.At(plane, 30.0), 1.0, 2e-3) << plane;
  }
}

// Of the whole sea, from the factors and the variances: never above the limit, gone at the shore.
TEST(Shoaling, SignificantHeightStaysBelowTheBreakersLimit) {
  const auto components = BuildComponents(Swell(4.0, 10.0, 0.0)).value();
  const DepthFactors factors = Shoaling(*components).At(kWhole);
  double last_hs_m = 0.0;
  for (double depth_m = 0.02; depth_m < 100.0; depth_m *= 1.1) {
    double m0 = 0.0;
    for (std::size_t c = 0; c < components->cascades.size(); ++c) {
      const auto& variance = components->cascades[c].variance_m2[0];
      const double factor = factors.At(static_cast<int>(c), depth_m);
      m0 += factor * factor * std::accumulate(variance.begin(), variance.end(), 0.0);
    }
    const double hs_m = 4.0 * std::sqrt(m0);
    EXPECT_LE(hs_m, 1.01 * kBreakerIndex * depth_m) << depth_m;
    if (depth_m < 5.0) {
      EXPECT_GT(hs_m, last_hs_m);
      EXPECT_GT(hs_m, 0.8 * kBreakerIndex * depth_m);
    }
    last_hs_m = hs_m;
  }
  EXPECT_NEAR(last_hs_m, 4.0, 0.1);
  EXPECT_EQ(factors.At(0, 0.0), 0.0);
  EXPECT_EQ(factors.At(0, -3.0), 0.0);
  EXPECT_EQ(factors.At(0, NAN), 0.0);
}

Terrain Sea(int side, double depth_m) {
  Terrain terrain{.west_m = -1000,
                  .south_m = -1000,
                  .cell_m = 10,
                  .columns = side,
                  .rows = side,
                  .elevation_m = std::vector<float>(side * side, static_cast<float>(-depth_m))};
  return terrain;
}

std::shared_ptr<const Terrain> Shared(Terrain terrain) {
  return std::make_shared<const Terrain>(std::move(terrain));
}

int SwellPlane(const Components& components) {
  int best = 0;
  double most = 0.0;
  for (std::size_t c = 0; c < components.cascades.size(); ++c) {
    const auto& v = components.cascades[c].variance_m2[0];
    const double m0 = std::accumulate(v.begin(), v.end(), 0.0);
    if (m0 > most) {
      most = m0;
      best = static_cast<int>(c);
    }
  }
  return best;
}

TEST(Attenuation, OpenWaterHasTheDepthsFactorEverywhere) {
  const auto components = BuildComponents(Swell(1.0, 8.0, 30.0)).value();
  const AttenuationGrid grid = Attenuation(*components, Shared(Sea(201, 30.0))).At(kWhole);
  for (const float factor : grid.factor) ASSERT_NEAR(factor, 1.0, 2e-3);
  EXPECT_NEAR(grid.At({1e6, -1e6}, 0), 1.0, 2e-3);  // the nearest edge's
}

// A wall across the sea's way with a gap: full waves before it and in line with the gap, a shadow
// beside that, waves to all sides of a short wall far behind it.
TEST(Attenuation, WallsThrowShadows) {
  for (const double to_rad : {0.0, 1.5707963, 3.1415926, -1.5707963}) {
    const auto components = BuildComponents(Swell(1.0, 8.0, 30.0, to_rad)).value();
    const int plane = SwellPlane(*components);
    Terrain terrain = Sea(201, 30.0);
    const int along_x = std::abs(std::cos(to_rad)) > 0.5;
    for (int n = 0; n < 201; ++n) {
      for (int m = 99; m <= 101; ++m) {
        if (std::abs(n - 100) < 10) continue;  // a gap of 200 m
        terrain.elevation_m[along_x ? n * 201 + m : m * 201 + n] = 3.0f;
      }
    }
    const AttenuationGrid grid = Attenuation(*components, Shared(terrain)).At(kWhole);
    const auto at = [&](double forward, double aside) {
      return grid.At({forward * std::cos(to_rad) - aside * std::sin(to_rad),
                      forward * std::sin(to_rad) + aside * std::cos(to_rad)},
                     plane);
    };
    EXPECT_NEAR(at(-500, 300), 1.0, 0.01) << to_rad;
    EXPECT_EQ(at(0, 500), 0.0) << to_rad;
    EXPECT_GT(at(100, 0), 0.9) << to_rad;
    EXPECT_LT(at(100, 500), 0.1) << to_rad;
    EXPECT_GT(at(800, 0), 0.5) << to_rad;
    EXPECT_LT(at(800, 600), 0.2) << to_rad;
    EXPECT_GT(at(800, 150), at(200, 150)) << to_rad;  // the spread of directions fills the shadow
  }
}

TEST(Attenuation, LargeTerrainIsLookedAtCoarsely) {
  const auto components = BuildComponents(Swell(1.0, 8.0, 30.0)).value();
  const AttenuationGrid grid = Attenuation(*components, Shared(Sea(1100, 30.0))).At(kWhole);
  EXPECT_LE(grid.columns, Attenuation::kSideMax);
  EXPECT_EQ(grid.cell_m, 30.0);
  EXPECT_GE(grid.cell_m * grid.columns, 10.0 * 1090);
}

// The mix of two entries has the mix of their variances.
TEST(Attenuation, WeatherMixesVariances) {
  Recipe recipe = Swell(1.0, 8.0, 30.0, 0.0);
  recipe.timeline.push_back(recipe.timeline[0]);
  recipe.timeline[1].start_tick = 600;
  recipe.timeline[1].span_ticks = 600;
  std::get<JonswapSystem>(recipe.timeline[1].sea.systems[0]).wave_to_rad = 3.1415926;
  const auto components = BuildComponents(recipe).value();
  const int plane = SwellPlane(*components);
  Terrain terrain = Sea(201, 30.0);
  for (int n = 0; n < 201; ++n) terrain.elevation_m[n * 201 + 100] = 3.0f;
  const Attenuation attenuation(*components, Shared(terrain));
  const auto east = [&](double w) {
    return attenuation.At(std::vector<double>{1 - w, w}).At({500, 0}, plane);
  };
  EXPECT_LT(east(0.0), 0.05);
  EXPECT_NEAR(east(1.0), 1.0, 0.01);
  EXPECT_NEAR(east(0.5), std::sqrt(0.5), 0.03);
}

// Every client must compute the same. The constant is from x86-64.
TEST(Attenuation, HasTheSameBitsEverywhere) {
  const auto components = BuildComponents(Swell(2.0, 9.0, 40.0, 0.7)).value();
  Terrain terrain = Sea(61, 0.0);
  for (int j = 0; j < 61; ++j) {
    for (int i = 0; i < 61; ++i) {
      terrain.elevation_m[j * 61 + i] = static_cast<float>((i * 37 + j * j) % 50 - 44);
    }
  }
  Hash64 hash;
  for (const float f : Attenuation(*components, Shared(terrain)).At(kWhole).factor) hash.Add(f);
  EXPECT_EQ(hash.value(), 0xfda99fad22f8bbd2ULL);
}

}  // namespace
}  // namespace onesea::sea
