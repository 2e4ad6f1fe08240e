// Clock synchronisation, sea time and back-off, against clocks that the tests make up.

#include <gtest/gtest.h>

#include "client/net/backoff.h"
#include "client/net/clock_sync.h"
#include "client/net/sea_clock.h"

namespace onesea::client {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kS = 1'000'000'000;

TEST(ClockSync, KnowsNothingBeforeTheFirstExchange) {
  EXPECT_FALSE(ClockSync().Estimate(0).has_value());
}

// The true offset always lies within the stated error, whatever the two ways take.
TEST(ClockSync, ErrorBoundHoldsForAsymmetricPaths) {
  constexpr std::int64_t kOffset = 123 * kS;
  for (const std::int64_t there_ns : {0 * kMs, 1 * kMs, 7 * kMs}) {
    for (const std::int64_t back_ns : {0 * kMs, 2 * kMs, 9 * kMs}) {
      ClockSync sync;
      sync.Add(5 * kS, 5 * kS + there_ns + kOffset, 5 * kS + there_ns + back_ns);
      const auto estimate = sync.Estimate(5 * kS + there_ns + back_ns);
      ASSERT_TRUE(estimate.has_value());
      EXPECT_LE(std::abs(estimate->offset_ns - kOffset), estimate->error_ns);
      EXPECT_EQ(estimate->error_ns, (there_ns + back_ns) / 2);
    }
  }
}

TEST(ClockSync, KeepsTheLeastRoundTripWhileItIsYoung) {
  ClockSync sync;
  sync.Add(0, 1000 * kS + kMs, 2 * kMs);                      // round trip 2 ms
  sync.Add(1 * kS, 1001 * kS + 30 * kMs, 1 * kS + 40 * kMs);  // 40 ms, offset wrong by 10 ms
  EXPECT_EQ(sync.Estimate(2 * kS)->offset_ns, 1000 * kS);
  // At 50 ppm the good one is worth less than the bad one after 380 s: (40 - 2)/2 ms / 50e-6.
  EXPECT_EQ(sync.Estimate(379 * kS)->round_trip_ns, 2 * kMs);
}

TEST(ClockSync, IgnoresAnExchangeThatEndsBeforeItBegan) {
  ClockSync sync;
  sync.Add(10, 5, 9);
  EXPECT_FALSE(sync.Estimate(10).has_value());
}

wire::Stamp MakeStamp(Tick tick, std::int64_t server_ns, double speed) {
  return {.tick = tick, .server_monotonic_ns = server_ns, .speed = speed};
}

TEST(SeaClock, ExtrapolatesTheStampAtItsSpeed) {
  SeaClock clock;
  EXPECT_FALSE(clock.Now(0).has_value());
  clock.SetStamp(MakeStamp(600, 100 * kS, 2.0), 60);
  EXPECT_FALSE(clock.Now(0).has_value()) << "without an offset";
  clock.SetOffset(90 * kS);
  EXPECT_DOUBLE_EQ(clock.Now(10 * kS)->Seconds(), 10.0);
  EXPECT_DOUBLE_EQ(clock.Now(11 * kS)->Seconds(), 12.0);
}

TEST(SeaClock, StandsWhenHeldAndGoesOnWhenResumed) {
  SeaClock clock;
  clock.SetOffset(0);
  clock.SetStamp(MakeStamp(60, 1 * kS, 1.0), 60);
  EXPECT_DOUBLE_EQ(clock.Now(2 * kS)->Seconds(), 2.0);
  clock.SetStamp(MakeStamp(120, 2 * kS, 0.0), 60);
  EXPECT_DOUBLE_EQ(clock.Now(50 * kS)->Seconds(), 2.0);
  clock.SetStamp(MakeStamp(120, 60 * kS, 0.5), 60);
  EXPECT_DOUBLE_EQ(clock.Now(62 * kS)->Seconds(), 3.0);
}

// A better offset or a late hold would take back what was shown: time stands still instead.
TEST(SeaClock, NeverGoesBackALittle) {
  SeaClock clock;
  clock.SetStamp(MakeStamp(0, 0, 1.0), 60);
  clock.SetOffset(5 * kMs);
  const SimTime shown = *clock.Now(1 * kS);
  clock.SetOffset(0);
  EXPECT_EQ(*clock.Now(1 * kS + kMs), shown);
  EXPECT_GT(*clock.Now(1 * kS + 6 * kMs), shown);
}

TEST(SeaClock, FollowsANewSessionUnderTheOldName) {
  SeaClock clock;
  clock.SetOffset(0);
  clock.SetStamp(MakeStamp(6000, 0, 1.0), 60);
  EXPECT_DOUBLE_EQ(clock.Now(0)->Seconds(), 100.0);
  clock.SetStamp(MakeStamp(0, 1 * kS, 1.0), 60);
  EXPECT_DOUBLE_EQ(clock.Now(1 * kS)->Seconds(), 0.0);
}

TEST(SeaClock, AStampFromTheFutureIsNotExtrapolatedBackwards) {
  SeaClock clock;
  clock.SetOffset(0);
  clock.SetStamp(MakeStamp(60, 5 * kS, 1.0), 60);
  EXPECT_DOUBLE_EQ(clock.Now(1 * kS)->Seconds(), 1.0);
}

TEST(Backoff, DoublesToItsLimitAndSpreads) {
  Backoff backoff;
  EXPECT_EQ(backoff.NextNs(0.0), Backoff::kFirstNs / 2);
  EXPECT_EQ(backoff.NextNs(0.0), Backoff::kFirstNs);
  for (int n = 0; n < 10; ++n) backoff.NextNs(0.5);
  EXPECT_EQ(backoff.NextNs(0.0), Backoff::kMaxNs / 2);
  EXPECT_LE(backoff.NextNs(0.999), Backoff::kMaxNs);
  backoff.Reset();
  EXPECT_EQ(backoff.NextNs(0.0), Backoff::kFirstNs / 2);
}

}  // namespace
}  // namespace onesea::client
