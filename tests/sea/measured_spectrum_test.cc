// Buoy and grid spectra as densities over wave vectors.

#include <gtest/gtest.h>

#include <cmath>

#include "common/sea/constants.h"
#include "common/sea/dispersion.h"
#include "common/sea/spectrum_buoy.h"
#include "common/sea/spectrum_grid.h"

namespace onesea::sea {
namespace {

BuoySpectrum Buoy() {
  BuoySpectrum s;
  for (int n = 0; n < 46; ++n) {
    const double f = 0.0325 + 0.01 * n;
    const double r = 0.1 / f;
    s.frequency_hz.push_back(static_cast<float>(f));
    s.density_m2_per_hz.push_back(
        static_cast<float>(5.0 * std::pow(r, 5) * std::exp(-1.25 * r * r * r * r)));
    s.mean_wave_to_rad.push_back(0.5f + 0.01f * static_cast<float>(n));
    s.principal_wave_to_rad.push_back(0.55f + 0.01f * static_cast<float>(n));
    s.r1.push_back(0.85f);
    s.r2.push_back(0.6f);
  }
  return s;
}

GridSpectrum Grid() {
  GridSpectrum s;
  for (int m = 0; m < 24; ++m) s.wave_to_rad.push_back(static_cast<float>(-3.0 + m * kPi / 12.0));
  for (int n = 0; n < 20; ++n) {
    s.frequency_hz.push_back(static_cast<float>(0.05 * std::pow(1.1, n)));
    for (const float theta : s.wave_to_rad) {
      const double c = std::cos(0.5 * (static_cast<double>(theta) - 1.0));
      s.density_m2_per_hz_rad.push_back(static_cast<float>(n * std::pow(c * c, 4)));
    }
  }
  return s;
}

double TrapezoidVariance(const std::vector<float>& f, const std::vector<float>& density) {
  double sum = 0.0;
  for (std::size_t n = 1; n < f.size(); ++n) {
    sum += 0.5 * (density[n] + density[n - 1]) * (f[n] - f[n - 1]);
  }
  return sum;
}

double VarianceOf(const WaveSpectrum& spectrum) { return RadialMoment(spectrum, 1e-4, 364.0, 0); }

TEST(BuoySpectrum, KeepsItsVarianceAndAddsItsTail) {
  BuoySpectrum s = Buoy();
  s.add_tail = false;
  const double band = TrapezoidVariance(s.frequency_hz, s.density_m2_per_hz);
  EXPECT_NEAR(VarianceOf(*MakeBuoySpectrum(s, 0.0)) / band, 1.0, 2e-3);
  s.add_tail = true;
  const double tail = s.density_m2_per_hz.back() * s.frequency_hz.back() / 4.0;
  EXPECT_NEAR(VarianceOf(*MakeBuoySpectrum(s, 0.0)) / (band + tail), 1.0, 2e-3);
}

TEST(BuoySpectrum, IsScaledToThePublishersHs) {
  BuoySpectrum s = Buoy();
  s.add_tail = false;
  s.hs_m = 4.71;
  for (const double depth : {0.0, 15.0}) {
    EXPECT_NEAR(4.0 * std::sqrt(VarianceOf(*MakeBuoySpectrum(s, depth))), 4.71, 0.005);
  }
}

TEST(BuoySpectrum, OneDimensionalDataTakeTheFallback) {
  BuoySpectrum s = Buoy();
  s.mean_wave_to_rad.clear();
  s.principal_wave_to_rad.clear();
  s.r1.clear();
  s.r2.clear();
  s.fallback_wave_to_rad = -2.0;
  s.fallback_spreading = {SpreadingKind::kCosine2s, 10.0, 0.0};
  const DirectionTable table = TableOf(s);
  double x = 0.0;
  double y = 0.0;
  for (int n = 0; n < kTableDirections; ++n) {
    x += table.distribution[static_cast<std::size_t>(n)] * std::cos(n * kPi / 180.0) * kPi / 180.0;
    y += table.distribution[static_cast<std::size_t>(n)] * std::sin(n * kPi / 180.0) * kPi / 180.0;
  }
  EXPECT_NEAR(std::atan2(y, x), -2.0, 1e-9);
  EXPECT_NEAR(std::hypot(x, y), 10.0 / 11.0, 1e-6);
}

// At the grid's own frequencies and directions the density is the grid's, turned into wavenumbers
// by E(f, θ) df dθ = P k dk dθ.
TEST(GridSpectrum, PassesThroughItsPoints) {
  const GridSpectrum s = Grid();
  const auto spectrum = MakeGridSpectrum(s, 0.0);
  for (const std::size_t n : {3u, 10u, 18u}) {
    const double k = WavenumberOf(2.0 * kPi * s.frequency_hz[n], 0.0);
    const WaveSpectrum::Node node = spectrum->NodeAt(k);
    for (const std::size_t m : {12u, 15u, 20u}) {
      const double theta = s.wave_to_rad[m];
      const double density =
          node.radial * spectrum->Shape(node, {std::cos(theta), std::sin(theta)});
      const double want =
          s.density_m2_per_hz_rad[n * 24 + m] * GroupVelocity(k, 0.0) / (2.0 * kPi) / k;
      EXPECT_NEAR(density / want, 1.0, 0.02) << n << " " << m;
    }
  }
}

TEST(GridSpectrum, KeepsTheEnergyOfUnevenDirections) {
  GridSpectrum s;
  s.frequency_hz = {0.1f, 0.12f, 0.14f};
  s.wave_to_rad = {-2.0f, 0.1f, 0.5f, 2.9f};
  s.density_m2_per_hz_rad = {0, 0, 0, 0, 0, 4, 8, 0, 0, 0, 0, 0};
  s.add_tail = false;
  // The straight lines between the given directions: triangles and a trapezoid.
  const double row = 0.5 * 2.1 * 4.0 + 0.5 * 0.4 * 12.0 + 0.5 * 2.4 * 8.0;
  EXPECT_NEAR(TableOf(s).density_m2_per_hz[1], row, 1e-5);
  EXPECT_NEAR(VarianceOf(*MakeGridSpectrum(s, 0.0)) / (row * 0.02), 1.0, 1e-3);
}

TEST(TableSpectrum, ShapeIntegratesToItsDensity) {
  const auto spectrum = MakeBuoySpectrum(Buoy(), 0.0);
  for (const double k : {0.01, 0.05, 0.3, 3.0}) {
    const WaveSpectrum::Node node = spectrum->NodeAt(k);
    double sum = 0.0;
    for (int n = 0; n < 3600; ++n) {
      const double theta = 2.0 * kPi * n / 3600.0;
      sum += node.radial * spectrum->Shape(node, {std::cos(theta), std::sin(theta)});
    }
    EXPECT_NEAR(sum * 2.0 * kPi / 3600.0 * k / spectrum->Omnidirectional(k), 1.0, 1e-6);
  }
}

}  // namespace
}  // namespace onesea::sea
