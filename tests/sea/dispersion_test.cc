#include "common/sea/dispersion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/sim_time.h"
#include "common/sea/constants.h"

namespace onesea::sea {
namespace {

TEST(Dispersion, DeepWaterIsSqrtGk) {
  EXPECT_NEAR(IntrinsicFrequency(0.05, 0.0), std::sqrt(kGravity * 0.05), 1e-7);
}

// In shallow water speed forgets the period: c -> sqrt(g h). At kh = 0.1 the exact ratio is
// sqrt(tanh(0.1)/0.1) = 0.99834, so 2e-3 passes and a wrong depth term does not.
TEST(Dispersion, ShallowWaterSpeedIsSqrtGh) {
  constexpr double kDepthM = 10.0;
  constexpr double kWavenumber = 0.1 / kDepthM;
  const double speed = IntrinsicFrequency(kWavenumber, kDepthM) / kWavenumber;
  EXPECT_NEAR(speed / std::sqrt(kGravity * kDepthM), 1.0, 2e-3);
}

// The slowest water wave: about 0.23 m/s near 1.7 cm.
TEST(Dispersion, CapillarityGivesASlowestWave) {
  double slowest = 1e9;
  double at = 0.0;
  for (double k = 50.0; k < 3000.0; k += 1.0) {
    const double speed = IntrinsicFrequency(k, 0.0) / k;
    if (speed < slowest) {
      slowest = speed;
      at = k;
    }
  }
  EXPECT_NEAR(slowest, 0.232, 0.002);
  EXPECT_NEAR(2.0 * kPi / at, 0.0173, 0.0003);
}

TEST(Dispersion, GroupVelocityIsTheDerivative) {
  for (const double depth : {0.0, 0.5, 10.0, 200.0}) {
    for (const double k : {0.003, 0.05, 1.0, 20.0, 300.0}) {
      const double step = 1e-5 * k;
      const double derivative =
          (IntrinsicFrequency(k + step, depth) - IntrinsicFrequency(k - step, depth)) /
          (2.0 * step);
      EXPECT_NEAR(GroupVelocity(k, depth) / derivative, 1.0, 1e-7) << "k " << k << " h " << depth;
    }
  }
}

TEST(Dispersion, WavenumberInvertsFrequency) {
  for (const double depth : {0.0, 0.1, 3.0, 50.0, 12000.0}) {
    for (const double period : {0.1, 0.5, 1.0, 8.0, 20.0, 60.0}) {
      const double sigma = 2.0 * kPi / period;
      const double k = WavenumberOf(sigma, depth);
      EXPECT_NEAR(IntrinsicFrequency(k, depth) / sigma, 1.0, 1e-13) << period << " " << depth;
    }
  }
}

TEST(Dispersion, LoopRoundsToTheNearestMultiple) {
  const double step = 2.0 * kPi / 60.0;
  EXPECT_EQ(RoundToLoop(0.7, 0.0), 0.7);
  EXPECT_NEAR(RoundToLoop(10.4 * step, 60.0), 10.0 * step, 1e-12);
  EXPECT_NEAR(RoundToLoop(-10.6 * step, 60.0), -11.0 * step, 1e-12);
}

// Oracle: the same quotient in long double.
TEST(TurnsPerFlick, IsTheRoundedQuotient) {
  for (const double omega : {0.1, 1.0, -1.0, 3.7, 1000.0}) {
    const long double turns = static_cast<long double>(omega) /
                              (2.0L * 3.14159265358979323846264L) * 18446744073709551616.0L /
                              705600000.0L;
    const auto got = static_cast<std::int64_t>(TurnsPerFlick(omega));
    EXPECT_NEAR(static_cast<double>(static_cast<long double>(got) - turns), 0.0, 0.51) << omega;
  }
}

TEST(TurnsOfAngle, WrapsBothWays) {
  EXPECT_EQ(TurnsOfAngle(0.0), 0u);
  EXPECT_EQ(TurnsOfAngle(kPi), std::uint64_t{1} << 63);
  EXPECT_EQ(TurnsOfAngle(-kPi / 2.0), std::uint64_t{3} << 62);
  EXPECT_EQ(TurnsOfAngle(5.0 * kPi), std::uint64_t{1} << 63);
}

}  // namespace
}  // namespace onesea::sea
