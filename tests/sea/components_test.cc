#include "common/sea/components.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "common/base/limits.h"
#include "common/sea/constants.h"
#include "common/sea/wave_spectrum.h"

namespace onesea::sea {
namespace {

Recipe RecipeOf(std::vector<WaveSystem> systems) {
  Recipe recipe;
  recipe.cascades = DefaultCascades();
  recipe.timeline.push_back({});
  recipe.timeline[0].sea.systems = std::move(systems);
  return recipe;
}

std::shared_ptr<const Components> Build(const Recipe& recipe) {
  auto components = BuildComponents(recipe);
  EXPECT_TRUE(components.ok()) << components.status();
  return components.ok() ? *components : nullptr;
}

double HsOf(const Components& components) { return 4.0 * std::sqrt(VarianceAt(components, {0})); }

// Narrow swell: the hardest for a lattice, a cell or two hold most of the energy.
JonswapSystem NarrowSwell(double tp_s, double wave_to_rad) {
  return {2.0, tp_s, 7.0, wave_to_rad, {SpreadingKind::kCosine2s, 75.0, 0.0}, false};
}

TEST(BuildComponents, VarianceOfAWindSeaIsTheRecipes) {
  const auto components = Build(RecipeOf({JonswapSystem{}}));
  const double want = 2.0 * 2.0 / 16.0;
  const double got = VarianceAt(*components, {0}) + components->lost_variance_m2[0];
  EXPECT_NEAR(got / want, 1.0, 0.005);
  EXPECT_LT(components->lost_variance_m2[0] / want, 0.002);
}

TEST(BuildComponents, VarianceOfANarrowSwellIsTheRecipesInEveryDirection) {
  for (const double tp_s : {14.0, 25.0}) {
    for (int n = 0; n < 12; ++n) {
      const auto components = Build(RecipeOf({NarrowSwell(tp_s, n * kPi / 6.0 + 0.05)}));
      EXPECT_NEAR(VarianceAt(*components, {0}) / 0.25, 1.0, 0.005) << tp_s << " direction " << n;
    }
  }
}

// Σ E + lost is ∫S, whatever the family; the integral is that of 1-D quadrature.
TEST(BuildComponents, EveryFamilyKeepsItsVariance) {
  PhillipsSystem phillips;
  phillips.wind_speed_m_per_s = 14.0;
  phillips.wind_to_rad = 1.0;
  FetchJonswapSystem fetch;
  fetch.spreading.kind = SpreadingKind::kMitsuyasu;
  PiersonMoskowitzSystem moskowitz;
  moskowitz.spreading = {SpreadingKind::kDonelanBanner, 0.0, 0.4};
  GridSpectrum grid;
  for (int m = 0; m < 36; ++m) grid.wave_to_rad.push_back(0.05f + 0.1745f * static_cast<float>(m));
  for (int n = 0; n < 30; ++n) {
    grid.frequency_hz.push_back(0.04f + 0.015f * static_cast<float>(n));
    for (int m = 0; m < 36; ++m) {
      grid.density_m2_per_hz_rad.push_back(m > 5 && m < 9 && n > 3 && n < 12 ? 3.0f : 0.0f);
    }
  }
  for (const WaveSystem& system :
       {WaveSystem{phillips}, WaveSystem{moskowitz}, WaveSystem{fetch},
        WaveSystem{ElfouhailySystem{11.0, 1.0, -1.0}}, WaveSystem{grid}}) {
    const auto spectrum = MakeWaveSpectrum(system, 0.0);
    const double want = RadialMoment(*spectrum, 1e-4, spectrum->EndRadPerM(), 0);
    const auto components = Build(RecipeOf({system}));
    const double got = VarianceAt(*components, {0}) + components->lost_variance_m2[0];
    EXPECT_NEAR(got / want, 1.0, 0.005) << "family " << system.index();
  }
}

// ∫ k² F of the whole sea is what the waves carry and what is reported as unresolved.
TEST(BuildComponents, ReportsTheSlopesThatItLeavesOut) {
  const auto components = Build(RecipeOf({ElfouhailySystem{10.0, 0.84, 0.3}}));
  double resolved = 0.0;
  for (const CascadeComponents& c : components->cascades) {
    for (std::size_t n = 0; n < c.i.size(); ++n) {
      const double k2 =
          c.kx_rad_per_m[n] * c.kx_rad_per_m[n] + c.ky_rad_per_m[n] * c.ky_rad_per_m[n];
      resolved += k2 * c.variance_m2[0][n];
    }
  }
  EXPECT_GT(resolved, 0.01);
  EXPECT_GT(components->unresolved_mss[0], 0.01);
  EXPECT_NEAR((resolved + components->unresolved_mss[0]) / 0.06031, 1.0, 0.01);
}

TEST(BuildComponents, EverySeedHasTheRecipesHs) {
  Recipe recipe = RecipeOf({JonswapSystem{}});
  std::set<std::uint64_t> hashes;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    recipe.seed = seed;
    const auto components = Build(recipe);
    EXPECT_NEAR(HsOf(*components), 2.0, 0.02);
    hashes.insert(components->hash);
  }
  EXPECT_EQ(hashes.size(), 20u);
}

// Rayleigh amplitudes: each wave's variance is exponential about its mean E, so m0 has the mean ΣE
// and the variance ΣE². Over 100 seeds the standardised m0 must have mean 0 and deviation 1 within
// four of their own standard errors, and no seed may leave five deviations.
TEST(BuildComponents, RayleighSpreadsAsComputed) {
  Recipe recipe = RecipeOf({JonswapSystem{}});
  const auto fixed = Build(recipe);
  double mean = 0.0;
  double variance = 0.0;
  for (const CascadeComponents& c : fixed->cascades) {
    for (const double e : c.variance_m2[0]) {
      mean += e;
      variance += e * e;
    }
  }
  recipe.amplitude = AmplitudeKind::kRayleigh;
  constexpr int kSeeds = 100;
  double sum = 0.0;
  double sum2 = 0.0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    recipe.seed = static_cast<std::uint64_t>(seed);
    const auto components = Build(recipe);
    EXPECT_EQ(components->cascades[0].turns_per_flick, fixed->cascades[0].turns_per_flick);
    const double z = (VarianceAt(*components, {0}) - mean) / std::sqrt(variance);
    EXPECT_LT(std::fabs(z), 5.0) << "seed " << seed;
    sum += z;
    sum2 += z * z;
  }
  EXPECT_LT(std::fabs(sum / kSeeds), 4.0 / std::sqrt(kSeeds));
  EXPECT_NEAR(std::sqrt(sum2 / kSeeds), 1.0, 4.0 / std::sqrt(2.0 * kSeeds));
}

// Resolution independence: a wave keeps its phase, frequency and energy whatever else the recipe
// holds, here another grid size of the same cascade.
TEST(BuildComponents, WavesDoNotDependOnTheGrid) {
  Recipe coarse = RecipeOf({JonswapSystem{}});
  coarse.cascades.resize(1);
  Recipe fine = coarse;
  fine.cascades[0].query_grid_size = 1024;
  const auto a = Build(coarse);
  const auto b = Build(fine);
  EXPECT_EQ(a->cascades[0].phase_turns, b->cascades[0].phase_turns);
  EXPECT_EQ(a->cascades[0].turns_per_flick, b->cascades[0].turns_per_flick);
  EXPECT_EQ(a->cascades[0].variance_m2, b->cascades[0].variance_m2);
}

TEST(BuildComponents, OrderIsJOuterIInnerWithinTheGrid) {
  const auto components = Build(RecipeOf({JonswapSystem{}}));
  ASSERT_EQ(components->cascades.size(), 4u);
  for (const CascadeComponents& c : components->cascades) {
    EXPECT_GT(c.i.size(), 2500u);
    EXPECT_LT(c.i.size(), 3700u);
    for (std::size_t n = 0; n < c.i.size(); ++n) {
      EXPECT_LE(std::abs(c.i[n]), 32);
      EXPECT_LE(std::abs(c.j[n]), 32);
      EXPECT_TRUE(c.i[n] != 0 || c.j[n] != 0);
      if (n > 0) {
        EXPECT_LT(std::make_pair(c.j[n - 1], c.i[n - 1]), std::make_pair(c.j[n], c.i[n]));
      }
    }
  }
}

// The sea travels where the recipe says: energy-weighted mean of k is along wave_to_rad.
TEST(BuildComponents, EnergyTravelsAlongWaveTo) {
  for (const double direction : {0.3, 2.0, -2.5}) {
    JonswapSystem system;
    system.wave_to_rad = direction;
    const auto components = Build(RecipeOf({system}));
    double x = 0.0;
    double y = 0.0;
    for (const CascadeComponents& c : components->cascades) {
      for (std::size_t n = 0; n < c.i.size(); ++n) {
        const double k = std::hypot(c.kx_rad_per_m[n], c.ky_rad_per_m[n]);
        x += c.variance_m2[0][n] * c.kx_rad_per_m[n] / k;
        y += c.variance_m2[0][n] * c.ky_rad_per_m[n] / k;
      }
    }
    EXPECT_NEAR(std::remainder(std::atan2(y, x) - direction, 2.0 * kPi), 0.0, 0.02);
  }
}

TEST(BuildComponents, CurrentShiftsFrequencyByKU) {
  Recipe still = RecipeOf({JonswapSystem{}});
  Recipe moving = still;
  moving.current_m_per_s = {1.5, -0.5};
  const auto a = Build(still);
  const auto b = Build(moving);
  const double unit = 2.0 * kPi * static_cast<double>(kFlicksPerSecond) / 0x1p64;
  for (std::size_t c = 0; c < 4; ++c) {
    const CascadeComponents& wave = a->cascades[c];
    for (std::size_t n = 0; n < wave.i.size(); n += 97) {
      const auto shift =
          static_cast<std::int64_t>(b->cascades[c].turns_per_flick[n] - wave.turns_per_flick[n]);
      const double want = 1.5 * wave.kx_rad_per_m[n] - 0.5 * wave.ky_rad_per_m[n];
      EXPECT_NEAR(static_cast<double>(shift) * unit, want, 1e-6 * (1.0 + std::fabs(want)));
    }
  }
}

TEST(BuildComponents, LoopPeriodBringsEveryWaveBack) {
  Recipe recipe = RecipeOf({JonswapSystem{}});
  recipe.loop_period_s = 120.0;
  const auto components = Build(recipe);
  const std::uint64_t flicks = 120 * static_cast<std::uint64_t>(kFlicksPerSecond);
  for (const CascadeComponents& c : components->cascades) {
    for (const std::uint64_t turns : c.turns_per_flick) {
      const auto rest = static_cast<std::int64_t>(turns * flicks);
      EXPECT_LT(std::fabs(static_cast<double>(rest)) / 0x1p64, 1e-7);
    }
  }
}

TEST(BuildComponents, RegularWaveHasItsPeriodAndDirection) {
  Recipe recipe = RecipeOf({});
  recipe.depth_m = 5.0;
  recipe.timeline[0].sea.regular_waves = {{0.5, 8.0, kPi / 3.0, 0.25}};
  const auto components = Build(recipe);
  ASSERT_EQ(components->regular.size(), 1u);
  const RegularComponent& wave = components->regular[0];
  const double k = std::hypot(wave.kx_rad_per_m, wave.ky_rad_per_m);
  EXPECT_NEAR(kGravity * k * std::tanh(5.0 * k), std::pow(2.0 * kPi / 8.0, 2), 1e-4);
  EXPECT_NEAR(std::atan2(wave.ky_rad_per_m, wave.kx_rad_per_m), kPi / 3.0, 1e-12);
  EXPECT_NEAR(static_cast<double>(wave.turns_per_flick) / 0x1p64 * 8.0 * kFlicksPerSecond, 1.0,
              1e-9);
  EXPECT_NEAR(VarianceAt(*components, {0}), 0.125, 1e-12);
}

// Every number of it is within its own limits; clients would refuse such a session's Hs.
TEST(BuildComponents, RefusesASeaThatIsTooHighAltogether) {
  PhillipsSystem gale{.wind_speed_m_per_s = kWindSpeedMaxMPerS};
  gale.small_wave_cutoff_m = 1.0;
  Recipe recipe = RecipeOf({gale});
  EXPECT_TRUE(BuildComponents(recipe).ok());  // Hs 130 m
  gale.alpha = 1.0;
  recipe.timeline.push_back({60, 0, {"", {gale}, {}, 0.0, 0.0}});
  const absl::Status status = BuildComponents(recipe).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  for (const char* words : {"timeline[1].sea: Hs", " = 728.", "is outside [0, 400]"}) {
    EXPECT_NE(status.message().find(words), absl::string_view::npos) << status;
  }
  Recipe tank = RecipeOf({});
  tank.timeline[0].sea.regular_waves.assign(kRegularWavesMax, {kHsMaxM, 8.0, 0.0, 0.0});
  EXPECT_EQ(BuildComponents(tank).status().code(), absl::StatusCode::kInvalidArgument);
}

TEST(BuildComponents, RefusesABadRecipe) {
  Recipe recipe = RecipeOf({JonswapSystem{}});
  recipe.depth_m = -1.0;
  EXPECT_EQ(BuildComponents(recipe).status().code(), absl::StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace onesea::sea
