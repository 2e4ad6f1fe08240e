#include "server/session/session_loop.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/time/time.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/sea/attenuation.h"
#include "common/wire/bounds.h"
#include "common/wire/recipe_codec.h"

namespace onesea::server {
namespace {

// Ticks shorter than this are made in small batches: a thread can't be woken more often for good.
constexpr std::int64_t kWaitMinNs = 500'000;
// How far ahead a change of weather without a start begins, so that every viewer has built the new
// sea before.
constexpr double kWeatherLeadS = 0.5;
constexpr int kWeatherAttempts = 4;
// Streams keep at most a few each under way.
constexpr std::size_t kPosesWaitingMax = 1024;

std::shared_ptr<const wire::EncodedTerrain> EncodedTerrainOf(const world::World* world) {
  if (world == nullptr || world->terrain() == nullptr) return nullptr;
  return std::make_shared<const wire::EncodedTerrain>(wire::PackTerrain(*world->terrain()));
}

void RunAll(SessionRunner::Deferred& deferred) {
  for (const std::function<void()>& call : deferred) call();
}

}  // namespace

SessionLoop::SessionLoop(SessionSpec spec, std::shared_ptr<const sea::Components> components,
                         const Clock& clock, sea::TransformKind transform,
                         std::unique_ptr<world::World> world)
    : name_(spec.name),
      tick_rate_hz_(spec.recipe.tick_rate_hz),
      clock_(clock),
      terrain_(EncodedTerrainOf(world.get())),
      water_level_(spec.world.water_level),
      runner_(std::move(spec), std::move(components), transform, clock.MonotonicNs(),
              std::move(world)) {
  {
    absl::MutexLock lock(&mutex_);
    PublishView();
  }
  thread_ = std::thread([this] { Run(); });
}

SessionLoop::~SessionLoop() { Close("the server stops"); }

void SessionLoop::Run() {
  SessionRunner::Deferred deferred;
  while (true) {
    std::int64_t wake_ns = 0;
    {
      absl::MutexLock lock(&mutex_);
      if (closed_) return;
      wake_ns = runner_.Advance(clock_.MonotonicNs(), deferred);
      PublishView();
    }
    RunAll(deferred);
    deferred.clear();
    TakePoses(wake_ns);
    WaitUntil(wake_ns);
  }
}

// At least one lot, so that a session that can't keep up answers too; no more when somebody waits
// for the loop to go round.
void SessionLoop::TakePoses(std::int64_t until_ns) {
  while (std::optional<WaitingPoses> next = NextPoses()) {
    absl::StatusOr<PosesResult> result;
    {
      absl::MutexLock lock(&mutex_);
      const std::int64_t now_ns = clock_.MonotonicNs();
      const absl::Status open = OpenStatus();
      result = open.ok() ? runner_.SetPoses(next->poses, now_ns) : open;
    }
    next->done(std::move(result));
    if (clock_.MonotonicNs() >= until_ns || IsWoken()) return;
  }
}

bool SessionLoop::IsWoken() {
  absl::MutexLock lock(&wake_mutex_);
  return woken_;
}

std::optional<SessionLoop::WaitingPoses> SessionLoop::NextPoses() {
  absl::MutexLock lock(&wake_mutex_);
  if (poses_.empty()) return std::nullopt;
  WaitingPoses next = std::move(poses_.front());
  poses_.pop_front();
  return next;
}

void SessionLoop::WaitUntil(std::int64_t wake_ns) {
  const std::int64_t span_ns = wake_ns - clock_.MonotonicNs();
  absl::MutexLock lock(&wake_mutex_);
  if (span_ns > 0 && !woken_ && poses_.empty()) {
    changed_.WaitWithTimeout(&wake_mutex_, absl::Nanoseconds(std::max(span_ns, kWaitMinNs)));
  }
  woken_ = false;
}

void SessionLoop::Wake() {
  absl::MutexLock lock(&wake_mutex_);
  woken_ = true;
  changed_.Signal();
}

void SessionLoop::PublishView() {
  absl::MutexLock lock(&view_mutex_);
  view_.tick = runner_.session().tick();
  view_.world = runner_.session().world().view();
  if (view_.components != runner_.session().components()) {
    view_.components = runner_.session().components();
  }
}

absl::Status SessionLoop::EndedStatus() const {
  return absl::NotFoundError(absl::StrCat("session: '", name_, "' has ended"));
}

absl::Status SessionLoop::OpenStatus() const { return closed_ ? EndedStatus() : absl::OkStatus(); }

SessionView SessionLoop::View() const {
  absl::MutexLock lock(&view_mutex_);
  return view_;
}

SessionInfo SessionLoop::Info() const {
  SessionInfo info;
  {
    absl::MutexLock lock(&mutex_);
    info = runner_.Info();
  }
  info.viewer_count = viewer_count_.load();
  return info;
}

StateHashes SessionLoop::Hashes() const {
  absl::MutexLock lock(&mutex_);
  const Session& session = runner_.session();
  return {session.tick(), session.StateHash(), session.components()->hash};
}

Tick SessionLoop::DefaultStartTick() const {
  const Tick next = runner_.session().tick() + 1;
  if (runner_.pace() != Pace::kRealTime) return next;
  return next + static_cast<Tick>(kWeatherLeadS * tick_rate_hz_ * runner_.speed());
}

absl::StatusOr<WeatherSpan> SessionLoop::ChangeWeather(const WeatherRequest& request) {
  const std::int64_t span_max = static_cast<std::int64_t>(kWeatherSpanMaxS) * tick_rate_hz_;
  ONESEA_RETURN_IF_ERROR(wire::CheckInteger("", "span_ticks", request.span_ticks, 0, span_max));
  absl::MutexLock one_at_a_time(&weather_mutex_);
  absl::Status status;
  for (int attempt = 0; attempt < kWeatherAttempts; ++attempt) {
    sea::Recipe recipe;
    std::shared_ptr<const sea::Terrain> terrain;
    Tick start_tick = 0;
    {
      absl::MutexLock lock(&mutex_);
      ONESEA_RETURN_IF_ERROR(OpenStatus());
      recipe = runner_.session().components()->recipe;
      terrain = runner_.session().world().terrain();
      // A slow build may overtake the default start: try again with more lead.
      start_tick = request.start_tick.value_or(DefaultStartTick());
      if (!request.start_tick) start_tick += (start_tick - runner_.session().tick() - 1) * attempt;
      if (!IsTickInRange(start_tick, tick_rate_hz_)) {
        return absl::InvalidArgumentError(
            absl::StrCat("start_tick: ", start_tick, " is more than a century from tick 0"));
      }
      if (start_tick <= runner_.session().tick()) {
        return absl::InvalidArgumentError(absl::StrCat("start_tick: ", start_tick,
                                                       " is not after the present tick ",
                                                       runner_.session().tick()));
      }
    }
    ONESEA_RETURN_IF_ERROR(
        sea::AppendWeather(recipe, {start_tick, request.span_ticks, request.sea}));
    ONESEA_RETURN_IF_ERROR(sea::ValidateRecipe(recipe));
    ONESEA_RETURN_IF_ERROR(wire::CheckRecipeBytes(recipe));
    ONESEA_ASSIGN_OR_RETURN(auto components, sea::BuildComponents(recipe));
    components = sea::OverTerrain(std::move(components), terrain);
    absl::MutexLock lock(&mutex_);
    ONESEA_RETURN_IF_ERROR(OpenStatus());
    status = runner_.ChangeWeather(std::move(components), clock_.MonotonicNs());
    PublishView();
    if (status.ok()) return WeatherSpan{start_tick, start_tick + request.span_ticks};
    if (request.start_tick) break;
  }
  return status;
}

absl::StatusOr<Tick> SessionLoop::Hold() {
  absl::MutexLock lock(&mutex_);
  ONESEA_RETURN_IF_ERROR(OpenStatus());
  ONESEA_RETURN_IF_ERROR(runner_.Hold(clock_.MonotonicNs()));
  Wake();
  return runner_.session().tick();
}

absl::StatusOr<Tick> SessionLoop::Resume() {
  SessionRunner::Deferred deferred;
  Tick tick = 0;
  {
    absl::MutexLock lock(&mutex_);
    ONESEA_RETURN_IF_ERROR(OpenStatus());
    ONESEA_RETURN_IF_ERROR(runner_.Resume(clock_.MonotonicNs(), deferred));
    tick = runner_.session().tick();
    Wake();
  }
  RunAll(deferred);
  return tick;
}

absl::Status SessionLoop::SetSpeed(double speed) {
  absl::MutexLock lock(&mutex_);
  ONESEA_RETURN_IF_ERROR(OpenStatus());
  ONESEA_RETURN_IF_ERROR(runner_.SetSpeed(speed, clock_.MonotonicNs()));
  Wake();
  return absl::OkStatus();
}

std::uint64_t SessionLoop::Step(const StepRequest& request, StepDone done) {
  SessionRunner::Deferred deferred;
  std::uint64_t ticket = 0;
  {
    absl::MutexLock lock(&mutex_);
    if (const absl::Status open = OpenStatus(); !open.ok()) {
      deferred.push_back([done, open] { done(open); });
    } else {
      ticket = runner_.Step(request, std::move(done), clock_.MonotonicNs(), deferred);
      Wake();
    }
  }
  RunAll(deferred);
  return ticket;
}

void SessionLoop::CancelStep(std::uint64_t ticket) {
  SessionRunner::Deferred deferred;
  {
    absl::MutexLock lock(&mutex_);
    runner_.CancelStep(ticket, deferred);
  }
  RunAll(deferred);
}

void SessionLoop::Command(wire::CommandHeader header, wire::WorldCommand command,
                          CommandDone done) {
  CommandRequest request{std::move(header), std::move(command), nullptr};
  if (const auto* spawn = std::get_if<wire::SpawnBody>(&request.command)) {
    absl::StatusOr<world::PreparedBody> body = world::PrepareBody(spawn->body);
    if (!body.ok()) return done(body.status());
    request.body = std::make_shared<const world::PreparedBody>(*std::move(body));
  }
  SessionRunner::Deferred deferred;
  {
    absl::MutexLock lock(&mutex_);
    if (const absl::Status open = OpenStatus(); !open.ok()) {
      deferred.push_back([done, open] { done(open); });
    } else {
      runner_.Command(std::move(request), std::move(done), clock_.MonotonicNs(), deferred);
      PublishView();
      Wake();
    }
  }
  RunAll(deferred);
}

void SessionLoop::SetPoses(std::vector<wire::BodyPose> poses, PosesDone done) {
  absl::Status refused;
  {
    absl::MutexLock lock(&wake_mutex_);
    if (poses_refused_) {
      refused = EndedStatus();
    } else if (poses_.size() >= kPosesWaitingMax) {
      refused = absl::ResourceExhaustedError(
          absl::StrCat(kPosesWaitingMax, " requests with poses wait already"));
    } else {
      poses_.push_back({std::move(poses), std::move(done)});
      changed_.Signal();
      return;
    }
  }
  done(refused);
}

std::shared_ptr<const std::string> SessionLoop::FindMesh(std::uint64_t hash) const {
  absl::MutexLock lock(&mutex_);
  return runner_.session().world().FindMesh(hash);
}

std::string SessionLoop::HolderOf(std::uint32_t body_id) const {
  absl::MutexLock lock(&mutex_);
  return runner_.HolderOf(body_id, clock_.MonotonicNs());
}

void SessionLoop::AddObserver(std::shared_ptr<SessionObserver> observer) {
  absl::MutexLock lock(&mutex_);
  if (closed_) {
    observer->OnClosed("the session has ended");
    return;
  }
  runner_.AddObserver(std::move(observer));
  Wake();
}

void SessionLoop::RemoveObserver(const SessionObserver* observer) {
  absl::MutexLock lock(&mutex_);
  runner_.RemoveObserver(observer);
}

bool SessionLoop::TryAddViewer() {
  if (viewer_count_.fetch_add(1) < kViewersPerSessionMax) return true;
  viewer_count_.fetch_sub(1);
  return false;
}

void SessionLoop::RemoveViewer() { viewer_count_.fetch_sub(1); }

void SessionLoop::Close(std::string_view reason) {
  SessionRunner::Deferred deferred;
  {
    absl::MutexLock lock(&mutex_);
    if (!closed_) runner_.Close(reason, deferred);
    closed_ = true;
    Wake();
  }
  std::deque<WaitingPoses> unheard;
  {
    absl::MutexLock lock(&wake_mutex_);
    poses_refused_ = true;
    unheard.swap(poses_);
  }
  RunAll(deferred);
  for (const WaitingPoses& poses : unheard) poses.done(EndedStatus());
  absl::MutexLock lock(&join_mutex_);
  if (thread_.joinable()) thread_.join();
}

}  // namespace onesea::server
