#include "client/net/command_sender.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "common/base/clock.h"

namespace onesea::client {
namespace {

using ::testing::HasSubstr;

constexpr std::int64_t kPatienceNs = 20'000'000'000;  // of the tests; only a failure takes as long

// A server that answers when it is let to.
class FakeServer {
 public:
  CommandSender::Call call() {
    return [this](const wire::CommandHeader& header,
                  const wire::WorldCommand& command) -> absl::StatusOr<CommandAnswer> {
      absl::MutexLock lock(&mutex_);
      request_ids_.push_back(header.request_id);
      ++calls_;
      mutex_.Await(absl::Condition(&open_));
      if (failures_ > 0) {
        --failures_;
        return absl::UnavailableError("the wire is cut");
      }
      if (!refusal_.ok()) return refusal_;
      if (const auto* drive = std::get_if<wire::DriveBody>(&command)) {
        throttles_.push_back(drive->throttle[0]);
      }
      CommandAnswer answer;
      answer.tick = ++tick_;
      return answer;
    };
  }
  void Open() {
    absl::MutexLock lock(&mutex_);
    open_ = true;
  }
  void Shut() {
    absl::MutexLock lock(&mutex_);
    open_ = false;
  }
  void Fail(int calls) {
    absl::MutexLock lock(&mutex_);
    failures_ = calls;
  }
  void Refuse(absl::Status status) {
    absl::MutexLock lock(&mutex_);
    refusal_ = std::move(status);
  }
  void AwaitCalls(int count) {
    absl::MutexLock lock(&mutex_);
    wanted_ = count;
    const auto enough = [this] {
      mutex_.AssertHeld();
      return calls_ >= wanted_;
    };
    EXPECT_TRUE(mutex_.AwaitWithTimeout(absl::Condition(&enough), absl::Nanoseconds(kPatienceNs)));
  }
  std::vector<double> throttles() {
    absl::MutexLock lock(&mutex_);
    return throttles_;
  }
  std::vector<std::string> request_ids() {
    absl::MutexLock lock(&mutex_);
    return request_ids_;
  }

 private:
  absl::Mutex mutex_;
  bool open_ = true;
  int failures_ = 0, calls_ = 0, wanted_ = 0;
  Tick tick_ = 0;
  absl::Status refusal_;
  std::vector<double> throttles_;
  std::vector<std::string> request_ids_;
};

TEST(CommandSender, EveryCommandHasOneOutcomeWithItsNumber) {
  FakeServer server;
  CommandSender sender("a", server.call());
  std::set<std::int64_t> sent;
  for (int n = 0; n < 20; ++n) sent.insert(sender.Send(wire::RemoveBody{1}));
  ASSERT_TRUE(sender.AwaitAll(kPatienceNs));
  std::set<std::int64_t> done;
  for (const CommandSender::Outcome& outcome : sender.Take()) {
    EXPECT_TRUE(outcome.answer.ok());
    EXPECT_TRUE(done.insert(outcome.number).second);
  }
  EXPECT_EQ(done, sent);
  EXPECT_TRUE(sender.Take().empty());
}

// With all threads held by the server, of a hundred orders only the newest waits.
TEST(CommandSender, TheNewestOrderWins) {
  FakeServer server;
  server.Shut();
  CommandSender sender("a", server.call());
  for (int n = 0; n < CommandSender::kUnderWayMax; ++n) sender.Send(wire::RemoveBody{1});
  server.AwaitCalls(CommandSender::kUnderWayMax);
  std::int64_t last = 0;
  for (int n = 1; n <= 100; ++n) last = sender.Send(wire::DriveBody{1, {0.01 * n}, {0.0}});
  sender.Send(wire::DriveBody{2, {0.25}, {0.0}});  // another boat's
  server.Open();
  ASSERT_TRUE(sender.AwaitAll(kPatienceNs));
  EXPECT_THAT(server.throttles(), testing::UnorderedElementsAre(1.0, 0.25));
  int replaced = 0;
  for (const CommandSender::Outcome& outcome : sender.Take()) {
    if (absl::IsCancelled(outcome.answer.status())) ++replaced;
    if (outcome.number == last) {
      EXPECT_TRUE(outcome.answer.ok());
    }
  }
  EXPECT_EQ(replaced, 99);
}

TEST(CommandSender, WhatGotLostIsSentAgainWithTheSameId) {
  FakeServer server;
  server.Fail(2);
  CommandSender sender("a", server.call());
  sender.Send(wire::SpawnBody{});
  server.AwaitCalls(2);
  EXPECT_THAT(sender.trouble(), HasSubstr("the wire is cut"));
  ASSERT_TRUE(sender.AwaitAll(kPatienceNs));
  const auto outcomes = sender.Take();
  ASSERT_EQ(outcomes.size(), 1u);
  EXPECT_TRUE(outcomes[0].answer.ok());
  EXPECT_EQ(sender.trouble(), "");
  const std::vector<std::string> ids = server.request_ids();
  ASSERT_EQ(ids.size(), 3u);
  EXPECT_EQ(std::set<std::string>(ids.begin(), ids.end()).size(), 1u);
}

// An order that got lost is not sent again once a newer one exists: it would undo that one.
TEST(CommandSender, ALostOrderDoesNotUndoANewerOne) {
  FakeServer server;
  server.Shut();
  server.Fail(1);
  CommandSender sender("a", server.call());
  const std::int64_t lost = sender.Send(wire::DriveBody{1, {0.1}, {0.0}});
  server.AwaitCalls(1);
  sender.Send(wire::DriveBody{1, {0.9}, {0.0}});
  server.AwaitCalls(2);
  server.Open();
  ASSERT_TRUE(sender.AwaitAll(kPatienceNs));
  // Whichever of the two met the failure, the boat ends up with the newer one.
  ASSERT_FALSE(server.throttles().empty());
  EXPECT_EQ(server.throttles().back(), 0.9);
  for (const CommandSender::Outcome& outcome : sender.Take()) {
    if (outcome.number == lost && !outcome.answer.ok()) {
      EXPECT_TRUE(absl::IsCancelled(outcome.answer.status()));
    }
  }
}

TEST(CommandSender, ARefusalIsToldAndNotRepeated) {
  FakeServer server;
  server.Refuse(absl::PermissionDeniedError("body 1 is held by 'Anna'"));
  CommandSender sender("a", server.call());
  sender.Send(wire::DriveBody{1, {0.1}, {0.0}});
  ASSERT_TRUE(sender.AwaitAll(kPatienceNs));
  const auto outcomes = sender.Take();
  ASSERT_EQ(outcomes.size(), 1u);
  EXPECT_THAT(std::string(outcomes[0].answer.status().message()), HasSubstr("Anna"));
  EXPECT_EQ(server.request_ids().size(), 1u);
}

TEST(CommandSender, SendingNeverWaits) {
  FakeServer server;
  server.Shut();
  CommandSender sender("a", server.call());
  for (int n = 0; n < 1000; ++n) sender.Send(wire::RemoveBody{1});  // more than may wait
  int refused = 0;
  for (const CommandSender::Outcome& outcome : sender.Take()) {
    if (absl::IsResourceExhausted(outcome.answer.status())) ++refused;
  }
  EXPECT_GE(refused,
            1000 - static_cast<int>(CommandSender::kWaitingMax) - CommandSender::kUnderWayMax);
  server.Open();
}

}  // namespace
}  // namespace onesea::client
