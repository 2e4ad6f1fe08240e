#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "common/base/limits.h"
#include "common/sea/components.h"
#include "common/sea/recipe.h"

namespace onesea::sea {
namespace {

constexpr int kRate = 60;

SeaState Sea(double hs_m, double wave_to_rad) {
  JonswapSystem system;
  system.hs_m = hs_m;
  system.wave_to_rad = wave_to_rad;
  return {"", {system}, {}, 8.0, wave_to_rad};
}

Recipe RecipeOf(std::vector<WeatherEntry> timeline) {
  Recipe recipe;
  recipe.tick_rate_hz = kRate;
  recipe.cascades = DefaultCascades();
  recipe.timeline = std::move(timeline);
  return recipe;
}

SimTime At(double seconds) { return SimTime::FromSeconds(seconds); }

TEST(WeatherWeights, FollowTheSineSquared) {
  const Recipe recipe = RecipeOf({{0, 0, Sea(2, 0)}, {100 * kRate, 40 * kRate, Sea(4, 1)}});
  EXPECT_EQ(WeatherWeights(recipe, At(-1e6)), (std::vector<double>{1.0, 0.0}));
  EXPECT_EQ(WeatherWeights(recipe, At(100.0)), (std::vector<double>{1.0, 0.0}));
  EXPECT_NEAR(WeatherWeights(recipe, At(120.0))[1], 0.5, 1e-15);
  const double u = 0.25;
  const double theta = 1.5707963267948966 * (3 * u * u - 2 * u * u * u);
  EXPECT_NEAR(WeatherWeights(recipe, At(110.0))[1], std::pow(std::sin(theta), 2), 1e-15);
  EXPECT_EQ(WeatherWeights(recipe, At(140.0)), (std::vector<double>{0.0, 1.0}));
  EXPECT_EQ(WeatherWeights(recipe, At(1e9)), (std::vector<double>{0.0, 1.0}));
}

TEST(WeatherWeights, AtOnceMeansAtOnce) {
  const Recipe recipe = RecipeOf({{0, 0, Sea(2, 0)}, {10, 0, Sea(4, 1)}});
  EXPECT_EQ(WeatherWeights(recipe, TimeOfTick(9, kRate))[1], 0.0);
  EXPECT_EQ(WeatherWeights(recipe, TimeOfTick(10, kRate))[1], 1.0);
}

// A change ordered in the middle of a change: shares stay convex, start from the mix of that moment
// and have no jump, nor has their rate of change.
TEST(WeatherWeights, AChangeWithinAChangeIsSmooth) {
  const Recipe before = RecipeOf({{0, 0, Sea(2, 0)}, {0, 60 * kRate, Sea(4, 1)}});
  Recipe after = before;
  ASSERT_TRUE(AppendWeather(after, {25 * kRate, 30 * kRate, Sea(1, 2)}).ok());
  const auto mix = WeatherWeights(before, At(25.0));
  const auto start = WeatherWeights(after, At(25.0));
  EXPECT_EQ(start[0], mix[0]);
  EXPECT_EQ(start[1], mix[1]);
  EXPECT_EQ(start[2], 0.0);
  constexpr double kStep = 0.01;
  std::vector<double> last = WeatherWeights(after, At(-1.0));
  std::vector<double> last_rate(3, 0.0);
  for (double t = -1.0 + kStep; t < 70.0; t += kStep) {
    const auto now = WeatherWeights(after, At(t));
    EXPECT_NEAR(std::accumulate(now.begin(), now.end(), 0.0), 1.0, 1e-14);
    for (std::size_t m = 0; m < 3; ++m) {
      EXPECT_GE(now[m], 0.0);
      const double rate = (now[m] - last[m]) / kStep;
      EXPECT_LT(std::fabs(rate), 0.1);                         // no jump
      EXPECT_LT(std::fabs(rate - last_rate[m]), 0.1 * kStep);  // no kink: second derivatives < 0.1
      last_rate[m] = rate;
    }
    last = now;
  }
}

// Energy is a convex mix: a sea that turns between two directions of equal height keeps its Hs (a
// mix of amplitudes would sag to 71 %), and phases and frequencies do not depend on the weather.
TEST(Weather, ATurningSeaKeepsItsHeight) {
  const Recipe recipe = RecipeOf({{0, 0, Sea(3, 0.0)}, {0, 60 * kRate, Sea(3, 2.0)}});
  const auto components = *BuildComponents(recipe);
  for (double t = 0.0; t <= 60.0; t += 5.0) {
    EXPECT_NEAR(4.0 * std::sqrt(VarianceAt(*components, At(t))), 3.0, 0.02) << t;
  }
  const auto alone = *BuildComponents(RecipeOf({{0, 0, Sea(3, 0.0)}}));
  for (std::size_t c = 0; c < 4; ++c) {
    EXPECT_EQ(alone->cascades[c].phase_turns, components->cascades[c].phase_turns);
    EXPECT_EQ(alone->cascades[c].turns_per_flick, components->cascades[c].turns_per_flick);
    EXPECT_EQ(alone->cascades[c].variance_m2[0], components->cascades[c].variance_m2[0]);
  }
  EXPECT_NE(alone->hash, components->hash);
}

TEST(AppendWeather, FoldsAwayWhatNoLongerMatters) {
  Recipe recipe = RecipeOf({{0, 0, Sea(1, 0)}});
  const std::int64_t hour = 3600 * kRate;
  ASSERT_TRUE(AppendWeather(recipe, {10, 100, Sea(2, 0)}).ok());
  ASSERT_TRUE(AppendWeather(recipe, {hour + 109, 0, Sea(3, 0)}).ok());
  EXPECT_EQ(recipe.timeline.size(), 3u);  // the second ended 59 min 59.98 s before: still asked for
  recipe.timeline.pop_back();
  const auto before = WeatherWeights(recipe, TimeOfTick(110, kRate));
  EXPECT_EQ(before.back(), 1.0);
  ASSERT_TRUE(AppendWeather(recipe, {hour + 110, 0, Sea(3, 0)}).ok());
  ASSERT_EQ(recipe.timeline.size(), 2u);
  EXPECT_EQ(recipe.timeline[0].start_tick, 10);
  EXPECT_EQ(WeatherWeights(recipe, TimeOfTick(200, kRate))[0], 1.0);
}

TEST(AppendWeather, RefusesThePastTheBadAndTheTooMany) {
  Recipe recipe = RecipeOf({{100, 0, Sea(1, 0)}});
  EXPECT_EQ(AppendWeather(recipe, {99, 0, Sea(1, 0)}).code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(AppendWeather(recipe, {200, 0, Sea(100, 0)}).code(),
            absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(recipe.timeline.size(), 1u);
  for (int n = 1; n < kWeatherEntriesMax; ++n) {
    EXPECT_TRUE(AppendWeather(recipe, {100 + n, 10, Sea(1, 0)}).ok()) << n;
  }
  const Recipe full = recipe;
  EXPECT_EQ(AppendWeather(recipe, {200, 0, Sea(1, 0)}).code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(recipe, full);
}

}  // namespace
}  // namespace onesea::sea
