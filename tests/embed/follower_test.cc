#include "client/embed/follower.h"

#include <gtest/gtest.h>

#include <vector>

#include "absl/time/clock.h"
#include "client/model/other_sea.h"
#include "tests/model/welcome_for_tests.h"

namespace onesea::client {
namespace {

// What a follower told, for the test's thread.
class Told {
 public:
  Follower::Events Events() {
    return {.on_new_sea = [this] { Count(seas_); },
            .on_compared =
                [this](const Drift& drift) {
                  absl::MutexLock lock(&mutex_);
                  drifts_.push_back(drift);
                },
            .on_refused =
                [this](const absl::Status& status) {
                  absl::MutexLock lock(&mutex_);
                  refusals_.push_back(status);
                }};
  }
  bool Await(int seas, std::size_t drifts, std::size_t refusals) {
    absl::MutexLock lock(&mutex_);
    const auto enough = [&] {
      return seas_ >= seas && drifts_.size() >= drifts && refusals_.size() >= refusals;
    };
    return mutex_.AwaitWithTimeout(absl::Condition(&enough), absl::Seconds(30));
  }
  std::vector<Drift> drifts() {
    absl::MutexLock lock(&mutex_);
    return drifts_;
  }
  std::vector<absl::Status> refusals() {
    absl::MutexLock lock(&mutex_);
    return refusals_;
  }

 private:
  void Count(int& counter) {
    absl::MutexLock lock(&mutex_);
    ++counter;
  }

  absl::Mutex mutex_;
  int seas_ = 0;
  std::vector<Drift> drifts_;
  std::vector<absl::Status> refusals_;
};

wire::Frame WelcomeFrame(const sea::Recipe& recipe) {
  wire::Frame frame;
  frame.welcome = WelcomeFor(recipe);
  return frame;
}

wire::Frame ProbesFrame(std::vector<float> height_m) {
  wire::Frame frame;
  frame.probes = wire::ProbeHeights{.tick = 60, .height_m = std::move(height_m)};
  return frame;
}

TEST(Follower, FollowsAWelcomeThenComparesProbes) {
  Told told;
  Follower follower(told.Events());
  EXPECT_EQ(follower.sea(), nullptr);
  follower.Offer(WelcomeFrame(OneWaveRecipe()));
  ASSERT_TRUE(follower.WaitForSea(absl::Now() + absl::Seconds(30)).ok());
  LocalSea* const sea = follower.sea();
  ASSERT_NE(sea, nullptr);
  std::vector<float> heights;
  for (const Vec2d place : sea->session().probes_m) {
    heights.push_back(static_cast<float>(sea->HeightAt(place, TimeOfTick(60, 60))));
  }
  heights[2] += 0.5f;
  follower.Offer(ProbesFrame(heights));
  ASSERT_TRUE(told.Await(1, 1, 0));
  EXPECT_NEAR(told.drifts()[0].worst_m, 0.5, 1e-6);
  follower.Offer(WelcomeFrame(ChoppyRecipe()));
  ASSERT_TRUE(told.Await(2, 1, 0));
  EXPECT_EQ(follower.sea(), sea);
}

TEST(Follower, TellsWhyAWelcomeIsRefused) {
  Told told;
  Follower follower(told.Events());
  wire::Frame frame = WelcomeFrame(OneWaveRecipe());
  frame.welcome->component_hash ^= 1;
  follower.Offer(frame);
  EXPECT_TRUE(IsOtherSea(follower.WaitForSea(absl::Now() + absl::Seconds(30))));
  ASSERT_TRUE(told.Await(0, 0, 1));
  EXPECT_TRUE(IsOtherSea(told.refusals()[0]));
  EXPECT_EQ(follower.sea(), nullptr);
}

TEST(Follower, ProbesBeforeAnyWelcomeAreNothingAndWrongOnesAreTold) {
  Told told;
  Follower follower(told.Events());
  follower.Offer(ProbesFrame({1.0f}));
  follower.Offer(WelcomeFrame(OneWaveRecipe()));
  ASSERT_TRUE(told.Await(1, 0, 0));
  follower.Offer(ProbesFrame({1.0f}));
  ASSERT_TRUE(told.Await(1, 0, 1));
  EXPECT_EQ(told.refusals()[0].code(), absl::StatusCode::kInvalidArgument);
}

TEST(Follower, WaitingEndsAtItsDeadline) {
  Told told;
  Follower follower(told.Events());
  EXPECT_EQ(follower.WaitForSea(absl::Now() + absl::Milliseconds(20)).code(),
            absl::StatusCode::kDeadlineExceeded);
}

}  // namespace
}  // namespace onesea::client
