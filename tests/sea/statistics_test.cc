#include "common/sea/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/sea/constants.h"

namespace onesea::sea {
namespace {

constexpr double kDeg = kPi / 180.0;

// A box of density S over [0.1, 0.3] Hz: m0 = 0.2 S, m1 = 0.04 S, m2 = (0.027 - 0.001)/3 S, m-1 =
// ln 3 S.
BuoySpectrum Box() {
  BuoySpectrum box;
  for (int i = 0; i <= 200; ++i) {
    box.frequency_hz.push_back(0.1F + 0.001F * static_cast<float>(i));
    box.density_m2_per_hz.push_back(5.0F);
  }
  return box;
}

TEST(Statistics, BoxSpectrumHasItsMomentsInClosedForm) {
  const SpectrumStatistics s = ComputeStatistics(Box());
  EXPECT_NEAR(s.hs_m, 4.0 * std::sqrt(0.2 * 5.0), 1e-5);
  EXPECT_NEAR(s.tm01_s, 5.0, 1e-4);
  EXPECT_NEAR(s.tm02_s, std::sqrt(0.2 * 3.0 / 0.026), 1e-4);
  EXPECT_NEAR(s.te_s, std::log(3.0) / 0.2, 1e-4);
  EXPECT_FALSE(s.has_direction);
}

TEST(Statistics, StatedHeightReplacesTheIntegral) {
  BuoySpectrum box = Box();
  box.hs_m = 2.5;
  EXPECT_DOUBLE_EQ(ComputeStatistics(box).hs_m, 2.5);
  EXPECT_NEAR(ComputeStatistics(box).tm01_s, 5.0, 1e-4);
}

// Three points of S = 4 - 1000 (f - 0.104)²: the parabola through them is the same one.
TEST(Statistics, ParabolaFindsThePeakBetweenBands) {
  BuoySpectrum spectrum;
  for (const float f : {0.08F, 0.1F, 0.13F}) {
    spectrum.frequency_hz.push_back(f);
    spectrum.density_m2_per_hz.push_back(4.0F - 1000.0F * (f - 0.104F) * (f - 0.104F));
  }
  const SpectrumStatistics s = ComputeStatistics(spectrum);
  EXPECT_NEAR(s.tp_s, 10.0, 1e-5);
  EXPECT_NEAR(s.tp_parabola_s, 1.0 / 0.104, 1e-4);
}

// Two bands of equal energy at 350 and 30 degrees: the mean crosses 0, and r1 = cos 20 degrees.
TEST(Statistics, MeanDirectionCrossesNorthWithoutHarm) {
  BuoySpectrum spectrum;
  for (int i = 0; i < 2; ++i) {
    spectrum.frequency_hz.push_back(0.1F + 0.1F * static_cast<float>(i));
    spectrum.density_m2_per_hz.push_back(1.0F);
    spectrum.mean_wave_to_rad.push_back(static_cast<float>((i == 0 ? 350.0 : 30.0) * kDeg));
    spectrum.principal_wave_to_rad.push_back(spectrum.mean_wave_to_rad.back());
    spectrum.r1.push_back(1.0F);
    spectrum.r2.push_back(1.0F);
  }
  const SpectrumStatistics s = ComputeStatistics(spectrum);
  EXPECT_TRUE(s.has_direction);
  EXPECT_NEAR(s.mean_wave_to_rad, 10.0 * kDeg, 1e-6);
  EXPECT_NEAR(s.spread_rad, std::sqrt(2.0 * (1.0 - std::cos(20.0 * kDeg))), 1e-6);
}

// D(θ) = cos²((θ - 40°)/2)/π has r1 = 1/2 whatever the grid; here an uneven one.
TEST(Statistics, GridOfUnevenDirectionsIntegratesOverItsCells) {
  GridSpectrum grid;
  for (double deg = 2.0; deg < 360.0; deg += deg < 180.0 ? 2.0 : 3.0) {
    grid.wave_to_rad.push_back(static_cast<float>(deg * kDeg));
  }
  for (const float f : {0.1F, 0.2F}) {
    grid.frequency_hz.push_back(f);
    for (const float angle : grid.wave_to_rad) {
      const double c = std::cos(0.5 * (angle - 40.0 * kDeg));
      grid.density_m2_per_hz_rad.push_back(static_cast<float>(10.0 * c * c / kPi));
    }
  }
  const SpectrumStatistics s = ComputeStatistics(grid);
  EXPECT_NEAR(s.hs_m, 4.0, 1e-3);
  EXPECT_NEAR(s.mean_wave_to_rad, 40.0 * kDeg, 1e-3);
  EXPECT_NEAR(s.peak_wave_to_rad, 40.0 * kDeg, 1e-3);
  EXPECT_NEAR(s.spread_rad, 1.0, 1e-3);
}

TEST(Statistics, NoEnergyGivesZerosAndNoNaN) {
  BuoySpectrum calm = Box();
  for (float& density : calm.density_m2_per_hz) density = 0.0F;
  const SpectrumStatistics s = ComputeStatistics(calm);
  EXPECT_EQ(s.hs_m, 0.0);
  EXPECT_EQ(s.tp_s, 0.0);
  EXPECT_EQ(s.tm02_s, 0.0);
}

}  // namespace
}  // namespace onesea::sea
