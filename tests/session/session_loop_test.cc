// The thread and the registry, in real time: nothing here depends on how fast the machine is.
#include "server/session/session_loop.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <future>

#include "absl/strings/str_cat.h"
#include "common/base/limits.h"
#include "server/session/registry.h"
#include "tests/shared/small_sea.h"

namespace onesea::server {
namespace {

using ::testing::HasSubstr;

absl::StatusOr<StepResult> StepAndWait(SessionLoop& session, const StepRequest& request) {
  auto promise = std::make_shared<std::promise<absl::StatusOr<StepResult>>>();
  auto future = promise->get_future();
  session.Step(request, [promise](const absl::StatusOr<StepResult>& r) { promise->set_value(r); });
  return future.get();
}

SessionSpec LockStepSession(int participants, double deadline_s) {
  SessionSpec spec = SmallSession("lock");
  spec.pace = Pace::kLockStep;
  spec.lock_step_participants = participants;
  spec.lock_step_deadline_s = deadline_s;
  return spec;
}

TEST(SessionLoop, TicksInRealTime) {
  Registry registry;
  const auto session = *registry.Create(SmallSession());
  while (session->View().tick < 30) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ASSERT_TRUE(session->Hold().ok());
  const Tick held = session->View().tick;
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  EXPECT_EQ(session->Hashes().tick, held);
  EXPECT_EQ(session->Info().pace, Pace::kHeld);
  ASSERT_TRUE(session->Resume().ok());
  while (session->View().tick == held) std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

TEST(SessionLoop, LockStepParticipantsMeet) {
  Registry registry;
  const auto session = *registry.Create(LockStepSession(2, 60.0));
  for (int round = 1; round <= 20; ++round) {
    auto other = std::async(std::launch::async, [&] {
      return StepAndWait(*session, {3, "other"});
    });
    const absl::StatusOr<StepResult> mine = StepAndWait(*session, {3, "me"});
    const absl::StatusOr<StepResult> theirs = other.get();
    ASSERT_TRUE(mine.ok() && theirs.ok());
    EXPECT_EQ(mine->tick, 3 * round);
    EXPECT_EQ(theirs->state_hash, mine->state_hash);
  }
}

TEST(SessionLoop, LockStepDeadlinePasses) {
  Registry registry;
  const auto session = *registry.Create(LockStepSession(2, 0.05));
  EXPECT_EQ(StepAndWait(*session, {1, "me"}).status().code(), absl::StatusCode::kDeadlineExceeded);
}

TEST(SessionLoop, WeatherBeginsAtTheNextTickOfASessionThatStands) {
  Registry registry;
  const auto session = *registry.Create(LockStepSession(1, 10.0));
  ASSERT_TRUE(StepAndWait(*session, {5, ""}).ok());
  const std::uint64_t before = session->Hashes().component_hash;
  const absl::StatusOr<WeatherSpan> span =
      session->ChangeWeather({.sea = SmallSea(3.0), .span_ticks = 60, .start_tick = {}});
  ASSERT_TRUE(span.ok()) << span.status();
  EXPECT_EQ(span->start_tick, 6);
  EXPECT_EQ(span->end_tick, 66);
  EXPECT_NE(session->Hashes().component_hash, before);
  EXPECT_NEAR(session->Info().hs_m, 1.0, 0.2);
  ASSERT_TRUE(StepAndWait(*session, {61, ""}).ok());
  EXPECT_NEAR(session->Info().hs_m, 3.0, 0.6);  // what of it the small sea's band holds
}

TEST(SessionLoop, WeatherComesInTimeWhileItRuns) {
  Registry registry;
  const auto session = *registry.Create(SmallSession());
  const absl::StatusOr<WeatherSpan> span =
      session->ChangeWeather({.sea = SmallSea(3.0), .span_ticks = 60, .start_tick = {}});
  ASSERT_TRUE(span.ok()) << span.status();
  EXPECT_GT(span->start_tick, 0);
  EXPECT_EQ(session->ChangeWeather({.sea = SmallSea(), .span_ticks = 0, .start_tick = Tick{0}})
                .status()
                .code(),
            absl::StatusCode::kInvalidArgument);
  const absl::Status never =
      session
          ->ChangeWeather(
              {.sea = SmallSea(), .span_ticks = 0, .start_tick = Tick{1'000'000'000'000}})
          .status();
  EXPECT_EQ(never.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_NE(never.message().find("century"), absl::string_view::npos) << never;
  EXPECT_EQ(session->ChangeWeather({.sea = SmallSea(), .span_ticks = -1, .start_tick = {}})
                .status()
                .code(),
            absl::StatusCode::kInvalidArgument);
}

TEST(SessionLoop, AClosedSessionAnswersNotFound) {
  Registry registry;
  const auto session = *registry.Create(SmallSession());
  ASSERT_TRUE(registry.Delete("small", "test").ok());
  EXPECT_EQ(session->Hold().status().code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(session->SetSpeed(1.0).code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(StepAndWait(*session, {1, ""}).status().code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(session->ChangeWeather({.sea = SmallSea(), .span_ticks = 0, .start_tick = {}})
                .status()
                .code(),
            absl::StatusCode::kNotFound);
}

TEST(SessionLoop, CountsViewersUpToTheLimit) {
  Registry registry;
  const auto session = *registry.Create(SmallSession());
  for (int n = 0; n < kViewersPerSessionMax; ++n) ASSERT_TRUE(session->TryAddViewer());
  EXPECT_FALSE(session->TryAddViewer());
  EXPECT_EQ(session->Info().viewer_count, kViewersPerSessionMax);
  session->RemoveViewer();
  EXPECT_TRUE(session->TryAddViewer());
}

TEST(Registry, NamesAreUniqueAndComeFreeAgain) {
  Registry registry;
  ASSERT_TRUE(registry.Create(SmallSession("a")).ok());
  EXPECT_EQ(registry.Create(SmallSession("a")).status().code(), absl::StatusCode::kAlreadyExists);
  ASSERT_TRUE(registry.Create(SmallSession("b")).ok());
  EXPECT_EQ(registry.List().size(), 2u);
  EXPECT_EQ(registry.List()[0]->name(), "a");
  ASSERT_TRUE(registry.Delete("a", "test").ok());
  EXPECT_EQ(registry.Delete("a", "test").code(), absl::StatusCode::kNotFound);
  const absl::StatusOr<std::shared_ptr<SessionLoop>> again = registry.Create(SmallSession("a"));
  ASSERT_TRUE(again.ok());
  EXPECT_LT((*again)->View().tick, 60);
}

TEST(Registry, UnknownNamesAreAnsweredWithTheKnown) {
  Registry registry;
  ASSERT_TRUE(registry.Create(SmallSession("a")).ok());
  const absl::Status status = registry.Find("x").status();
  EXPECT_EQ(status.code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(std::string(status.message()), HasSubstr("'x' is not here; there are: a"));
}

TEST(Registry, AnUnknownNameIsQuotedSoThatATerminalMayShowIt) {
  const Registry registry;
  std::string name(63, 'x');
  name += "\u00e4";  // its two bytes are the 64th and 65th
  EXPECT_EQ(registry.Find(name).status().message(),
            "session: '" + std::string(63, 'x') + "' is not here; there are: ");
  EXPECT_EQ(registry.Find("a\x1b[2J").status().message(),
            "session: 'a?[2J' is not here; there are: ");
}

TEST(Registry, ABadSpecLeavesNoName) {
  Registry registry;
  SessionSpec spec = SmallSession("a");
  spec.speed = 1000.0;
  EXPECT_EQ(registry.Create(spec).status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_TRUE(registry.Create(SmallSession("a")).ok());
}

TEST(Registry, HasALimit) {
  Registry registry;
  SessionSpec spec = SmallSession();
  spec.pace = Pace::kHeld;
  for (int n = 0; n < kSessionsMax; ++n) {
    spec.name = absl::StrCat("s", n);
    ASSERT_TRUE(registry.Create(spec).ok());
  }
  spec.name = "more";
  EXPECT_EQ(registry.Create(spec).status().code(), absl::StatusCode::kResourceExhausted);
}

}  // namespace
}  // namespace onesea::server
