#include "server/session/lock_step.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/limits.h"

namespace onesea::server {
namespace {

using ::testing::HasSubstr;

StepDone Nothing() {
  return [](const absl::StatusOr<StepResult>&) {};
}

TEST(LockStepBarrier, OpensWhenAllHaveCome) {
  LockStepBarrier barrier(2, 100);
  ASSERT_TRUE(barrier.Arrive({5, "a"}, Nothing(), 0).ok());
  EXPECT_TRUE(barrier.TakeIfFull().empty());
  ASSERT_TRUE(barrier.Arrive({5, "b"}, Nothing(), 50).ok());
  EXPECT_EQ(barrier.TakeIfFull().size(), 2u);
  EXPECT_TRUE(barrier.empty());
}

TEST(LockStepBarrier, DeadlineRunsFromTheFirst) {
  LockStepBarrier barrier(3, 100);
  ASSERT_TRUE(barrier.Arrive({5, "a"}, Nothing(), 10).ok());
  ASSERT_TRUE(barrier.Arrive({5, "b"}, Nothing(), 90).ok());
  EXPECT_EQ(barrier.deadline_ns(), 110);
  EXPECT_TRUE(barrier.TakeExpired(109).empty());
  EXPECT_EQ(barrier.TakeExpired(110).size(), 2u);
  EXPECT_TRUE(barrier.TakeExpired(1000).empty());
}

TEST(LockStepBarrier, RefusesWhatWouldConfuse) {
  LockStepBarrier barrier(2, 100);
  const auto refusal = [&](StepRequest request) {
    const absl::Status status = barrier.Arrive(std::move(request), Nothing(), 0).status();
    return std::string(status.message());
  };
  EXPECT_THAT(refusal({0, "a"}), HasSubstr("ticks: 0 is outside [1, 36000]"));
  EXPECT_THAT(refusal({kStepTicksMax + 1, "a"}), HasSubstr("36001"));
  EXPECT_THAT(refusal({1, ""}), HasSubstr("participant: is empty"));
  EXPECT_THAT(refusal({1, std::string(65, 'a')}), HasSubstr("65 characters"));
  ASSERT_TRUE(barrier.Arrive({5, "a"}, Nothing(), 0).ok());
  EXPECT_THAT(refusal({5, "a"}), HasSubstr("already waiting"));
  EXPECT_THAT(refusal({6, "b"}), HasSubstr("'a' asked for 5"));
  EXPECT_EQ(barrier.waiting_count(), 1);
}

TEST(LockStepBarrier, OneWhoLeavesMayComeBack) {
  LockStepBarrier barrier(2, 100);
  const std::uint64_t ticket = *barrier.Arrive({5, "a"}, Nothing(), 0);
  EXPECT_EQ(barrier.Take(ticket).size(), 1u);
  EXPECT_TRUE(barrier.Take(ticket).empty());
  EXPECT_TRUE(barrier.Arrive({5, "a"}, Nothing(), 0).ok());
}

}  // namespace
}  // namespace onesea::server
