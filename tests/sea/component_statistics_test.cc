#include "common/sea/component_statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/sea/constants.h"

namespace onesea::sea {
namespace {

std::shared_ptr<const Components> Build(SeaState sea) {
  Recipe recipe;
  recipe.cascades = DefaultCascades();
  recipe.timeline.push_back({0, 0, std::move(sea)});
  return *BuildComponents(recipe);
}

// A spectrum's own figures come back from its waves: those of PM in closed form.
TEST(ComponentStatistics, PiersonMoskowitzComesBack) {
  PiersonMoskowitzSystem system;
  system.wind_speed_19_5_m_per_s = 15.0;
  system.wave_to_rad = 4.0;
  system.spreading = {SpreadingKind::kCosine2s, 10.0, 0.0};
  const SpectrumStatistics s = ComputeStatistics(*Build({"", {system}, {}, 0.0, 0.0}), {0});
  EXPECT_NEAR(s.hs_m / 4.79921, 1.0, 0.005);
  EXPECT_NEAR(s.tp_parabola_s / 10.9527, 1.0, 0.03);
  EXPECT_NEAR(s.tm01_s / 8.45299, 1.0, 0.01);
  EXPECT_NEAR(s.tm02_s / 7.78049, 1.0, 0.01);
  EXPECT_NEAR(s.mean_wave_to_rad, 4.0, 0.01);
  EXPECT_NEAR(s.peak_wave_to_rad, 4.0, 0.05);
  EXPECT_NEAR(s.spread_rad * 180.0 / kPi, 24.431, 0.3);  // √(2/(s+1))
}

TEST(ComponentStatistics, LongNarrowSwellComesBack) {
  const JonswapSystem swell{2.0, 16.0, 5.0, 1.2, {SpreadingKind::kCosine2s, 50.0, 0.0}, false};
  const SpectrumStatistics s = ComputeStatistics(*Build({"", {swell}, {}, 0.0, 0.0}), {0});
  EXPECT_NEAR(s.hs_m, 2.0, 0.01);
  EXPECT_NEAR(s.tp_parabola_s / 16.0, 1.0, 0.03);
  EXPECT_NEAR(s.mean_wave_to_rad, 1.2, 0.02);
}

TEST(ComponentStatistics, RegularWaveIsItsOwnSpectrum) {
  const SpectrumStatistics s =
      ComputeStatistics(*Build({"", {}, {{1.0, 7.0, 0.5, 0.0}}, 0.0, 0.0}), {0});
  EXPECT_NEAR(s.hs_m, 4.0 * std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(s.tm01_s, 7.0, 1e-9);
  EXPECT_NEAR(s.tp_s / 7.0, 1.0, 0.01);
  EXPECT_NEAR(s.mean_wave_to_rad, 0.5, 1e-12);
  EXPECT_NEAR(s.spread_rad, 0.0, 1e-6);
}

// A direction just below east is just below a turn, which rounding must not make of it.
TEST(ComponentStatistics, DirectionsStayBelowATurn) {
  EXPECT_LT(WaveTo(-1e-20, 1.0), 2.0 * kPi);
  EXPECT_EQ(WaveTo(0.0, -1.0), kPi);
  EXPECT_NEAR(WaveTo(-1.0, 0.0), 1.5 * kPi, 1e-15);
}

TEST(ComponentStatistics, FlatWaterHasNone) {
  const SpectrumStatistics s = ComputeStatistics(*Build({}), {0});
  EXPECT_EQ(s.hs_m, 0.0);
  EXPECT_FALSE(s.has_direction);
}

}  // namespace
}  // namespace onesea::sea
