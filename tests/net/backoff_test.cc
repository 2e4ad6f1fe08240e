#include "client/net/backoff.h"

#include <gtest/gtest.h>

#include <set>

namespace onesea::client {
namespace {

constexpr BackoffOptions kOptions{.first_ns = 100, .longest_ns = 1000};

TEST(Backoff, DoublesUpToTheLongestWithJitterInTheUpperHalf) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Backoff backoff(kOptions, seed);
    for (const std::int64_t limit_ns : {100, 200, 400, 800, 1000, 1000, 1000}) {
      const std::int64_t wait_ns = backoff.NextNs();
      EXPECT_GE(wait_ns, limit_ns / 2);
      EXPECT_LE(wait_ns, limit_ns);
    }
  }
}

TEST(Backoff, BeginsAnewAfterASuccess) {
  Backoff backoff(kOptions, 1);
  for (int n = 0; n < 5; ++n) backoff.NextNs();
  backoff.Reset();
  EXPECT_LE(backoff.NextNs(), 100);
}

TEST(Backoff, ACrowdDoesNotComeBackInStep) {
  std::set<std::int64_t> waits;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    waits.insert(Backoff({.first_ns = 1'000'000, .longest_ns = 1'000'000}, seed).NextNs());
  }
  EXPECT_GT(waits.size(), 190u);
}

TEST(Backoff, TheLargestLimitsDoNotOverflow) {
  Backoff backoff({.first_ns = 1, .longest_ns = INT64_MAX / 2}, 1);
  for (int n = 0; n < 1000; ++n) EXPECT_GE(backoff.NextNs(), 0);
}

}  // namespace
}  // namespace onesea::client
