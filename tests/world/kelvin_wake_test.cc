// The wake of a small pressure that moves over deep water.
//
// Behind it the surface is a sum over ky of A(ky) cos(ky y) cos(kx(ky) x + φ): projected on
// cos(ky y) it is one wave in x, whose kx is measured here cell by cell. A ray leaves the track at
// atan(-dkx/dky); the cusps of Kelvin's pattern are where that is greatest.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "tests/world/grid_waves.h"

namespace onesea::world {
namespace {

constexpr double kPi = sea::kPi;
constexpr double kCellM = 0.5;
constexpr double kSpeed = 3.5;  // m/s: transverse waves of 15.7 cells
constexpr int kColumns = 512, kRows = 256;

// After a run eastwards: the column where the pressure is, and the surface.
double Drive(WaveSolver& solver) {
  std::vector<float> head(solver.height_m().size());
  double column = 30.0;
  const double step_cells = kSpeed * solver.spec().step_s / kCellM;
  for (int n = 0; column < 480.0; ++n, column += step_cells) {
    const double ramp = std::min(n / 240.0, 1.0);
    const int west = static_cast<int>(column) - 10;
    for (int row = 128 - 10; row <= 128 + 10; ++row) {
      for (int i = west; i <= west + 20; ++i) {
        head[static_cast<std::size_t>(row) * kColumns + i] =
            static_cast<float>(Hump(column, 128, 3.0, 0.02 * ramp)(i, row));
      }
    }
    solver.Step({.pressure_head_m = head});
    std::fill(head.begin(), head.end(), 0.0f);
  }
  return column;
}

// The wavenumber along x [rad/m] of the part that goes as cos(ky y), behind the pressure.
double Along(const WaveSolver& solver, double column, double ky) {
  constexpr int kWindow = 170;
  const int first = static_cast<int>(column) - 30 - kWindow;
  std::vector<double> part(kWindow);
  for (int n = 0; n < kWindow; ++n) {
    for (int row = 16; row <= 240; ++row) {
      part[n] += At(solver, first + n, row) * std::cos(ky * (row - 128) * kCellM);
    }
    part[n] *= 1.0 - std::cos(2.0 * kPi * (n + 0.5) / kWindow);  // Hann
  }
  const auto power = [&](double kx) {
    std::complex<double> sum = 0.0;
    for (int n = 0; n < kWindow; ++n) sum += part[n] * std::polar(1.0, -kx * n * kCellM);
    return std::norm(sum);
  };
  double best = 0.3;
  for (double kx = 0.3; kx < 3.0; kx += 0.01) {
    if (power(kx) > power(best)) best = kx;
  }
  for (double step = 0.005; step > 1e-5; step /= 2.0) {
    if (power(best + step) > power(best))
      best += step;
    else if (power(best - step) > power(best))
      best -= step;
  }
  return best;
}

TEST(KelvinWake, HasItsAngleAndItsWavelength) {
  SolverSpec spec = Region(SolverKind::kIwave, kColumns, kRows, kCellM, 0.0);
  const auto solver = Solver(spec);
  const double column = Drive(*solver);
  const double k0 = sea::kGravity / (kSpeed * kSpeed);
  const double transverse_m = 2.0 * kPi / Along(*solver, column, 0.0);
  std::printf("transverse waves of %.3f m, theory %.3f m\n", transverse_m, 2.0 * kPi / k0);
  EXPECT_NEAR(transverse_m * k0 / (2.0 * kPi), 1.0, 0.03);

  // Slope of kx(ky) over seven points by least squares, at its steepest.
  std::vector<double> along;
  const double step = 0.06 * k0;
  for (int n = 0; n < 32; ++n) along.push_back(Along(*solver, column, n * step));
  double steepest = 0.0;
  for (std::size_t n = 6; n + 3 < along.size(); ++n) {
    double slope = 0.0;
    for (int m = -3; m <= 3; ++m) slope += m * along[n + m] / (28.0 * step);
    steepest = std::max(steepest, slope);
  }
  const double degrees = std::atan(steepest) * 180.0 / kPi;
  std::printf("half angle %.2f degrees, theory 19.47\n", degrees);
  EXPECT_NEAR(degrees, 19.4712, 1.0);

  // The whole locus: water's waves that stand still beside the pressure, kx U = √(g k).
  for (std::size_t n = 0; n < along.size(); ++n) {
    const double k = std::hypot(along[n], static_cast<double>(n) * step);
    EXPECT_NEAR(along[n] * kSpeed / std::sqrt(sea::kGravity * k), 1.0, 0.02) << n;
  }
}

}  // namespace
}  // namespace onesea::world
