#include "server/session/session_runner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>

#include "tests/shared/fake_clock.h"
#include "tests/shared/small_sea.h"

namespace onesea::server {
namespace {

using ::testing::HasSubstr;

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kMs = 1'000'000;

class Recorder final : public SessionObserver {
 public:
  void OnWelcomeChanged(std::shared_ptr<const wire::Welcome> welcome) override {
    welcomes.push_back(*welcome);
    log += 'W';
  }
  void OnTick(const TickEvent& event) override {
    events.push_back(event);
    if (event.probes != nullptr) probes.push_back(*event.probes);
    log += event.stamp_instant ? 'S' : 't';
  }
  void OnClosed(std::string_view reason) override { closed = std::string(reason); }

  int Stamps() const {
    int count = 0;
    for (const TickEvent& event : events) count += event.stamp_instant ? 1 : 0;
    return count;
  }

  std::vector<wire::Welcome> welcomes;
  std::vector<TickEvent> events;
  std::vector<wire::ProbeHeights> probes;
  std::string log, closed;
};

class Fixture : public ::testing::Test {
 protected:
  void Make(const SessionSpec& spec) {
    runner = std::make_unique<SessionRunner>(spec, BuildOrDie(spec.recipe),
                                             sea::TransformKind::kOwn, clock.MonotonicNs());
    recorder = std::make_shared<Recorder>();
    runner->AddObserver(recorder);
  }
  // Lets `span_ns` pass; every wake-up comes when it was asked for.
  void Pass(std::int64_t span_ns) {
    const std::int64_t end_ns = clock.MonotonicNs() + span_ns;
    while (true) {
      const std::int64_t wake_ns = runner->Advance(clock.MonotonicNs(), deferred);
      Settle();
      if (wake_ns > end_ns) break;
      clock.SleepUntil(wake_ns);
    }
    clock.SleepUntil(end_ns);
  }
  void Settle() {
    for (const auto& call : deferred) call();
    deferred.clear();
  }
  std::shared_ptr<const sea::Components> WithWeather(Tick start_tick, std::int64_t span_ticks) {
    sea::Recipe recipe = runner->session().components()->recipe;
    ONESEA_CHECK(sea::AppendWeather(recipe, {start_tick, span_ticks, SmallSea(2.0)}).ok());
    return BuildOrDie(recipe);
  }
  Tick tick() const { return runner->session().tick(); }

  FakeClock clock;
  std::unique_ptr<SessionRunner> runner;
  std::shared_ptr<Recorder> recorder;
  SessionRunner::Deferred deferred;
};

TEST_F(Fixture, KeepsPaceWithRealTime) {
  Make(SmallSession());
  Pass(10 * kSecond);
  EXPECT_EQ(tick(), 600);
  // Every tick once, in order, stamped with when it was due: 1/60 s apart to the rounding.
  Tick expected = 0;
  std::int64_t stream_instants = 0;
  for (const TickEvent& event : recorder->events) {
    if (event.stamp.tick == expected) continue;  // a stamp between ticks
    ++expected;
    ASSERT_EQ(event.stamp.tick, expected);
    stream_instants += event.stream_instant ? 1 : 0;
    EXPECT_NEAR(static_cast<double>(event.stamp.server_monotonic_ns - 5 * kSecond),
                static_cast<double>(expected) * 1e9 / 60.0, 1.0);
  }
  EXPECT_EQ(stream_instants, 300);  // 30 Hz
}

TEST_F(Fixture, StampsOnceASecond) {
  Make(SmallSession());
  Pass(10 * kSecond);
  EXPECT_GE(recorder->Stamps(), 10);
  EXPECT_LE(recorder->Stamps(), 12);
  EXPECT_GE(recorder->probes.size(), 10u);
}

TEST_F(Fixture, WorksOffASmallDelayWithoutSkipping) {
  Make(SmallSession());
  Pass(kSecond);
  clock.Advance(80 * kMs);  // the thread overslept
  Pass(kSecond);
  EXPECT_EQ(tick(), 124);  // floor(2.08 s · 60 Hz)
}

TEST_F(Fixture, SlowsDownWhenItCannotKeepUp) {
  Make(SmallSession());
  // Each wake-up comes 200 ms after the last: more than the debt that is worked off (100 ms). So
  // about half the time is lost, and it stays lost.
  for (int n = 0; n < 50; ++n) {
    clock.Advance(200 * kMs);
    runner->Advance(clock.MonotonicNs(), deferred);
  }
  EXPECT_NEAR(static_cast<double>(tick()), 330.0, 30.0);  // 6 or 7 of 12 at each
  EXPECT_LT(runner->Info().actual_speed, 0.7);
  EXPECT_LT(recorder->events.back().stamp.speed, 0.7);
  // No ticks were skipped, and none come in a burst afterwards.
  for (std::size_t n = 1; n < recorder->events.size(); ++n) {
    EXPECT_LE(recorder->events[n].stamp.tick - recorder->events[n - 1].stamp.tick, 1);
  }
  const Tick before = tick();
  Pass(10 * kSecond);
  EXPECT_NEAR(static_cast<double>(tick() - before), 600.0, 7.0);
  EXPECT_NEAR(runner->Info().actual_speed, 1.0, 0.05);
  EXPECT_EQ(recorder->events.back().stamp.speed, 1.0);
}

TEST_F(Fixture, FollowsTheSpeed) {
  Make(SmallSession());
  ASSERT_TRUE(runner->SetSpeed(10.0, clock.MonotonicNs()).ok());
  Pass(2 * kSecond);
  EXPECT_NEAR(static_cast<double>(tick()), 1200.0, 1.0);
  ASSERT_TRUE(runner->SetSpeed(0.1, clock.MonotonicNs()).ok());
  Pass(10 * kSecond);
  EXPECT_NEAR(static_cast<double>(tick()), 1260.0, 1.0);
  EXPECT_GE(recorder->Stamps(), 12);
  for (double bad : {0.0, -1.0, 101.0, std::nan("")}) {
    EXPECT_EQ(runner->SetSpeed(bad, clock.MonotonicNs()).code(),
              absl::StatusCode::kInvalidArgument);
  }
}

// What a viewer that follows this stamp shows at `now_ns`.
double ShownS(const wire::Stamp& stamp, std::int64_t now_ns) {
  return static_cast<double>(stamp.tick) / 60.0 +
         1e-9 * static_cast<double>(now_ns - stamp.server_monotonic_ns) * stamp.speed;
}

TEST_F(Fixture, AChangeOfSpeedWithOverdueTicksShowsNoJump) {
  SessionSpec spec = SmallSession();
  spec.speed = 100.0;
  Make(spec);
  Pass(kSecond);
  clock.Advance(80 * kMs);  // 480 ticks
  const std::int64_t change_ns = clock.MonotonicNs();
  const double at_change_s = ShownS(recorder->events.back().stamp, change_ns);
  EXPECT_GT(at_change_s, static_cast<double>(tick()) / 60.0 + 7.9);
  ASSERT_TRUE(runner->SetSpeed(0.01, change_ns).ok());
  const std::size_t first = recorder->events.size() - 1;
  Pass(20 * kSecond);
  for (std::size_t n = first; n < recorder->events.size(); ++n) {
    const double shown_s = ShownS(recorder->events[n].stamp, clock.MonotonicNs());
    ASSERT_NEAR(shown_s, at_change_s + 0.2, 1e-6) << n;
  }
  EXPECT_NEAR(static_cast<double>(tick()), 60.0 * (at_change_s + 0.2), 1.0);
}

TEST_F(Fixture, HoldsAndResumes) {
  Make(SmallSession());
  Pass(kSecond);
  ASSERT_TRUE(runner->Hold(clock.MonotonicNs()).ok());
  EXPECT_EQ(recorder->events.back().stamp.speed, 0.0);
  EXPECT_EQ(recorder->events.back().stamp.pace, Pace::kHeld);
  const int stamps = recorder->Stamps();
  Pass(5 * kSecond);
  EXPECT_EQ(tick(), 60);
  EXPECT_GE(recorder->Stamps() - stamps, 4);  // the heart goes on beating
  ASSERT_TRUE(runner->Resume(clock.MonotonicNs(), deferred).ok());
  Pass(kSecond);
  EXPECT_EQ(tick(), 120);  // the time it stood is not caught up
}

TEST_F(Fixture, WelcomeComesFirstAndAgainWithNewWeather) {
  Make(SmallSession());
  EXPECT_EQ(recorder->log, "W");
  Pass(kSecond);
  EXPECT_EQ(recorder->log.substr(0, 2), "WS");
  const auto components = WithWeather(100, 60);
  recorder->log.clear();
  ASSERT_TRUE(runner->ChangeWeather(components, clock.MonotonicNs()).ok());
  EXPECT_EQ(recorder->log, "WS");
  EXPECT_EQ(recorder->welcomes.back().component_hash, components->hash);
  EXPECT_EQ(recorder->welcomes.back().recipe, components->recipe);
  EXPECT_NE(recorder->welcomes[0].component_hash, components->hash);
}

TEST_F(Fixture, RefusesWeatherThatBeginsInThePast) {
  Make(SmallSession());
  const auto components = WithWeather(30, 60);
  Pass(kSecond);
  EXPECT_EQ(runner->ChangeWeather(components, clock.MonotonicNs()).code(),
            absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(runner->session().components()->recipe.timeline.size(), 1u);
}

// Brute force: the undisplaced point whose displaced position is the probe, found by fixed-point
// iteration on direct sums in double.
TEST_F(Fixture, ProbeHeightsAreThoseOfTheDirectSum) {
  Make(SmallSession());
  Pass(2 * kSecond + 50 * kMs);
  const sea::Components& components = *runner->session().components();
  const wire::ProbeHeights& heights = recorder->probes.back();
  ASSERT_EQ(heights.height_m.size(), 3u);
  // Bilinear interpolation between points 3.1 m apart; a tick too early or late would show as 10 mm
  // and more.
  constexpr double kToleranceM = 0.008;
  for (std::size_t n = 0; n < 3; ++n) {
    const Vec2d probe = runner->session().spec().probes_m[n];
    Vec2d source = probe;
    sea::DirectSample sample;
    for (int iteration = 0; iteration < 60; ++iteration) {
      sample = sea::SumDirectly(components, TimeOfTick(heights.tick, 60), source);
      source = {probe.x - sample.displacement_x_m, probe.y - sample.displacement_y_m};
    }
    EXPECT_NEAR(static_cast<double>(heights.height_m[n]), sample.height_m, kToleranceM);
  }
}

// One is woken for every tick, the other for every third; where both stood, both hold the same
// state.
TEST_F(Fixture, StateDependsOnTicksAndCommandsOnly) {
  const auto run = [&](std::int64_t wake_ns) {
    Make(SmallSession());
    std::map<Tick, std::uint64_t> hashes;
    bool changed = false;
    while (tick() < 240) {
      clock.Advance(wake_ns);
      runner->Advance(clock.MonotonicNs(), deferred);
      if (tick() >= 100 && !std::exchange(changed, true)) {
        EXPECT_TRUE(runner->ChangeWeather(WithWeather(200, 60), clock.MonotonicNs()).ok());
      }
      if (tick() < 100 || tick() > 105) hashes[tick()] = runner->session().StateHash();
    }
    return hashes;
  };
  const std::map<Tick, std::uint64_t> often = run(10 * kMs);
  int common = 0;
  for (const auto& [at, hash] : run(50 * kMs)) {
    if (!often.contains(at)) continue;
    ++common;
    EXPECT_EQ(often.at(at), hash) << at;
  }
  EXPECT_GT(common, 30);
  EXPECT_NE(often.at(99), often.at(98));
}

class LockStep : public Fixture {
 protected:
  void MakeLockStep(int participants, double deadline_s) {
    SessionSpec spec = SmallSession();
    spec.pace = Pace::kLockStep;
    spec.lock_step_participants = participants;
    spec.lock_step_deadline_s = deadline_s;
    Make(spec);
  }
  std::uint64_t Ask(std::int64_t ticks, const std::string& who) {
    return runner->Step(
        {ticks, who},
        [this, who](const absl::StatusOr<StepResult>& result) {
          results.emplace_back(who, result);
        },
        clock.MonotonicNs(), deferred);
  }
  std::vector<std::pair<std::string, absl::StatusOr<StepResult>>> results;
};

TEST_F(LockStep, StandsStillUntilAsked) {
  MakeLockStep(1, 10.0);
  Pass(5 * kSecond);
  EXPECT_EQ(tick(), 0);
  Ask(7, "");
  Pass(kMs);
  EXPECT_EQ(tick(), 7);
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].second->tick, 7);
  EXPECT_EQ(results[0].second->state_hash, runner->session().StateHash());
  EXPECT_TRUE(recorder->events.back().stamp_instant);
}

TEST_F(LockStep, MakesLongStepsInPortions) {
  MakeLockStep(1, 10.0);
  Ask(36'000, "");
  EXPECT_EQ(runner->Advance(clock.MonotonicNs(), deferred), clock.MonotonicNs());
  EXPECT_LT(tick(), 36'000);
  Pass(kMs);
  EXPECT_EQ(tick(), 36'000);
  EXPECT_EQ(results.size(), 1u);
}

TEST_F(LockStep, BarrierWaitsForAll) {
  MakeLockStep(3, 10.0);
  Ask(2, "a");
  Ask(2, "b");
  Pass(kSecond);
  EXPECT_EQ(tick(), 0);
  Ask(2, "c");
  Pass(kMs);
  EXPECT_EQ(tick(), 2);
  EXPECT_EQ(results.size(), 3u);
  for (const auto& [who, result] : results) EXPECT_EQ(result->tick, 2) << who;
}

TEST_F(LockStep, DeadlineStepsNothing) {
  MakeLockStep(2, 0.5);
  Ask(2, "a");
  Pass(499 * kMs);
  EXPECT_TRUE(results.empty());
  Pass(2 * kMs);
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].second.status().code(), absl::StatusCode::kDeadlineExceeded);
  EXPECT_THAT(std::string(results[0].second.status().message()),
              HasSubstr("only 1 of 2 participants came in time"));
  EXPECT_EQ(tick(), 0);
  Ask(2, "a");
  Ask(2, "b");
  Pass(kMs);
  EXPECT_EQ(tick(), 2);
}

TEST_F(LockStep, OneWhoGoesAwayLeavesTheBarrier) {
  MakeLockStep(2, 10.0);
  const std::uint64_t ticket = Ask(2, "a");
  runner->CancelStep(ticket, deferred);
  Settle();
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].second.status().code(), absl::StatusCode::kCancelled);
  Ask(2, "b");
  Pass(kMs);
  EXPECT_EQ(tick(), 0);
}

TEST_F(LockStep, RefusesHoldResumeAndSpeed) {
  MakeLockStep(1, 10.0);
  EXPECT_EQ(runner->Hold(0).code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(runner->Resume(0, deferred).code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(runner->SetSpeed(2.0, 0).code(), absl::StatusCode::kFailedPrecondition);
}

TEST_F(LockStep, AHeldSessionStepsTooAndARunningOneDoesNot) {
  Make(SmallSession());
  EXPECT_EQ(Ask(1, ""), 0u);
  Settle();
  EXPECT_EQ(results.back().second.status().code(), absl::StatusCode::kFailedPrecondition);
  ASSERT_TRUE(runner->Hold(clock.MonotonicNs()).ok());
  Ask(3, "");
  Ask(4, "");
  Pass(kMs);
  EXPECT_EQ(tick(), 7);
  EXPECT_EQ(results.back().second->tick, 7);
}

TEST_F(LockStep, ClosingAnswersThoseWhoWait) {
  MakeLockStep(2, 10.0);
  Ask(2, "a");
  runner->Close("enough", deferred);
  Settle();
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].second.status().code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(recorder->closed, "enough");
}

}  // namespace
}  // namespace onesea::server
