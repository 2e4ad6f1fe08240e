// Everybody at once on one session: who steers it, who watches it, who asks it. The thread
// sanitizer's preset runs this; everywhere else it still finds lost answers and broken orders.
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <thread>
#include <vector>

#include "common/wire/frame.h"
#include "server/query/query_engine.h"
#include "server/stream/hub.h"
#include "tests/shared/small_sea.h"

namespace onesea::server {
namespace {

constexpr int kRounds = 60;

// Reads what is newest until the session ends; sequences never fall, every keyframe is whole.
void Watch(Hub& hub, Audience audience) {
  const absl::StatusOr<Seat> seat = hub.TakeSeat("small", audience);
  ASSERT_TRUE(seat.ok()) << seat.status();
  std::int64_t last = -1;
  for (bool closed = false; !closed; std::this_thread::yield()) {
    const Broadcast::Newest newest = seat->broadcast()->newest(audience, true);
    closed = newest.closed;
    ASSERT_GE(newest.sequence, last);
    if (newest.sequence == last || newest.keyframe == nullptr) continue;
    last = newest.sequence;
    const absl::StatusOr<wire::Frame> frame = wire::DecodeFrame(newest.keyframe->bytes);
    ASSERT_TRUE(frame.ok()) << frame.status();
    ASSERT_TRUE(frame->welcome.has_value());
    ASSERT_EQ(frame->sequence, newest.sequence);
  }
}

void Steer(SessionLoop& session) {
  for (int round = 0; round < kRounds; ++round) {
    session.SetSpeed(1.0 + round).IgnoreError();
    ASSERT_TRUE(session.Hold().ok());
    ASSERT_TRUE(session.Resume().ok());
    if (round % 10 != 0) continue;
    const absl::StatusOr<WeatherSpan> span =
        session.ChangeWeather({.sea = SmallSea(2.0), .span_ticks = 5, .start_tick = {}});
    // Two of these threads may turn the weather; the later start wins.
    ASSERT_TRUE(span.ok() || span.status().code() == absl::StatusCode::kInvalidArgument)
        << span.status();
  }
}

// Every step is answered exactly once, whatever the answer.
void StepAndCancel(SessionLoop& session, std::atomic<int>& answers) {
  for (int round = 0; round < kRounds; ++round) {
    const std::uint64_t ticket = session.Step(
        {2, ""}, [&answers](const absl::StatusOr<StepResult>&) { answers.fetch_add(1); });
    if (round % 2 == 0) session.CancelStep(ticket);
  }
}

void Ask(SessionLoop& session, QueryEngine& engine) {
  wire::QueryRequest request;
  request.points_m = {{0.0, 0.0}, {12.5, -3.0}};
  request.detail = sea::QueryDetail::kVelocity;
  for (int round = 0; round < kRounds; ++round) {
    const SessionView view = session.View();
    const absl::StatusOr<wire::QueryAnswer> answer =
        engine.Answer(view.components, view.tick, request);
    ASSERT_TRUE(answer.ok()) << answer.status();
    ASSERT_EQ(answer->height_m.size(), 2u);
    ASSERT_LE(session.Info().hs_m, 3.0);
    ASSERT_GE(session.Hashes().tick, view.tick);
  }
}

TEST(CrowdedSession, EverybodyAtOnce) {
  Registry registry;
  Hub hub(registry);
  std::atomic<int> wakes{0};
  hub.SetWake([&wakes] { wakes.fetch_add(1); });
  const auto session = *registry.Create(SmallSession());
  QueryEngine engine;
  std::atomic<int> answers{0};
  std::vector<std::thread> watchers, workers;
  for (const Audience audience : {Audience::kEveryFrame, Audience::kStamps}) {
    watchers.emplace_back([&hub, audience] { Watch(hub, audience); });
  }
  workers.emplace_back([&] { Steer(*session); });
  workers.emplace_back([&] { Steer(*session); });
  workers.emplace_back([&] { StepAndCancel(*session, answers); });
  workers.emplace_back([&] { Ask(*session, engine); });
  workers.emplace_back([&] { Ask(*session, engine); });
  workers.emplace_back([&] {
    for (int round = 0; round < kRounds; ++round) {
      hub.Sweep(SystemClock().MonotonicNs());
      EXPECT_TRUE(hub.TakeSeat("small", Audience::kEveryFrame).ok());
    }
  });
  for (std::thread& worker : workers) worker.join();
  ASSERT_TRUE(registry.Delete("small", "the test is over").ok());
  for (std::thread& watcher : watchers) watcher.join();
  EXPECT_EQ(answers.load(), kRounds);
  EXPECT_GT(wakes.load(), 0);
  hub.Sweep(SystemClock().MonotonicNs());
}

}  // namespace
}  // namespace onesea::server
