#include "common/sea/recipe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "common/base/limits.h"
#include "common/sea/cell_integral.h"
#include "common/sea/constants.h"

namespace onesea::sea {
namespace {

using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

Recipe Good() {
  Recipe recipe;
  recipe.cascades = DefaultCascades();
  recipe.timeline.push_back({0, 0, {"calm", {JonswapSystem{}}, {}, 8.0, 0.0}});
  return recipe;
}

TEST(DefaultCascades, CoverFromTheLongestToTheShortestOnce) {
  const std::vector<Cascade> cascades = DefaultCascades();
  ASSERT_EQ(cascades.size(), 4u);
  EXPECT_EQ(cascades[0].wavenumber_min_rad_per_m, 0.0);
  for (std::size_t n = 1; n < cascades.size(); ++n) {
    EXPECT_EQ(cascades[n].wavenumber_min_rad_per_m, cascades[n - 1].wavenumber_max_rad_per_m);
  }
  EXPECT_NEAR(2.0 * kPi / cascades.back().wavenumber_max_rad_per_m, 0.4, 0.01);
  EXPECT_TRUE(ValidateRecipe(Good()).ok()) << ValidateRecipe(Good());
}

struct Bad {
  const char* words;
  std::function<void(Recipe&)> spoil;
};

TEST(ValidateRecipe, NamesTheFieldOfEveryBadValue) {
  auto jonswap = [](Recipe& r) -> JonswapSystem& {
    return std::get<JonswapSystem>(r.timeline[0].sea.systems[0]);
  };
  const Bad cases[] = {
      {"tick_rate_hz", [](Recipe& r) { r.tick_rate_hz = 0; }},
      {"tick_rate_hz", [](Recipe& r) { r.tick_rate_hz = 61; }},
      {"depth_m", [](Recipe& r) { r.depth_m = -3.0; }},
      {"depth_m", [](Recipe& r) { r.depth_m = kNan; }},
      {"current",
       [](Recipe& r) {
         r.current_m_per_s = {8.0, 8.0};
       }},
      {"current",
       [](Recipe& r) {
         r.current_m_per_s = {kNan, 0.0};
       }},
      {"loop_period_s", [](Recipe& r) { r.loop_period_s = kInf; }},
      {"loop_period_s", [](Recipe& r) { r.loop_period_s = 5e-324; }},
      {"amplitude", [](Recipe& r) { r.amplitude = static_cast<AmplitudeKind>(7); }},
      {"choppiness", [](Recipe& r) { r.choppiness = 1.6; }},
      {"cascades", [](Recipe& r) { r.cascades.clear(); }},
      {"cascades[1].length_m", [](Recipe& r) { r.cascades[1].length_m = kNan; }},
      {"cascades[2].query_grid_size", [](Recipe& r) { r.cascades[2].query_grid_size = 100; }},
      {"cascades[3].wavenumber_max",
       [](Recipe& r) { r.cascades[3].wavenumber_max_rad_per_m *= 1.01; }},
      {"overlap", [](Recipe& r) { r.cascades[1].wavenumber_min_rad_per_m *= 0.99; }},
      {"timeline", [](Recipe& r) { r.timeline.clear(); }},
      {"timeline[1].start_tick",
       [](Recipe& r) {
         r.timeline.push_back({-5, 0, {}});
       }},
      {"timeline[0].span_ticks", [](Recipe& r) { r.timeline[0].span_ticks = -1; }},
      {"timeline[0].sea.wind_speed_m_per_s",
       [](Recipe& r) { r.timeline[0].sea.wind_speed_m_per_s = -1.0; }},
      {"timeline[0].sea.systems[0].hs_m = 41", [&](Recipe& r) { jonswap(r).hs_m = 41.0; }},
      {"tp_s", [&](Recipe& r) { jonswap(r).tp_s = 0.0; }},
      {"gamma", [&](Recipe& r) { jonswap(r).gamma = kNan; }},
      {"wave_to_rad", [&](Recipe& r) { jonswap(r).wave_to_rad = kInf; }},
      {"spreading.swell", [&](Recipe& r) { jonswap(r).spreading.swell = 1.1; }},
      {"spreading.kind",
       [&](Recipe& r) { jonswap(r).spreading.kind = static_cast<SpreadingKind>(0); }},
      {"regular_waves[0].period_s",
       [](Recipe& r) {
         r.timeline[0].sea.regular_waves = {{1.0, 0.01, 0.0, 0.0}};
       }},
      {"systems: number", [](Recipe& r) { r.timeline[0].sea.systems.resize(9); }},
  };
  for (const Bad& bad : cases) {
    Recipe recipe = Good();
    bad.spoil(recipe);
    const absl::Status status = ValidateRecipe(recipe);
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << bad.words;
    EXPECT_THAT(std::string(status.message()), HasSubstr(bad.words));
  }
}

// 330 000 waves of eight systems took 3.9 s a weather entry.
TEST(ValidateRecipe, BoundsTheWorkOfBuilding) {
  Recipe full = Good();
  full.timeline[0].sea.systems.resize(kWaveSystemsMax);
  full.timeline.resize(kWeatherEntriesMax, full.timeline[0]);
  EXPECT_TRUE(ValidateRecipe(full).ok()) << ValidateRecipe(full);

  Recipe fine = Good();
  fine.cascades.clear();
  double from_rad_per_m = 0.0;
  for (int n = 0; n < kCascadesMax; ++n) {
    Cascade cascade{1000.0 * std::pow(0.2, n), 0.0, from_rad_per_m, 0.0, kGridSizeMax};
    if (cascade.length_m < kCascadeLengthMinM) break;
    cascade.wavenumber_max_rad_per_m = 2.0 * kPi / cascade.length_m * (kGridSizeMax / 8);
    from_rad_per_m = cascade.wavenumber_max_rad_per_m;
    fine.cascades.push_back(cascade);
  }
  std::size_t waves = 0;
  for (const Cascade& cascade : fine.cascades) waves += Lattice(cascade).Waves().size();
  const auto systems_max = static_cast<std::size_t>(kBuildWavesMax) / waves;
  ASSERT_LT(systems_max, kWaveSystemsMax);
  fine.timeline[0].sea.systems.resize(systems_max);
  EXPECT_TRUE(ValidateRecipe(fine).ok()) << ValidateRecipe(fine);
  fine.timeline[0].sea.systems.emplace_back();
  EXPECT_THAT(std::string(ValidateRecipe(fine).message()),
              ::testing::ContainsRegex("cascades: about [0-9]+ waves x [0-9]+ wave systems in the "
                                       "timeline = [0-9]+, the limit is 2000000"));
}

TEST(ValidateRecipe, RefusesAnUnknownVersionOtherwise) {
  Recipe recipe = Good();
  recipe.sea_model_version = 2;
  EXPECT_EQ(ValidateRecipe(recipe).code(), absl::StatusCode::kFailedPrecondition);
}

BuoySpectrum SmallBuoy() {
  BuoySpectrum s;
  s.frequency_hz = {0.1f, 0.2f};
  s.density_m2_per_hz = {1.0f, 2.0f};
  s.mean_wave_to_rad = s.principal_wave_to_rad = {0.0f, 1.0f};
  s.r1 = s.r2 = {0.5f, 0.5f};
  return s;
}

TEST(ValidateRecipe, ChecksMeasuredSpectra) {
  using Spoil = std::function<void(BuoySpectrum&)>;
  const std::pair<const char*, Spoil> cases[] = {
      {"r1[1]", [](BuoySpectrum& s) { s.r1[1] = 1.01f; }},
      {"r2 has 1", [](BuoySpectrum& s) { s.r2.resize(1); }},
      {"density_m2_per_hz[0]", [](BuoySpectrum& s) { s.density_m2_per_hz[0] = -1.0f; }},
      {"density_m2_per_hz[1]", [](BuoySpectrum& s) { s.density_m2_per_hz[1] = NAN; }},
      {"frequency_hz[1]", [](BuoySpectrum& s) { s.frequency_hz[1] = 0.1f; }},
      {"frequency_hz: number", [](BuoySpectrum& s) { s.frequency_hz.clear(); }},
      {"zero everywhere",
       [](BuoySpectrum& s) {
         s.density_m2_per_hz = {0, 0};
         s.hs_m = 1.0;
       }},
  };
  Recipe recipe = Good();
  recipe.timeline[0].sea.systems = {SmallBuoy()};
  EXPECT_TRUE(ValidateRecipe(recipe).ok()) << ValidateRecipe(recipe);
  for (const auto& [words, spoil] : cases) {
    BuoySpectrum buoy = SmallBuoy();
    spoil(buoy);
    recipe.timeline[0].sea.systems = {buoy};
    const absl::Status status = ValidateRecipe(recipe);
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << words;
    EXPECT_THAT(std::string(status.message()), HasSubstr(words));
  }
  GridSpectrum grid;
  grid.frequency_hz = {0.1f, 0.2f};
  grid.wave_to_rad = {0.0f, 3.0f, 6.2832f};  // a whole turn: the last repeats the first
  grid.density_m2_per_hz_rad.assign(6, 1.0f);
  recipe.timeline[0].sea.systems = {grid};
  EXPECT_FALSE(ValidateRecipe(recipe).ok());
  grid.wave_to_rad.back() = 5.0f;
  recipe.timeline[0].sea.systems = {grid};
  EXPECT_TRUE(ValidateRecipe(recipe).ok()) << ValidateRecipe(recipe);
}

}  // namespace
}  // namespace onesea::sea
