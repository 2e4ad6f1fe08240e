#include "server/session/command_queue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "common/base/limits.h"

namespace onesea::server {
namespace {

constexpr std::int64_t kAheadMax = 3600;

CommandRequest Request(const std::string& id, std::optional<Tick> tick = std::nullopt) {
  CommandRequest request;
  request.header.request_id = id;
  request.header.tick = tick;
  request.command = wire::RemoveBody{.body_id = 1};
  return request;
}

class CommandQueueTest : public ::testing::Test {
 protected:
  CommandDone Note() {
    return [this](const absl::StatusOr<CommandResult>& result) {
      heard_.push_back(result.ok() ? absl::StrCat(result->id)
                                   : std::string(absl::StatusCodeToString(result.status().code())));
    };
  }
  CommandQueue queue_;
  std::vector<std::string> heard_;
};

TEST_F(CommandQueueTest, ActsAtOnceUnlessATickIsNamed) {
  EXPECT_EQ(queue_.Submit(Request("a"), Note(), 10, kAheadMax).size(), 1u);
  EXPECT_EQ(queue_.Submit(Request("b", 11), Note(), 10, kAheadMax).size(), 1u);
  EXPECT_EQ(queue_.Submit(Request("c", 12), Note(), 10, kAheadMax).size(), 0u);
  EXPECT_EQ(queue_.TakeDue(11).size(), 0u);
  EXPECT_EQ(queue_.TakeDue(12).size(), 1u);
  EXPECT_EQ(queue_.TakeDue(13).size(), 0u);
}

TEST_F(CommandQueueTest, EqualTicksKeepTheOrderOfArrival) {
  for (const char* id : {"z", "a", "m"}) queue_.Submit(Request(id, 20), Note(), 10, kAheadMax);
  std::string order;
  for (const auto& due : queue_.TakeDue(20)) order += due.request.header.request_id;
  EXPECT_EQ(order, "zam");
}

TEST_F(CommandQueueTest, ARetryGetsTheFirstAnswer) {
  const auto first = queue_.Submit(Request("a"), Note(), 10, kAheadMax);
  queue_.Submit(Request("a"), Note(), 10, kAheadMax);  // before the answer: waits with the first
  EXPECT_TRUE(heard_.empty());
  queue_.Answer(first[0].ticket, CommandResult{5, "", 0});
  EXPECT_THAT(heard_, testing::ElementsAre("5", "5"));
  EXPECT_TRUE(queue_.Submit(Request("a", 500), Note(), 99, kAheadMax).empty());  // long after
  EXPECT_THAT(heard_, testing::ElementsAre("5", "5", "5"));
}

TEST_F(CommandQueueTest, ErrorsAreRememberedToo) {
  const auto first = queue_.Submit(Request("a"), Note(), 10, kAheadMax);
  queue_.Answer(first[0].ticket, absl::NotFoundError("no body 1"));
  queue_.Submit(Request("a"), Note(), 11, kAheadMax);
  EXPECT_THAT(heard_, testing::ElementsAre("NOT_FOUND", "NOT_FOUND"));
}

TEST_F(CommandQueueTest, RefusesTicksOutOfReach) {
  EXPECT_TRUE(queue_.Submit(Request("a", 10), Note(), 10, kAheadMax).empty());
  EXPECT_TRUE(queue_.Submit(Request("b", 10 + kAheadMax + 1), Note(), 10, kAheadMax).empty());
  EXPECT_THAT(heard_, testing::ElementsAre("FAILED_PRECONDITION", "FAILED_PRECONDITION"));
  // A refusal for its tick isn't the command's answer: it may come again with another tick.
  EXPECT_EQ(queue_.Submit(Request("a"), Note(), 10, kAheadMax).size(), 1u);
}

TEST_F(CommandQueueTest, BoundsWhatWaitsAndWhatIsRemembered) {
  for (int n = 0; n < static_cast<int>(kCommandsWaitingMax); ++n) {
    queue_.Submit(Request(absl::StrCat(n), 100), Note(), 10, kAheadMax);
  }
  EXPECT_TRUE(heard_.empty());
  queue_.Submit(Request("more", 100), Note(), 10, kAheadMax);
  EXPECT_THAT(heard_, testing::ElementsAre("RESOURCE_EXHAUSTED"));
  queue_.FailAll(absl::NotFoundError("ended"));
  EXPECT_EQ(heard_.size(), 1u + kCommandsWaitingMax);
  for (int n = 0; n <= static_cast<int>(kRequestsRememberedMax); ++n) {
    const auto due = queue_.Submit(Request(absl::StrCat("r", n)), Note(), 10, kAheadMax);
    queue_.Answer(due[0].ticket, CommandResult{});
  }
  EXPECT_EQ(queue_.Submit(Request("r0"), Note(), 10, kAheadMax).size(), 1u);  // forgotten
  EXPECT_EQ(queue_.Submit(Request("r2"), Note(), 10, kAheadMax).size(), 0u);
}

}  // namespace
}  // namespace onesea::server
