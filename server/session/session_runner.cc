#include "server/session/session_runner.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/wire/bounds.h"

namespace onesea::server {
namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;
// A stamp that is owed rides on the next tick if that comes this soon.
constexpr std::int64_t kStampPatienceNs = 50'000'000;

void Defer(std::vector<LockStepBarrier::Waiting> waiting, const absl::StatusOr<StepResult>& result,
           SessionRunner::Deferred& deferred) {
  for (LockStepBarrier::Waiting& one : waiting) {
    deferred.push_back([done = std::move(one.done), result] { done(result); });
  }
}

absl::Status LateStatus(const std::vector<LockStepBarrier::Waiting>& came, int participants) {
  const auto name = [](std::string* out, const LockStepBarrier::Waiting& w) {
    out->append(w.request.participant);
  };
  return absl::DeadlineExceededError(
      absl::StrCat("only ", came.size(), " of ", participants,
                   " participants came in time, nothing was stepped; here were: ",
                   absl::StrJoin(came, ", ", name)));
}

}  // namespace

SessionRunner::SessionRunner(SessionSpec spec, std::shared_ptr<const sea::Components> components,
                             sea::TransformKind transform, std::int64_t now_ns,
                             std::unique_ptr<world::World> world)
    : session_(std::move(spec), std::move(components), std::move(world)),
      transform_(transform),
      pace_(session_.spec().pace),
      pacer_(session_.spec().recipe.tick_rate_hz, session_.spec().speed),
      barrier_(pace_ == Pace::kLockStep ? session_.spec().lock_step_participants : 1,
               std::llround(session_.spec().lock_step_deadline_s * 1e9)),
      next_second_ns_(now_ns + kNsPerSecond),
      probe_samples_(session_.spec().probes_m.size()) {
  pacer_.Anchor(session_.tick(), now_ns);
  probes_.height_m.resize(probe_samples_.size());
}

std::int64_t SessionRunner::Advance(std::int64_t now_ns, Deferred& deferred) {
  if (now_ns >= next_second_ns_) StartSecond(now_ns);
  if (pace_ == Pace::kRealTime) {
    AdvanceRealTime(now_ns);
  } else {
    AdvanceSteps(now_ns, deferred);
  }
  if (stamp_owed_) TellLate(now_ns);
  HandOver(deferred);
  if (!opened_.empty()) return now_ns;
  std::int64_t wake_ns = next_second_ns_;
  if (pace_ == Pace::kRealTime) wake_ns = std::min(wake_ns, pacer_.DueNs(session_.tick() + 1));
  if (!barrier_.empty()) wake_ns = std::min(wake_ns, barrier_.deadline_ns());
  return wake_ns;
}

void SessionRunner::AdvanceRealTime(std::int64_t now_ns) {
  if (pacer_.ForgiveDebt(session_.tick() + 1, now_ns)) stamp_owed_ = true;
  for (int n = 0; n < TicksPerAdvance(); ++n) {
    const std::int64_t due_ns = pacer_.DueNs(session_.tick() + 1);
    if (due_ns > now_ns) return;
    MakeTick(now_ns);
    Tell(due_ns, IsStreamInstant());
  }
}

void SessionRunner::AdvanceSteps(std::int64_t now_ns, Deferred& deferred) {
  for (int n = 0; n < TicksPerAdvance() && !opened_.empty(); ++n) {
    Opened& first = opened_.front();
    MakeTick(now_ns);
    if (--first.ticks_left == 0) stamp_owed_ = true;
    Tell(now_ns, IsStreamInstant());
    if (first.ticks_left > 0) continue;
    Defer(std::move(first.waiting), StepResult{session_.tick(), session_.StateHash()}, deferred);
    opened_.pop_front();
  }
  std::vector<LockStepBarrier::Waiting> late = barrier_.TakeExpired(now_ns);
  if (late.empty()) return;
  const absl::Status status = LateStatus(late, barrier_.participants());
  Defer(std::move(late), status, deferred);
}

// Once a second: how fast did we go, and a stamp with probe heights for everybody.
void SessionRunner::StartSecond(std::int64_t now_ns) {
  next_second_ns_ = std::max(next_second_ns_ + kNsPerSecond, now_ns + kNsPerSecond / 2);
  stamp_owed_ = true;
  probes_owed_ = true;
  if (pace_ != Pace::kRealTime) return;
  pacer_.Measure(session_.tick(), now_ns);
  if (pacer_.keeps_up() != told_slow_) return;
  told_slow_ = !told_slow_;
  if (told_slow_) {
    spdlog::warn("session {}: can't keep up, runs at {:.2f} instead of {:.2f}",
                 session_.spec().name, pacer_.actual_speed(), pacer_.speed());
  } else {
    spdlog::info("session {}: keeps up again at {:.2f}", session_.spec().name, pacer_.speed());
  }
}

// No tick took the owed stamp along, and none will soon.
void SessionRunner::TellLate(std::int64_t now_ns) {
  const bool tick_is_near =
      pace_ == Pace::kRealTime && pacer_.DueNs(session_.tick() + 1) < now_ns + kStampPatienceNs;
  if (!tick_is_near && opened_.empty()) Tell(LastDueNs(now_ns), false);
}

void SessionRunner::TellChange(std::int64_t now_ns) {
  stamp_owed_ = true;
  Tell(LastDueNs(now_ns), false);
}

void SessionRunner::Tell(std::int64_t due_ns, bool stream_instant) {
  TickEvent event;
  event.stamp = StampAt(due_ns);
  event.stream_instant = stream_instant;
  event.world = session_.world().view();
  event.components = session_.components();
  event.stamp_instant = std::exchange(stamp_owed_, false);
  if (event.stamp_instant && !observers_.empty() && std::exchange(probes_owed_, false)) {
    SampleProbes();
    event.probes = &probes_;
  }
  for (const std::shared_ptr<SessionObserver>& observer : observers_) observer->OnTick(event);
}

wire::Stamp SessionRunner::StampAt(std::int64_t due_ns) const {
  const bool runs = pace_ == Pace::kRealTime;
  return {.tick = session_.tick(),
          .server_monotonic_ns = due_ns,
          .speed = !runs ? 0.0 : (pacer_.keeps_up() ? pacer_.speed() : pacer_.actual_speed()),
          .pace = pace_,
          .actual_speed = runs ? pacer_.actual_speed() : 0.0};
}

// When the tick that stands now was due: on the line of real time, or just now when time stands
// still.
std::int64_t SessionRunner::LastDueNs(std::int64_t now_ns) const {
  return pace_ == Pace::kRealTime ? pacer_.DueNs(session_.tick()) : now_ns;
}

bool SessionRunner::IsStreamInstant() const {
  const SessionSpec& spec = session_.spec();
  return session_.tick() % (spec.recipe.tick_rate_hz / spec.stream_rate_hz) == 0;
}

void SessionRunner::SampleProbes() {
  if (probe_builder_ == nullptr) {
    probe_snapshot_ = nullptr;
    probe_builder_ = std::make_unique<sea::SnapshotBuilder>(session_.components(), transform_);
  }
  probe_snapshot_ = probe_builder_->At(session_.time(), sea::QueryDetail::kHeight,
                                       std::exchange(probe_snapshot_, nullptr));
  probe_snapshot_->Sample(session_.spec().probes_m, probe_samples_);
  probes_.tick = session_.tick();
  const auto level_m =
      static_cast<float>(wire::WaterLevelAt(session_.spec().world.water_level, session_.time()));
  for (std::size_t n = 0; n < probe_samples_.size(); ++n) {
    probes_.height_m[n] = probe_samples_[n].height_m + level_m;
  }
}

absl::Status SessionRunner::Hold(std::int64_t now_ns) {
  if (pace_ == Pace::kLockStep) {
    return absl::FailedPreconditionError("the session is in lock-step and stands by itself");
  }
  if (pace_ == Pace::kHeld) return absl::OkStatus();
  pace_ = Pace::kHeld;
  TellChange(now_ns);
  return absl::OkStatus();
}

absl::Status SessionRunner::Resume(std::int64_t now_ns, Deferred& deferred) {
  if (pace_ == Pace::kLockStep) {
    return absl::FailedPreconditionError("the session is in lock-step; only StepSession moves it");
  }
  if (pace_ == Pace::kRealTime) return absl::OkStatus();
  FailSteps(absl::FailedPreconditionError("the session was resumed"), deferred);
  pace_ = Pace::kRealTime;
  pacer_.Anchor(session_.tick(), now_ns);
  TellChange(now_ns);
  return absl::OkStatus();
}

absl::Status SessionRunner::SetSpeed(double speed, std::int64_t now_ns) {
  ONESEA_RETURN_IF_ERROR(wire::CheckReal("", "speed", speed, kSpeedMin, kSpeedMax));
  if (pace_ == Pace::kLockStep) {
    return absl::FailedPreconditionError("the session is in lock-step and has no speed");
  }
  if (pace_ != Pace::kRealTime) pacer_.Anchor(session_.tick(), now_ns);  // the old one is long ago
  pacer_.SetSpeed(speed, session_.tick(), now_ns);
  TellChange(now_ns);
  return absl::OkStatus();
}

absl::Status SessionRunner::ChangeWeather(std::shared_ptr<const sea::Components> components,
                                          std::int64_t now_ns) {
  ONESEA_RETURN_IF_ERROR(session_.ChangeWeather(std::move(components)));
  probe_builder_ = nullptr;
  probes_owed_ = true;
  const std::shared_ptr<const wire::Welcome> welcome = MakeWelcome();
  for (const std::shared_ptr<SessionObserver>& observer : observers_) {
    observer->OnWelcomeChanged(welcome);
  }
  TellChange(now_ns);
  return absl::OkStatus();
}

std::uint64_t SessionRunner::Step(StepRequest request, StepDone done, std::int64_t now_ns,
                                  Deferred& deferred) {
  const auto refuse = [&](const absl::Status& status) {
    deferred.push_back([done, status] { done(status); });
    return std::uint64_t{0};
  };
  if (pace_ == Pace::kRealTime) {
    return refuse(absl::FailedPreconditionError(
        "the session follows real time; hold it first, or create it with PACE_LOCK_STEP"));
  }
  if (opened_.size() >= kOpenedMax) {
    return refuse(absl::ResourceExhaustedError(
        absl::StrCat(kOpenedMax, " steps are under way already; wait for their answers")));
  }
  const std::int64_t ticks = request.ticks;
  const absl::StatusOr<std::uint64_t> ticket = barrier_.Arrive(std::move(request), done, now_ns);
  if (!ticket.ok()) return refuse(ticket.status());
  std::vector<LockStepBarrier::Waiting> everybody = barrier_.TakeIfFull();
  if (!everybody.empty()) opened_.push_back({ticks, std::move(everybody)});
  return *ticket;
}

void SessionRunner::CancelStep(std::uint64_t ticket, Deferred& deferred) {
  Defer(barrier_.Take(ticket), absl::CancelledError("the participant went away"), deferred);
}

void SessionRunner::FailSteps(const absl::Status& status, Deferred& deferred) {
  for (Opened& opened : opened_) Defer(std::move(opened.waiting), status, deferred);
  opened_.clear();
  Defer(barrier_.TakeAll(), status, deferred);
}

void SessionRunner::Close(std::string_view reason, Deferred& deferred) {
  const absl::Status ended =
      absl::NotFoundError(absl::StrCat("session: it ended: ", wire::Text(reason)));
  FailSteps(ended, deferred);
  commands_.FailAll(ended);
  HandOver(deferred);
  for (const std::shared_ptr<SessionObserver>& observer : observers_) observer->OnClosed(reason);
  observers_.clear();
}

void SessionRunner::AddObserver(std::shared_ptr<SessionObserver> observer) {
  observer->OnWelcomeChanged(MakeWelcome());
  observers_.push_back(std::move(observer));
  stamp_owed_ = true;
  probes_owed_ = true;
}

void SessionRunner::RemoveObserver(const SessionObserver* observer) {
  std::erase_if(observers_, [&](const auto& held) { return held.get() == observer; });
}

std::shared_ptr<const wire::Welcome> SessionRunner::MakeWelcome() const {
  auto welcome = std::make_shared<wire::Welcome>();
  welcome->recipe = session_.components()->recipe;
  welcome->component_hash = session_.components()->hash;
  welcome->session = Info();
  welcome->water_level = session_.spec().world.water_level;
  return welcome;
}

SessionInfo SessionRunner::Info() const {
  const SessionSpec& spec = session_.spec();
  const sea::Components& components = *session_.components();
  SessionInfo info;
  info.name = spec.name;
  info.pace = pace_;
  info.speed = pacer_.speed();
  info.actual_speed = pace_ == Pace::kRealTime ? pacer_.actual_speed() : 0.0;
  info.tick = session_.tick();
  info.tick_rate_hz = spec.recipe.tick_rate_hz;
  info.stream_rate_hz = spec.stream_rate_hz;
  info.epoch_utc_ns = spec.epoch_utc_ns;
  info.latitude_deg = spec.latitude_deg;
  info.longitude_deg = spec.longitude_deg;
  info.hs_m = 4.0 * std::sqrt(sea::VarianceAt(components, session_.time()));
  info.component_hash = components.hash;
  info.sea_name = components.recipe.timeline.back().sea.name;
  info.probes_m = spec.probes_m;
  info.transform = sea::TransformName(transform_);
  info.terrain_hash = session_.terrain_hash();
  return info;
}

}  // namespace onesea::server
