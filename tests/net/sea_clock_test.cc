#include "client/net/sea_clock.h"

#include <gtest/gtest.h>

#include <cmath>

namespace onesea::client {
namespace {

constexpr std::int64_t kMillisecond = 1'000'000;
constexpr std::int64_t kSecond = 1'000 * kMillisecond;
constexpr int kRateHz = 60;
constexpr double kFlickS = 1.0 / static_cast<double>(kFlicksPerSecond);

wire::Stamp StampAt(Tick tick, std::int64_t server_ns, double speed = 1.0) {
  wire::Stamp stamp;
  stamp.tick = tick;
  stamp.server_monotonic_ns = server_ns;
  stamp.speed = speed;
  return stamp;
}

TEST(SeaClock, RunsFromTheStampAtItsSpeed) {
  for (double speed : {0.01, 0.5, 1.0, 3.0, 100.0}) {
    SeaClock clock;
    EXPECT_FALSE(clock.valid());
    clock.OnStamp(StampAt(600, 50 * kSecond, speed), kRateHz, /*offset_ns=*/-20 * kSecond);
    EXPECT_TRUE(clock.valid());
    // The server's 50 s is our 70 s.
    EXPECT_EQ(clock.Exact(70 * kSecond), TimeOfTick(600, kRateHz));
    EXPECT_NEAR(clock.Exact(71 * kSecond).Seconds(), 10.0 + speed, kFlickS);
    EXPECT_NEAR(clock.Exact(70 * kSecond + 1).Seconds(), 10.0 + speed * 1e-9, kFlickS);
  }
}

// A session of a century still has nanoseconds: nothing is accumulated.
TEST(SeaClock, ALongSessionLosesNothing) {
  constexpr Tick kCentury = Tick{60} * 3'155'760'000;
  SeaClock clock;
  clock.OnStamp(StampAt(kCentury, 7 * kSecond), kRateHz, 0);
  EXPECT_EQ(clock.Exact(8 * kSecond), TimeOfTick(kCentury + 60, kRateHz));
}

// Tick of a century, clocks that disagree by 73 years, hundredfold speed: wrong, but in 64 bits.
TEST(SeaClock, ClocksThatLieStayInsideSixtyFourBits) {
  constexpr std::int64_t kYearsNs = std::int64_t{1} << 61;
  constexpr Tick kCentury = Tick{60} * 3'155'760'000;
  for (const std::int64_t offset_ns : {kYearsNs, -kYearsNs}) {
    SeaClock clock;
    clock.OnStamp(StampAt(kCentury, 0, 100.0), kRateHz, offset_ns);
    const double away_s = (clock.Exact(kSecond) - TimeOfTick(kCentury, kRateHz)).Seconds();
    EXPECT_NEAR(std::abs(away_s), 3.2e9, 1.0);
    EXPECT_EQ(away_s > 0.0, offset_ns > 0);
  }
}

TEST(SeaClock, RenderTimeWaitsInsteadOfGoingBack) {
  SeaClock clock;
  clock.OnStamp(StampAt(0, 0), kRateHz, 0);
  const SimTime before = clock.Render(kSecond);
  // A better offset says that we were 5 ms ahead.
  clock.OnStamp(StampAt(0, 0), kRateHz, -5 * kMillisecond);
  EXPECT_LT(clock.Exact(kSecond + kMillisecond), before);
  EXPECT_EQ(clock.Render(kSecond + kMillisecond), before);
  EXPECT_EQ(clock.Render(kSecond + 4 * kMillisecond), before);
  // The line has caught up: on it, without a filter.
  EXPECT_EQ(clock.Render(kSecond + 8 * kMillisecond), clock.Exact(kSecond + 8 * kMillisecond));
  EXPECT_GT(clock.Render(kSecond + 9 * kMillisecond), before);
}

TEST(SeaClock, AServerThatSlowsDownIsFollowedWithoutGoingBack) {
  SeaClock clock;
  clock.OnStamp(StampAt(0, 0), kRateHz, 0);
  SimTime last;
  // The server makes 50 of its 60 ticks a second and says so each second.
  for (std::int64_t ms = 0; ms < 10'000; ++ms) {
    if (ms % 1000 == 0) clock.OnStamp(StampAt(ms / 1000 * 50, ms * kMillisecond), kRateHz, 0);
    const SimTime now = clock.Render(ms * kMillisecond);
    EXPECT_GE(now, last);
    last = now;
  }
  EXPECT_NEAR(last.Seconds(), 10.0 * 50 / 60, 0.2);
}

// The news of a hold comes late, so the screen has run ahead; then it must show exactly what all
// others show.
TEST(SeaClock, AHeldSeaIsExactlyAtItsTick) {
  SeaClock clock;
  clock.OnStamp(StampAt(0, 0), kRateHz, 0);
  EXPECT_GT(clock.Render(kSecond + 3 * kMillisecond), TimeOfTick(60, kRateHz));
  clock.OnStamp(StampAt(60, kSecond, 0.0), kRateHz, 0);
  EXPECT_EQ(clock.Render(kSecond + 4 * kMillisecond), TimeOfTick(60, kRateHz));
  EXPECT_EQ(clock.Render(9 * kSecond), TimeOfTick(60, kRateHz));
  // Lock-step: tick by tick.
  clock.OnStamp(StampAt(61, 10 * kSecond, 0.0), kRateHz, 0);
  EXPECT_EQ(clock.Render(10 * kSecond), TimeOfTick(61, kRateHz));
}

TEST(SeaClock, ResumesFromTheHeldTick) {
  SeaClock clock;
  clock.OnStamp(StampAt(60, kSecond, 0.0), kRateHz, 0);
  EXPECT_EQ(clock.Render(5 * kSecond), TimeOfTick(60, kRateHz));
  clock.OnStamp(StampAt(60, 6 * kSecond, 1.0), kRateHz, 0);
  EXPECT_EQ(clock.Render(6 * kSecond), TimeOfTick(60, kRateHz));
  EXPECT_EQ(clock.Render(7 * kSecond), TimeOfTick(120, kRateHz));
}

TEST(SeaClock, AChangeOfSpeedDoesNotJump) {
  SeaClock clock;
  clock.OnStamp(StampAt(0, 0, 1.0), kRateHz, 0);
  EXPECT_EQ(clock.Render(kSecond), TimeOfTick(60, kRateHz));
  clock.OnStamp(StampAt(60, kSecond, 4.0), kRateHz, 0);
  EXPECT_EQ(clock.Render(kSecond), TimeOfTick(60, kRateHz));
  EXPECT_EQ(clock.Render(2 * kSecond), TimeOfTick(300, kRateHz));
}

TEST(SeaClock, ASessionThatBeganAnewIsFollowedBack) {
  SeaClock clock;
  clock.OnStamp(StampAt(6000, 0), kRateHz, 0);
  clock.Render(0);
  clock.OnStamp(StampAt(0, kSecond), kRateHz, 0);
  EXPECT_EQ(clock.Render(kSecond), SimTime{});
}

}  // namespace
}  // namespace onesea::client
