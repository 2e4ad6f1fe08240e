#include "client/app/skipper.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace onesea::client {
namespace {

using ::testing::HasSubstr;

constexpr std::int64_t kPatienceNs = 20'000'000'000;

// A server that answers everything, and remembers what it was told.
class SkipperTest : public testing::Test {
 protected:
  absl::StatusOr<CommandAnswer> Answer(const wire::CommandHeader& header,
                                       const wire::WorldCommand& command) {
    absl::MutexLock lock(&mutex_);
    if (std::holds_alternative<wire::DriveBody>(command)) lease_shown_ = header.lease;
    commands_.push_back(command);
    if (!refusal_.ok()) return refusal_;
    if (!orders_.ok() && std::holds_alternative<wire::DriveBody>(command)) return orders_;
    CommandAnswer answer;
    answer.tick = ++tick_;
    if (std::holds_alternative<wire::TakeLease>(command)) {
      answer.lease = "another";
      orders_ = absl::OkStatus();
    }
    if (std::holds_alternative<wire::SpawnBody>(command)) {
      answer.id = 7;
      answer.lease = "secret";
    }
    return answer;
  }
  template <typename Command>
  std::vector<Command> Told() {
    EXPECT_TRUE(sender_.AwaitAll(kPatienceNs));
    absl::MutexLock lock(&mutex_);
    std::vector<Command> told;
    for (const wire::WorldCommand& command : commands_) {
      if (const auto* one = std::get_if<Command>(&command)) told.push_back(*one);
    }
    return told;
  }
  // A picture; what was sent is answered before the next.
  void Look(const SkipperInput& keys) {
    moment_.now = moment_.now + SimTime::FromSeconds(0.1);
    moment_.now_ns += 100'000'000;
    moment_.seconds = 0.1;
    skipper_.Update(keys, {}, world_, moment_);
    EXPECT_TRUE(sender_.AwaitAll(kPatienceNs));
  }
  std::string line() const { return skipper_.report().line; }

  absl::Mutex mutex_;
  std::vector<wire::WorldCommand> commands_;
  absl::Status refusal_, orders_;
  std::string lease_shown_;
  Tick tick_ = 0;
  CommandSender sender_{
      "a", [this](const auto& header, const auto& command) { return Answer(header, command); }};
  WorldView world_;
  Skipper::Moment moment_;
  Skipper skipper_{&sender_};
};

TEST_F(SkipperTest, LaunchesAheadWithARegionAndDrives) {
  Look({.spawn = true});
  Look({.helm = {.ahead = true}});
  Look({.helm = {.ahead = true}});
  const auto spawned = Told<wire::SpawnBody>();
  ASSERT_EQ(spawned.size(), 1u);
  EXPECT_GT(spawned[0].start.position_m.x, 5.0);
  ASSERT_EQ(Told<wire::AddRegion>().size(), 1u);
  EXPECT_EQ(Told<wire::AddRegion>()[0].region.follow_body_id, 7u);
  const auto orders = Told<wire::DriveBody>();
  ASSERT_GE(orders.size(), 2u);
  EXPECT_GT(orders.back().throttle[0], orders.front().throttle[0]);
  EXPECT_TRUE(skipper_.report().aboard);
}

// Land ahead but for a basin to the left.
TEST_F(SkipperTest, LaunchesWhereThereIsWater) {
  sea::Terrain terrain;
  terrain.west_m = terrain.south_m = -100.0;
  terrain.columns = terrain.rows = 21;
  for (int row = 0; row < 21; ++row) {
    for (int column = 0; column < 21; ++column) {
      terrain.elevation_m.push_back(row >= 14 ? -5.0f : 3.0f);  // water from y = 40 on
    }
  }
  moment_.terrain = &terrain;
  Look({.spawn = true});
  ASSERT_EQ(Told<wire::SpawnBody>().size(), 1u);
  EXPECT_GT(Told<wire::SpawnBody>()[0].start.position_m.y, 35.0);
}

TEST_F(SkipperTest, SaysThatThereIsNoWater) {
  const sea::Terrain land{.cell_m = 10.0, .columns = 2, .rows = 2, .elevation_m = {3, 3, 3, 3}};
  moment_.terrain = &land;
  Look({.spawn = true});
  EXPECT_THAT(line(), HasSubstr("no free water"));
  Look({.crate = true});
  EXPECT_THAT(line(), HasSubstr("no water"));
  EXPECT_TRUE(Told<wire::SpawnBody>().empty());
}

TEST_F(SkipperTest, ARefusalIsALine) {
  refusal_ = absl::ResourceExhaustedError("bodies: 1024 are there");
  Look({.spawn = true});
  Look({});
  EXPECT_THAT(line(), HasSubstr("no boat: bodies: 1024"));
  EXPECT_FALSE(skipper_.report().aboard);
  refusal_ = absl::OkStatus();
  Look({.spawn = true});
  Look({});
  EXPECT_TRUE(skipper_.report().aboard);
}

TEST_F(SkipperTest, ABoatThatNeverAppearsIsGivenUp) {
  Look({.spawn = true});
  for (int n = 0; n < 60; ++n) Look({});
  EXPECT_FALSE(skipper_.report().aboard);
  EXPECT_THAT(line(), HasSubstr("no longer there"));
}

// The lease ran out while the link was lost.
TEST_F(SkipperTest, TakesALeaseAnew) {
  Look({.spawn = true});
  Look({});
  orders_ = absl::PermissionDeniedError("lease: it has run out");
  for (int n = 0; n < 4; ++n) Look({.helm = {.ahead = true}});
  EXPECT_EQ(Told<wire::TakeLease>().size(), 1u);
  EXPECT_GT(Told<wire::DriveBody>().back().throttle[0], 0.0);
  EXPECT_EQ(lease_shown_, "another");
}

// Somebody else holds the boat: it is told, and not asked again at every picture.
TEST_F(SkipperTest, ABoatThatAnotherHoldsIsToldOnce) {
  Look({.spawn = true});
  Look({});
  refusal_ = absl::PermissionDeniedError("body 7 is held by 'Anna'");
  for (int n = 0; n < 40; ++n) Look({});
  EXPECT_LE(Told<wire::DriveBody>().size(), 2u);
  Look({.helm = {.ahead = true}});
  Look({});
  Look({});
  EXPECT_THAT(line(), HasSubstr("held by 'Anna'"));
}

TEST_F(SkipperTest, WithoutABoatDeleteExplains) {
  Look({.remove = true});
  EXPECT_THAT(line(), HasSubstr("B launches"));
  EXPECT_TRUE(Told<wire::RemoveBody>().empty());
}

TEST(Skipper, WithoutAServerEveryWishExplains) {
  Skipper skipper(nullptr);
  skipper.Update({.spawn = true}, {}, WorldView(), {});
  EXPECT_THAT(skipper.report().line, HasSubstr("join a server"));
}

// Orders overtake each other: an older one that acted last is made good.
TEST(Skipper, AnOvertakenOrderIsRepeated) {
  absl::Mutex mutex;
  std::vector<double> throttles;
  bool hold_second = true;
  Tick tick = 10;
  CommandSender sender(
      "a", [&](const auto&, const wire::WorldCommand& command) -> absl::StatusOr<CommandAnswer> {
        absl::MutexLock lock(&mutex);
        CommandAnswer answer;
        answer.id = 7;
        if (const auto* drive = std::get_if<wire::DriveBody>(&command)) {
          throttles.push_back(drive->throttle[0]);
          if (throttles.size() == 2) {
            const auto let_go = [&] { return !hold_second; };
            mutex.Await(absl::Condition(&let_go));
          }
        }
        answer.tick = ++tick;
        return answer;
      });
  Skipper skipper(&sender);
  const WorldView world;
  Skipper::Moment moment;
  const auto look = [&](const SkipperInput& keys) {
    moment.now = moment.now + SimTime::FromSeconds(0.1);
    moment.now_ns += 100'000'000;
    moment.seconds = 0.1;
    skipper.Update(keys, {}, world, moment);
  };
  const auto told = [&] {
    absl::MutexLock lock(&mutex);
    return throttles.size();
  };
  const auto await = [&](std::size_t count) {
    for (int n = 0; n < 20'000 && told() < count; ++n) absl::SleepFor(absl::Milliseconds(1));
    return told() >= count;
  };
  look({.spawn = true});
  ASSERT_TRUE(sender.AwaitAll(kPatienceNs));
  look({});  // order 1: at rest
  ASSERT_TRUE(await(1));
  look({.helm = {.ahead = true}});  // order 2, which is held
  ASSERT_TRUE(await(2));
  look({.helm = {.astern = true}});  // order 3: back in neutral
  ASSERT_TRUE(await(3));
  {
    absl::MutexLock lock(&mutex);
    hold_second = false;
  }
  ASSERT_TRUE(sender.AwaitAll(kPatienceNs));
  look({.helm = {.astern = true}});  // nothing new to say, but order 2 acted after 3
  ASSERT_TRUE(await(4));
  EXPECT_EQ(throttles.back(), skipper.report().throttle);
}

}  // namespace
}  // namespace onesea::client
