#include "server/world/iwave_design.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/sea/constants.h"

namespace onesea::world {
namespace {

constexpr double kPi = sea::kPi;
const double kDeep = std::numeric_limits<double>::infinity();

// Frequency that leapfrog gives the grid's wave, over that of water.
double FrequencyRatio(const IwaveKernels& kernels, double depth_cells, double step_number, double q,
                      double angle) {
  const double qx = q * std::cos(angle), qy = q * std::sin(angle);
  const double gradient =
      4.0 * (std::pow(std::sin(qx / 2.0), 2.0) + std::pow(std::sin(qy / 2.0), 2.0));
  const double symbol = gradient * IwaveSymbol(kernels, qx, qy);
  const double exact = q * (std::isinf(depth_cells) ? 1.0 : std::tanh(q * depth_cells));
  if (step_number == 0.0) return std::sqrt(symbol / exact);
  return 2.0 * std::asin(std::sqrt(step_number * symbol) / 2.0) / std::sqrt(step_number * exact);
}

double WorstError(const IwaveKernels& kernels, double depth_cells, double step_number, double from,
                  double to) {
  double worst = 0.0;
  for (double q = from; q <= to; q *= 1.02) {
    for (const double degrees : {0.0, 11.0, 26.0, 37.0, 45.0}) {
      const double ratio =
          FrequencyRatio(kernels, depth_cells, step_number, q, degrees * kPi / 180.0);
      worst = std::max(worst, std::abs(ratio - 1.0));
    }
  }
  return worst;
}

TEST(IwaveDesign, FrequencyIsRightOverTheStatedBand) {
  for (const int levels : {4, 5, 6}) {
    const double first = 1.0 / (1 << (levels - 1));
    for (const double step_number : {0.0, 0.00545, 0.05, 0.3}) {
      const IwaveKernels deep = DesignIwave(kDeep, step_number, levels);
      const double error = WorstError(deep, kDeep, step_number, first, 2.4);
      std::printf("%d levels, step number %.3f: %.2f %%\n", levels, step_number, 100.0 * error);
      EXPECT_LT(error, 0.003);
      for (const double depth : {0.25, 0.5, 1.0, 2.0, 4.0}) {
        const double shallow =
            WorstError(DesignIwave(depth, step_number, levels), depth, step_number, 0.001, 2.4);
        EXPECT_LT(shallow, 0.007) << depth << " cells deep, " << levels << " levels, "
                                  << step_number;
      }
    }
  }
}

// What an image of decimation does to stability: on each group of four waves that one level's
// decimation mixes, the operator is diag(kernel) + rest * w wᵀ. It has no negative eigenvalue if
// all kernels are positive and rest >= -1 / Σ w²/kernel. The next level's operator is bounded below
// by its own least eigenvalue, so the coarsest comes first.
double LeastEigenvalue(const IwaveKernels& kernels, int level, double qx, double qy) {
  IwaveKernels alone;
  alone.levels = 1;
  alone.taps[0] = kernels.taps[level];
  if (level + 1 == kernels.levels) return IwaveSymbol(alone, qx, qy);
  const double rest = LeastEigenvalue(kernels, level + 1, 2.0 * qx, 2.0 * qy);
  double diagonal[4], through[4];
  for (int n = 0; n < 4; ++n) {
    const double x = qx + kPi * (n % 2), y = qy + kPi * (n / 2);
    diagonal[n] = IwaveSymbol(alone, x, y);
    through[n] = std::pow(std::cos(x / 2.0) * std::cos(y / 2.0), 6.0);
  }
  // The least root of 1 + rest Σ w²/(d - s) = 0 or the least diagonal: by bisection from below.
  double low = *std::min_element(diagonal, diagonal + 4) + std::min(rest, 0.0) - 1.0;
  double high = *std::min_element(diagonal, diagonal + 4);
  if (rest >= 0.0 || high <= 0.0) return high;
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (low + high);
    double sum = 1.0;
    for (int m = 0; m < 4; ++m) {
      sum += rest * through[m] * through[m] / (diagonal[m] - middle);
    }
    (sum > 0.0 ? low : high) = middle;
  }
  return low;
}

TEST(IwaveDesign, SymbolIsPositiveAndBoundedOverTheBrillouinZone) {
  for (const double depth : {0.25, 1.0, 3.0, 10.0, 60.0, kDeep}) {
    for (const double step_number : {0.0, 0.05, 0.6}) {
      const IwaveKernels kernels = DesignIwave(depth, step_number, 6);
      double least = 1e9, greatest = 0.0, least_mixed = 1e9;
      for (int i = 0; i <= 96; ++i) {
        for (int j = 0; j <= i; ++j) {
          const double qx = kPi * i / 96.0, qy = kPi * j / 96.0;
          const double symbol = IwaveSymbol(kernels, qx, qy);
          const double gradient =
              4.0 * (std::pow(std::sin(qx / 2.0), 2.0) + std::pow(std::sin(qy / 2.0), 2.0));
          least = std::min(least, symbol);
          greatest = std::max(greatest, gradient * symbol);
          least_mixed = std::min(least_mixed, LeastEigenvalue(kernels, 0, qx, qy));
        }
      }
      std::printf("depth %g, step number %g: T >= %.3f (mixed %.3f), k tanh kd <= %.3f\n", depth,
                  step_number, least, least_mixed, greatest);
      EXPECT_GT(least, 0.05);
      EXPECT_GT(least_mixed, 0.0);
      EXPECT_LT(greatest, kIwaveSymbolMax);
    }
  }
}

TEST(IwaveDesign, ImagesOfDecimationAreFaint) {
  const IwaveKernels kernels = DesignIwave(kDeep, 0.005, 6);
  IwaveKernels coarser = kernels;
  coarser.levels = kernels.levels - 1;
  std::rotate(coarser.taps.begin(), coarser.taps.begin() + 1, coarser.taps.end());
  for (double q = 0.05; q <= 2.4; q *= 1.05) {
    const double image = std::pow(std::cos(q / 2.0) * std::sin(q / 2.0), 6.0) *
                         IwaveSymbol(coarser, 2.0 * q, 0.0) / IwaveSymbol(kernels, q, 0.0);
    EXPECT_LT(std::abs(image), 0.02) << q;
  }
}

}  // namespace
}  // namespace onesea::world
