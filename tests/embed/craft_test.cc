#include "client/embed/craft.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "client/model/local_world.h"

namespace onesea::client {
namespace {

using ::testing::HasSubstr;

constexpr std::int64_t kSecondNs = 1'000'000'000;

// The other end of a craft: remembers what it sent, and answers.
class Bridge {
 public:
  struct Sent {
    wire::WorldCommand command;
    std::string lease;
  };

  Craft::Send Send() {
    return [this](wire::WorldCommand command, std::string lease) {
      sent_.push_back({std::move(command), std::move(lease)});
      return static_cast<std::int64_t>(sent_.size());
    };
  }
  std::int64_t count() const { return static_cast<std::int64_t>(sent_.size()); }
  const Sent& at(std::int64_t number) const { return sent_[static_cast<std::size_t>(number) - 1]; }
  // The newest one's content; fails if it is of another kind.
  template <typename Command>
  Command Newest() const {
    const auto* command = std::get_if<Command>(&sent_.back().command);
    EXPECT_NE(command, nullptr) << sent_.back().command.index();
    return command == nullptr ? Command{} : *command;
  }

 private:
  std::vector<Sent> sent_;
};

class CraftTest : public testing::Test {
 protected:
  CraftTest() { spawn_.body.owner = "me"; }

  bool Answer(Craft& craft, std::int64_t number, std::uint32_t id = 0, Tick tick = 1,
              std::string lease = "") {
    CommandAnswer answer;
    answer.tick = tick;
    answer.id = id;
    answer.lease = std::move(lease);
    return craft.Take({number, answer});
  }
  static bool Refuse(Craft& craft, std::int64_t number, absl::Status why) {
    return craft.Take({number, std::move(why)});
  }
  void Advance(Craft& craft, double seconds) {
    now_ns_ += static_cast<std::int64_t>(seconds * kSecondNs);
    craft.Advance(now_ns_, world_);
  }
  // Number 1 was the spawn.
  Craft Held(bool wake = false) {
    Craft craft(bridge_.Send(), spawn_, wake);
    EXPECT_TRUE(Answer(craft, 1, 7, 1, "secret"));
    return craft;
  }

  Bridge bridge_;
  wire::SpawnBody spawn_;
  WorldView world_;
  std::int64_t now_ns_ = kSecondNs;
};

TEST_F(CraftTest, WhatIsSaidEarlyWaitsForTheAnswer) {
  Craft craft(bridge_.Send(), spawn_, true);
  EXPECT_TRUE(absl::IsUnavailable(craft.status()));
  craft.Drive({0.5, -0.25});
  craft.Impulse({1, 2, 3});
  Advance(craft, 1.0);
  EXPECT_EQ(bridge_.count(), 1);
  EXPECT_FALSE(Answer(craft, 99, 7));  // another's
  ASSERT_TRUE(Answer(craft, 1, 7, 1, "secret"));
  EXPECT_TRUE(craft.status().ok());
  EXPECT_EQ(craft.id(), 7u);
  EXPECT_EQ(bridge_.Newest<wire::AddRegion>().region.follow_body_id, 7u);
  Advance(craft, 0.0);
  ASSERT_EQ(bridge_.count(), 4);
  EXPECT_EQ(std::get<wire::ApplyImpulse>(bridge_.at(3).command).impulse_n_s, (Vec3d{1, 2, 3}));
  EXPECT_EQ(bridge_.at(3).lease, "secret");
  const auto drive = bridge_.Newest<wire::DriveBody>();
  EXPECT_EQ(drive.body_id, 7u);
  EXPECT_EQ(drive.throttle, std::vector<double>{0.5});
  EXPECT_EQ(drive.rudder, std::vector<double>{-0.25});
}

TEST_F(CraftTest, ARefusedSpawnIsTheEnd) {
  Craft craft(bridge_.Send(), spawn_, true);
  EXPECT_TRUE(Refuse(craft, 1, absl::InvalidArgumentError("no such preset")));
  EXPECT_TRUE(absl::IsInvalidArgument(craft.status()));
  EXPECT_TRUE(craft.over());
  craft.Drive({1.0, 0.0});
  craft.Remove();
  Advance(craft, 1.0);
  EXPECT_EQ(bridge_.count(), 1);
}

// Orders 50 ms apart; unchanged ones, and none at all, keep the lease alive.
TEST_F(CraftTest, OrdersGoWhenTheyChangeAndTheLeaseIsKept) {
  Craft craft = Held();
  Advance(craft, 0.0);
  Advance(craft, 14.9);
  EXPECT_EQ(bridge_.count(), 1);
  Advance(craft, 0.2);
  EXPECT_EQ(bridge_.Newest<wire::TakeLease>().body_id, 7u);
  EXPECT_EQ(bridge_.at(2).lease, "secret");
  ASSERT_TRUE(Answer(craft, 2, 7, 1, "secret"));
  craft.Drive({0.1, 0.0});
  Advance(craft, 0.1);
  EXPECT_EQ(bridge_.count(), 3);
  craft.Drive({0.2, 0.0});
  Advance(craft, 0.02);
  craft.Drive({0.3, 0.0});
  Advance(craft, 0.02);
  EXPECT_EQ(bridge_.count(), 3);
  Advance(craft, 0.02);
  EXPECT_EQ(bridge_.count(), 4);
  EXPECT_EQ(bridge_.Newest<wire::DriveBody>().throttle, std::vector<double>{0.3});
  Advance(craft, 14.0);
  EXPECT_EQ(bridge_.count(), 4);
  Advance(craft, 1.1);
  EXPECT_EQ(bridge_.count(), 5);
}

TEST_F(CraftTest, AnOlderOrderThatActedLastIsSetRight) {
  Craft craft = Held();
  craft.Drive({0.1, 0.0});
  Advance(craft, 0.1);
  craft.Drive({0.9, 0.0});
  Advance(craft, 0.1);
  ASSERT_EQ(bridge_.count(), 3);
  Answer(craft, 3, 7, 10);
  Answer(craft, 2, 7, 11);
  Advance(craft, 0.1);
  ASSERT_EQ(bridge_.count(), 4);
  EXPECT_EQ(bridge_.Newest<wire::DriveBody>().throttle, std::vector<double>{0.9});
}

TEST_F(CraftTest, ALeaseThatRanOutIsAskedForAgain) {
  Craft craft = Held();
  craft.Drive({0.5, 0.0});
  Advance(craft, 0.1);
  Refuse(craft, 2, absl::PermissionDeniedError("it has run out"));
  EXPECT_EQ(bridge_.Newest<wire::TakeLease>().holder, "me");
  EXPECT_EQ(bridge_.at(3).lease, "");
  Advance(craft, 1.0);
  EXPECT_EQ(bridge_.count(), 3);  // nothing without it
  Answer(craft, 3, 7, 1, "another");
  EXPECT_TRUE(craft.status().ok());
  Advance(craft, 0.1);
  EXPECT_EQ(bridge_.Newest<wire::DriveBody>().body_id, 7u);
  EXPECT_EQ(bridge_.at(4).lease, "another");
  // Somebody else was faster.
  Refuse(craft, 4, absl::PermissionDeniedError("it has run out"));
  Refuse(craft, 5, absl::PermissionDeniedError("held by 'you'"));
  EXPECT_THAT(craft.status().message(), HasSubstr("you"));
  EXPECT_FALSE(craft.over());
}

TEST_F(CraftTest, RemovalTakesTheWakeAlong) {
  Craft craft = Held(true);
  ASSERT_TRUE(Answer(craft, 2, 40));
  craft.Remove();
  Advance(craft, 0.1);
  EXPECT_EQ(bridge_.Newest<wire::RemoveBody>().body_id, 7u);
  Answer(craft, 3, 7);
  EXPECT_EQ(bridge_.Newest<wire::RemoveRegion>().region_id, 40u);
  EXPECT_TRUE(absl::IsNotFound(craft.status()));
  EXPECT_FALSE(craft.over());
  Answer(craft, 4, 40);
  EXPECT_TRUE(craft.over());
}

// The region's answer comes when the body is gone already.
TEST_F(CraftTest, AWakeThatComesTooLateIsTakenAwayToo) {
  Craft craft = Held(true);
  craft.Remove();
  Advance(craft, 0.1);
  Answer(craft, 3, 7);
  EXPECT_EQ(bridge_.count(), 3);
  Answer(craft, 2, 40);
  EXPECT_EQ(bridge_.Newest<wire::RemoveRegion>().region_id, 40u);
}

TEST_F(CraftTest, LettingGoStopsTheMotorThenEndsTheLease) {
  Craft craft = Held();
  craft.Drive({0.5, 0.1});
  Advance(craft, 0.1);
  craft.LetGo();
  Advance(craft, 0.0);
  EXPECT_EQ(bridge_.Newest<wire::DriveBody>().throttle, std::vector<double>{0.0});
  Advance(craft, 0.1);
  EXPECT_EQ(bridge_.count(), 3);
  Answer(craft, 2, 7);
  Answer(craft, 3, 7);
  Advance(craft, 0.1);
  EXPECT_EQ(bridge_.Newest<wire::ReleaseLease>().body_id, 7u);
  EXPECT_EQ(bridge_.at(4).lease, "secret");
  Answer(craft, 4, 0);
  EXPECT_TRUE(craft.over());
}

TEST_F(CraftTest, ABodyThatTheServerNoLongerHasIsGone) {
  Craft craft = Held();
  craft.Drive({0.5, 0.0});
  Advance(craft, 0.1);
  Refuse(craft, 2, absl::NotFoundError("no body 7"));
  EXPECT_TRUE(absl::IsNotFound(craft.status()));
  EXPECT_TRUE(craft.over());
}

}  // namespace
}  // namespace onesea::client
