#include "client/net/clock_sync.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace onesea::client {
namespace {

constexpr std::int64_t kMillisecond = 1'000'000;
constexpr std::int64_t kSecond = 1'000 * kMillisecond;
constexpr std::int64_t kTrueOffsetNs = 123'456'789'012;

// A path with the given delays to a server whose clock is `offset_ns` ahead of ours.
ClockExchange Exchange(std::int64_t sent_ns, std::int64_t out_ns, std::int64_t back_ns,
                       std::int64_t offset_ns = kTrueOffsetNs) {
  return {sent_ns, sent_ns + out_ns + offset_ns, sent_ns + out_ns + back_ns};
}

TEST(ClockSync, EqualDelaysGiveTheExactOffset) {
  ClockSync sync;
  EXPECT_FALSE(sync.synchronised());
  sync.Add(Exchange(kSecond, kMillisecond, kMillisecond));
  EXPECT_EQ(sync.offset_ns(), kTrueOffsetNs);
  EXPECT_EQ(sync.round_trip_ns(), 2 * kMillisecond);
}

TEST(ClockSync, KeepsTheExchangeOfLeastRoundTrip) {
  ClockSync sync;
  sync.Add(Exchange(0, 9 * kMillisecond, kMillisecond));
  sync.Add(Exchange(20 * kMillisecond, 100'000, 100'000));
  sync.Add(Exchange(40 * kMillisecond, kMillisecond, 30 * kMillisecond));
  EXPECT_EQ(sync.offset_ns(), kTrueOffsetNs);
  EXPECT_EQ(sync.round_trip_ns(), 200'000);
}

// All delay on one side is the worst there can be, and it is exactly the bound.
TEST(ClockSync, AsymmetricDelayStaysInsideTheBound) {
  for (const bool out : {false, true}) {
    ClockSync sync;
    sync.Add(Exchange(0, out ? 4 * kMillisecond : 0, out ? 0 : 4 * kMillisecond));
    const std::int64_t error_ns = std::abs(sync.offset_ns() - kTrueOffsetNs);
    EXPECT_EQ(error_ns, 2 * kMillisecond);
    EXPECT_LE(error_ns, sync.ErrorBoundNs(4 * kMillisecond));
  }
}

TEST(ClockSync, RandomDelaysNeverLeaveTheBound) {
  std::mt19937_64 random(3);
  std::exponential_distribution<double> delay_ms(0.5);
  ClockSync sync;
  for (int n = 0; n < 2000; ++n) {
    const auto out = static_cast<std::int64_t>(delay_ms(random) * 1e6);
    const auto back = static_cast<std::int64_t>(delay_ms(random) * 1e6);
    const ClockExchange exchange = Exchange(n * kSecond, out, back);
    sync.Add(exchange);
    EXPECT_LE(std::abs(sync.offset_ns() - kTrueOffsetNs), sync.ErrorBoundNs(exchange.received_ns));
  }
}

TEST(ClockSync, DriftingClocksAreFollowedInsideTheBound) {
  ClockSync sync;
  for (int n = 0; n < 1000; ++n) {
    const std::int64_t local_ns = n * 4 * kSecond;
    const auto offset_ns =
        kTrueOffsetNs + std::llround(kClockDriftMax * static_cast<double>(local_ns));
    // One lucky exchange at the start must not be believed for ever.
    const std::int64_t delay_ns = n == 0 ? 1000 : kMillisecond / 2;
    const ClockExchange exchange = Exchange(local_ns, delay_ns, delay_ns, offset_ns);
    sync.Add(exchange);
    EXPECT_LE(std::abs(sync.offset_ns() - offset_ns), sync.ErrorBoundNs(exchange.received_ns) + 1);
  }
}

TEST(ClockSync, AJumpOfTheServersClockIsForgottenAfterTheWindow) {
  ClockSync sync;
  for (int n = 0; n < 100; ++n) sync.Add(Exchange(n * kSecond, 1000, 1000));
  const std::int64_t jumped_ns = kTrueOffsetNs - 3600 * kSecond;
  for (int n = 100; n < 100 + ClockSync::kWindow; ++n) {
    sync.Add(Exchange(n * kSecond, kMillisecond, kMillisecond, jumped_ns));
  }
  EXPECT_EQ(sync.offset_ns(), jumped_ns);
}

TEST(ClockSync, AnAnswerBeforeTheQuestionIsIgnored) {
  ClockSync sync;
  sync.Add({10, 0, 9});
  EXPECT_FALSE(sync.synchronised());
}

TEST(ClockSync, TheBoundGrowsWithAge) {
  ClockSync sync;
  sync.Add(Exchange(0, 1000, 1000));
  EXPECT_EQ(sync.ErrorBoundNs(2000), 1000);
  EXPECT_EQ(sync.ErrorBoundNs(2000 + 20 * kSecond), 1000 + kMillisecond);  // 50 ppm
}

}  // namespace
}  // namespace onesea::client
