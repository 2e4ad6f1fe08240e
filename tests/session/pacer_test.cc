#include "server/session/pacer.h"

#include <gtest/gtest.h>

namespace onesea::server {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

// 60 Hz has no whole period in nanoseconds; after ten days the due time is still exact to the
// rounding of one number.
TEST(Pacer, NothingAccumulates) {
  Pacer pacer(60, 1.0);
  pacer.Anchor(0, 123);
  EXPECT_EQ(pacer.DueNs(60), 123 + kSecond);
  EXPECT_EQ(pacer.DueNs(1), 123 + 16'666'667);
  EXPECT_NEAR(static_cast<double>(pacer.DueNs(60LL * 86'400 * 10) - 123 - 864'000 * kSecond), 0.0,
              200.0);
}

TEST(Pacer, SpeedScalesThePeriod) {
  Pacer pacer(50, 4.0);
  pacer.Anchor(0, 0);
  EXPECT_EQ(pacer.DueNs(200), kSecond);
}

// Half of the 20 ms period of tick 1 has passed when the speed doubles: the other half takes 5 ms.
TEST(Pacer, ChangingTheSpeedKeepsSeaTimeContinuous) {
  Pacer pacer(50, 1.0);
  pacer.Anchor(0, 0);
  pacer.SetSpeed(2.0, 0, 10'000'000);
  EXPECT_EQ(pacer.DueNs(1), 15'000'000);
  EXPECT_EQ(pacer.DueNs(2), 25'000'000);
}

// Owed are 4 ticks of 0.2 ms, at the new speed 8 s: they stay owed until they are made, and
// nothing more than they.
TEST(Pacer, ChangingTheSpeedForgivesNothing) {
  Pacer pacer(50, 100.0);
  pacer.Anchor(0, 0);
  pacer.SetSpeed(0.01, 0, 1'000'000);
  EXPECT_EQ(pacer.DueNs(5), 1'000'000);
  EXPECT_FALSE(pacer.ForgiveDebt(1, 1'000'000));
  EXPECT_FALSE(pacer.ForgiveDebt(5, 1'000'000));
  EXPECT_EQ(pacer.DueNs(6), 1'000'000 + 2 * kSecond);
  EXPECT_TRUE(pacer.ForgiveDebt(6, 1'000'000 + 3 * kSecond));  // from then on as ever
  EXPECT_EQ(pacer.DueNs(6), 1'000'000 + 3 * kSecond - Pacer::kDebtMaxNs);
}

TEST(Pacer, ForgivesOnlyLargeDebt) {
  Pacer pacer(50, 1.0);
  pacer.Anchor(0, 0);
  EXPECT_FALSE(pacer.ForgiveDebt(1, 20'000'000 + Pacer::kDebtMaxNs));
  EXPECT_EQ(pacer.DueNs(1), 20'000'000);
  EXPECT_TRUE(pacer.ForgiveDebt(1, 3 * kSecond));
  EXPECT_EQ(pacer.DueNs(1), 3 * kSecond - Pacer::kDebtMaxNs);
  EXPECT_EQ(pacer.DueNs(2), pacer.DueNs(1) + 20'000'000);
}

TEST(Pacer, MeasuresTheSpeedReached) {
  Pacer pacer(50, 1.0);
  pacer.Anchor(0, 0);
  pacer.Measure(50, kSecond);
  EXPECT_DOUBLE_EQ(pacer.actual_speed(), 1.0);
  EXPECT_TRUE(pacer.keeps_up());
  pacer.Measure(70, 2 * kSecond);
  EXPECT_DOUBLE_EQ(pacer.actual_speed(), 0.4);
  EXPECT_FALSE(pacer.keeps_up());
  pacer.Measure(120, 3 * kSecond);
  EXPECT_TRUE(pacer.keeps_up());
}

// The second may be over just after a change: nothing was reached yet, which is not "speed 0".
TEST(Pacer, ASpeedJustSetIsNotMeasuredYet) {
  Pacer pacer(50, 1.0);
  pacer.Anchor(0, 0);
  pacer.SetSpeed(2.0, 49, 990'000'000);
  pacer.Measure(49, 995'000'000);
  EXPECT_DOUBLE_EQ(pacer.actual_speed(), 2.0);
  pacer.Measure(49 + 101, 2 * kSecond);  // counted from the change
  EXPECT_NEAR(pacer.actual_speed(), 2.0, 0.01);
}

}  // namespace
}  // namespace onesea::server
