#include "common/sea/max_entropy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <vector>

#include "common/sea/constants.h"

namespace onesea::sea {
namespace {

constexpr int kSteps = 3600;

std::complex<double> Moment(const std::vector<double>& d, int order) {
  std::complex<double> sum;
  for (int n = 0; n < kSteps; ++n) {
    sum += d[static_cast<std::size_t>(n)] * std::polar(1.0, order * 2.0 * kPi * n / kSteps);
  }
  return sum * (2.0 * kPi / kSteps);
}

std::vector<double> Distribution(const DirectionalCoefficients& c) {
  std::vector<double> d(kSteps);
  MaxEntropyDistribution(c, d);
  return d;
}

// The estimate's defining property: it reproduces the coefficients that it was made from.
TEST(MaxEntropy, ReturnsItsCoefficients) {
  for (const DirectionalCoefficients& c :
       {DirectionalCoefficients{0.4, 0.5, 0.8, 0.5}, DirectionalCoefficients{-2.0, 1.1, 0.5, 0.2},
        DirectionalCoefficients{3.0, 3.0, 0.95, 0.83},
        DirectionalCoefficients{1.0, 0.0, 0.0, 0.3}}) {
    const std::vector<double> d = Distribution(c);
    EXPECT_NEAR(std::abs(Moment(d, 0)), 1.0, 1e-12);
    EXPECT_NEAR(std::abs(Moment(d, 1) - std::polar(c.r1, c.mean_wave_to_rad)), 0.0, 1e-9);
    EXPECT_NEAR(std::abs(Moment(d, 2) - std::polar(c.r2, 2.0 * c.principal_wave_to_rad)), 0.0,
                1e-9);
  }
}

// No coefficients in range, however noisy, give a negative or infinite density.
TEST(MaxEntropy, IsNeverNegative) {
  for (const double r1 : {0.0, 0.3, 0.9, 1.0}) {
    for (const double r2 : {0.0, 0.3, 0.9, 1.0}) {
      for (double alpha2 = 0.0; alpha2 < kPi; alpha2 += 0.4) {
        const std::vector<double> d = Distribution({1.0, alpha2, r1, r2});
        for (const double value : d) {
          EXPECT_GE(value, 0.0);
          EXPECT_LT(value, 1e4);
        }
        EXPECT_NEAR(std::abs(Moment(d, 0)), 1.0, 1e-12);
      }
    }
  }
}

TEST(MaxEntropy, PointsTheRightWay) {
  const std::vector<double> d = Distribution({2.0, 2.0, 0.9, 0.85});
  const auto peak = std::max_element(d.begin(), d.end()) - d.begin();
  EXPECT_NEAR(2.0 * kPi * static_cast<double>(peak) / kSteps, 2.0, 0.01);
}

}  // namespace
}  // namespace onesea::sea
