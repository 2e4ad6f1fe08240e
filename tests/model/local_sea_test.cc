#include "client/model/local_sea.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <random>
#include <thread>

#include "client/model/other_sea.h"
#include "tests/model/welcome_for_tests.h"

namespace onesea::client {
namespace {

using ::testing::HasSubstr;

std::unique_ptr<LocalSea> MakeSea(const sea::Recipe& recipe) {
  auto sea = LocalSea::Make(WelcomeFor(recipe));
  EXPECT_TRUE(sea.ok()) << sea.status();
  return std::move(*sea);
}

std::vector<float> HeightsAt(const sea::Recipe& recipe, const std::vector<Vec2d>& places,
                             Tick tick) {
  sea::SnapshotBuilder builder(*sea::BuildComponents(recipe));
  std::vector<sea::SurfaceSample> samples(places.size());
  builder.At(TimeOfTick(tick, recipe.tick_rate_hz), sea::QueryDetail::kHeight)
      ->Sample(places, samples);
  std::vector<float> heights;
  for (const auto& sample : samples) heights.push_back(sample.height_m);
  return heights;
}

// Airy: eta = a cos(k·x - ωt + φ), ω² = gk in deep water (surface tension adds 3e-8 of it for this
// wave). 1e-4 of the amplitude leaves room for float trigonometry; a wrong sign of t or of the
// direction errs by metres.
TEST(LocalSea, OneRegularWaveIsACosine) {
  const auto sea = MakeSea(OneWaveRecipe());
  const double omega = 2.0 * M_PI / 8.0;
  const double k = omega * omega / 9.81;
  for (const double time_s : {0.0, 3.7, 1e5, -250.25}) {
    for (const Vec2d place : {Vec2d{0, 0}, Vec2d{13.0, -40.0}, Vec2d{-900.0, 250.0}}) {
      const double along_m = (place.x + place.y) / std::sqrt(2.0);
      const double expected = 0.7 * std::cos(k * along_m - omega * time_s + 0.4);
      EXPECT_NEAR(sea->HeightAt(place, SimTime::FromSeconds(time_s)), expected, 7e-5)
          << place.x << ' ' << place.y << ' ' << time_s;
    }
  }
}

TEST(LocalSea, RefusesAnotherHashNamingBoth) {
  wire::Welcome welcome = WelcomeFor(ChoppyRecipe());
  const std::uint64_t own = welcome.component_hash;
  welcome.component_hash = 0x0123456789abcdefULL;
  const absl::Status status = LocalSea::Make(welcome).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_TRUE(IsOtherSea(status));
  char own_text[17];
  std::snprintf(own_text, sizeof own_text, "%016llx", static_cast<unsigned long long>(own));
  EXPECT_THAT(status.message(), HasSubstr("0123456789abcdef"));
  EXPECT_THAT(status.message(), HasSubstr(own_text));
}

TEST(LocalSea, RefusesAnUnknownSeaModelNamingBothVersions) {
  wire::Welcome welcome = WelcomeFor(ChoppyRecipe());
  welcome.recipe.sea_model_version = 77;
  const absl::Status status = LocalSea::Make(welcome).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_TRUE(IsOtherSea(status));
  EXPECT_THAT(status.message(), HasSubstr("77"));
  EXPECT_THAT(status.message(), HasSubstr("this program knows 1"));
}

TEST(LocalSea, RefusedWelcomeLeavesTheSeaAsItWas) {
  const auto sea = MakeSea(ChoppyRecipe());
  const double before = sea->HeightAt({5, 5}, SimTime::FromSeconds(2));
  wire::Welcome welcome = WelcomeFor(OneWaveRecipe());
  welcome.component_hash ^= 1;
  EXPECT_FALSE(sea->Follow(welcome).ok());
  EXPECT_EQ(sea->HeightAt({5, 5}, SimTime::FromSeconds(2)), before);
  EXPECT_EQ(sea->session().name, "test");
}

// Nothing moves before the change begins, height and velocity go on through its beginning, and the
// end is the new sea.
TEST(LocalSea, WeatherChangesWithoutAJump) {
  sea::Recipe changed = ChoppyRecipe();
  sea::WeatherEntry entry{.start_tick = 600, .span_ticks = 1200, .sea = changed.timeline[0].sea};
  entry.sea.systems = {
      sea::JonswapSystem{.hs_m = 4.0, .tp_s = 9.0, .wave_to_rad = -1.5, .spreading = {}}};
  const auto sea = MakeSea(ChoppyRecipe());
  const Vec2d place{31.0, -12.0};
  const auto height = [&](Tick tick) { return sea->HeightAt(place, TimeOfTick(tick, 60)); };
  const double long_before = height(100);
  const double at_start = height(600);
  EXPECT_NEAR(sea->SignificantWaveHeightAt(TimeOfTick(600, 60)), 2.0, 0.1);

  ASSERT_TRUE(sea::AppendWeather(changed, entry).ok());
  const wire::Welcome welcome = WelcomeFor(changed);
  ASSERT_TRUE(sea->Follow(welcome).ok());
  EXPECT_EQ(height(100), long_before);
  EXPECT_EQ(height(600), at_start);
  // Vertical acceleration of the sea stays below 1 g, so second differences stay below g dt² = 2.7
  // mm.
  for (Tick tick = 590; tick < 640; ++tick) {
    EXPECT_LT(std::abs(height(tick + 1) - 2 * height(tick) + height(tick - 1)), 9.81 / 3600);
  }
  EXPECT_NEAR(sea->SignificantWaveHeightAt(TimeOfTick(1800, 60)), 4.0, 0.2);
  EXPECT_EQ(sea->components()->hash, welcome.component_hash);
  EXPECT_EQ(sea->WeatherWeightsAt(TimeOfTick(1800, 60)), (std::vector<double>{0.0, 1.0}));
}

TEST(LocalSea, ReconnectingToTheSameSeaKeepsTheComponents) {
  const auto sea = MakeSea(ChoppyRecipe());
  const auto components = sea->components();
  wire::Welcome welcome = WelcomeFor(ChoppyRecipe());
  welcome.session.tick = 4242;
  ASSERT_TRUE(sea->Follow(welcome).ok());
  EXPECT_EQ(sea->components(), components);
  EXPECT_EQ(sea->session().tick, 4242);
}

TEST(LocalSea, DriftIsZeroForTheServersHeightsAndKeepsTheWorst) {
  const auto sea = MakeSea(ChoppyRecipe());
  wire::ProbeHeights probes{.tick = 777, .height_m = {}};
  probes.height_m = HeightsAt(ChoppyRecipe(), sea->session().probes_m, probes.tick);
  EXPECT_EQ(*sea->CompareProbes(probes), 0.0);
  probes.height_m[1] -= 0.25f;
  EXPECT_NEAR(*sea->CompareProbes(probes), 0.25, 1e-6);
  probes.height_m[1] += 0.2f;
  EXPECT_NEAR(*sea->CompareProbes(probes), 0.05, 1e-6);
  EXPECT_EQ(sea->drift().comparisons, 3);
  EXPECT_NEAR(sea->drift().last_m, 0.05, 1e-6);
  EXPECT_NEAR(sea->drift().worst_m, 0.25, 1e-6);
}

TEST(LocalSea, BadProbesAreRefusedOrReportedNeverHidden) {
  const auto sea = MakeSea(ChoppyRecipe());
  EXPECT_EQ(sea->CompareProbes({.tick = 1, .height_m = {0.f}}).status().code(),
            absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(sea->CompareProbes({.tick = INT64_MAX, .height_m = {0.f, 0.f, 0.f}}).status().code(),
            absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(sea->drift().comparisons, 0);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(*sea->CompareProbes({.tick = 1, .height_m = {0.f, nan, 0.f}}), HUGE_VAL);
  EXPECT_EQ(sea->drift().worst_m, HUGE_VAL);
}

// Linear interpolation errs by at most acceleration * dt²/8; below 1 g that is 0.34 mm. The choppy
// sea folds here and there, where the top sheet changes at once, so the bound is asked of 99 % of
// places and the rest reported.
TEST(LocalSea, HeightNearIsWithinItsBound) {
  const auto sea = MakeSea(ChoppyRecipe());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> metres(-500.0, 500.0), seconds(0.0, 2.0);
  int outside = 0;
  double worst_m = 0.0;
  constexpr int kPlaces = 2000;
  for (int n = 0; n < kPlaces; ++n) {
    const Vec2d place{metres(random), metres(random)};
    const SimTime time = SimTime::FromSeconds(seconds(random));
    const double error_m = std::abs(sea->HeightNear(place, time) - sea->HeightAt(place, time));
    outside += error_m > 0.00035;
    worst_m = std::max(worst_m, error_m);
  }
  RecordProperty("worst_mm", std::to_string(worst_m * 1e3));
  EXPECT_LT(outside, kPlaces / 100) << "worst " << worst_m;
  EXPECT_LT(worst_m, 0.02);
}

TEST(LocalSea, HeightNearIsExactOnTheLatticeAndBeforeTickZero) {
  const auto sea = MakeSea(OneWaveRecipe());
  for (const Tick tick : {-61, -1, 0, 1, 60}) {
    const SimTime time = TimeOfTick(tick, 60);
    EXPECT_EQ(sea->HeightNear({3, 4}, time), sea->HeightAt({3, 4}, time)) << tick;
  }
  const SimTime between = SimTime::FromSeconds(-0.508);
  EXPECT_NEAR(sea->HeightNear({3, 4}, between), sea->HeightAt({3, 4}, between), 1e-4);
}

// Run under the thread sanitizer too: askers never wait for a weather change to be built and always
// see one timeline.
TEST(LocalSea, AnswersWhileTheWeatherIsFollowed) {
  const sea::Recipe calm = ChoppyRecipe();
  sea::Recipe rough = ChoppyRecipe();
  std::get<sea::JonswapSystem>(rough.timeline[0].sea.systems[0]).hs_m = 4.0;
  const SimTime time = SimTime::FromSeconds(1.0);
  const double calm_m = MakeSea(calm)->HeightAt({9, 9}, time);
  const double rough_m = MakeSea(rough)->HeightAt({9, 9}, time);
  const auto sea = MakeSea(calm);
  std::atomic<bool> done = false;
  std::atomic<int> wrong = 0;
  std::vector<std::thread> askers;
  for (int n = 0; n < 3; ++n) {
    askers.emplace_back([&, n] {
      for (int turn = 0; !done; ++turn) {
        const double height_m = sea->HeightAt({9, 9}, time);
        if (height_m != calm_m && height_m != rough_m) ++wrong;
        sea->HeightNear({1.0 * n, 2.0}, SimTime::FromSeconds(0.01 * turn));
      }
    });
  }
  for (int turn = 0; turn < 6; ++turn) {
    ASSERT_TRUE(sea->Follow(WelcomeFor(turn % 2 == 0 ? rough : calm)).ok());
  }
  done = true;
  for (std::thread& asker : askers) asker.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace onesea::client
