#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "common/base/clock.h"
#include "common/sea/surface.h"
#include "common/wire/terrain_pieces.h"
#include "server/session/lock_step.h"
#include "server/session/session_observer.h"
#include "server/session/session_runner.h"

/// One session on its own thread.
namespace onesea::server {

/// What a query needs to know: which sea, and when is now.
struct SessionView {
  Tick tick = 0;
  std::shared_ptr<const sea::Components> components;
  std::shared_ptr<const world::WorldView> world;  ///< of that tick; never null
};

struct WeatherRequest {
  sea::SeaState sea;
  std::int64_t span_ticks = 0;
  std::optional<Tick> start_tick;  ///< default: the next tick; in real time, half a second ahead,
                                   ///< so that every viewer has built the new sea before it begins
};

struct WeatherSpan {
  Tick start_tick = 0;
  Tick end_tick = 0;
};

struct StateHashes {
  Tick tick = 0;
  std::uint64_t state_hash = 0;
  std::uint64_t component_hash = 0;
};

using PosesDone = std::function<void(absl::StatusOr<PosesResult>)>;

/// Thread-safe. Commands take effect at once, between two ticks; after Close() they answer
/// NotFound.
class SessionLoop {
 public:
  /// Starts the thread. Pre: as Session's constructor. `clock` outlives the loop.
  SessionLoop(SessionSpec spec, std::shared_ptr<const sea::Components> components,
              const Clock& clock, sea::TransformKind transform,
              std::unique_ptr<world::World> world = nullptr);
  ~SessionLoop();

  const std::string& name() const { return name_; }
  int tick_rate_hz() const { return tick_rate_hz_; }

  /// For those who join; null: none.
  const std::shared_ptr<const wire::EncodedTerrain>& terrain() const { return terrain_; }
  const std::vector<wire::WaterLevel>& water_level() const { return water_level_; }

  SessionInfo Info() const;
  /// Never waits for the work of a tick.
  SessionView View() const;
  StateHashes Hashes() const;

  /// Builds the new components on the caller's thread (tens of milliseconds a wave system), then
  /// installs them. InvalidArgument, or FailedPrecondition if `start_tick` went by while they were
  /// built.
  absl::StatusOr<WeatherSpan> ChangeWeather(const WeatherRequest& request);

  /// FailedPrecondition in lock-step. Idempotent. Answers the tick at which it stands or goes on.
  absl::StatusOr<Tick> Hold();
  absl::StatusOr<Tick> Resume();
  /// InvalidArgument outside [kSpeedMin, kSpeedMax]; FailedPrecondition in lock-step.
  absl::Status SetSpeed(double speed);

  /// Advances a held or lock-step session; `done` is called once, on the session's thread (or on
  /// this one for an error that is known at once). In lock-step with several participants it waits
  /// for the others up to the deadline. Returns a ticket for CancelStep, 0 if done was called
  /// already.
  std::uint64_t Step(const StepRequest& request, StepDone done);
  /// Takes a waiting participant out of the barrier; its `done` gets Cancelled. Nothing if it is
  /// too late.
  void CancelStep(std::uint64_t ticket);

  /// A command on the world. It acts between two ticks: at once, or before the tick that it names;
  /// then `done` is called, on the session's thread or on this one. A hull is read and checked on
  /// this thread. Errors: InvalidArgument, NotFound, PermissionDenied (another's lease),
  /// FailedPrecondition (the tick went by), ResourceExhausted.
  void Command(wire::CommandHeader header, wire::WorldCommand command, CommandDone done);
  /// As SessionRunner::SetPoses, between two ticks on the session's thread, so that nobody waits
  /// here; ticks that are due come first. `done` is called there, or here for what is refused at
  /// once: NotFound, or ResourceExhausted with kPosesWaitingMax ahead.
  void SetPoses(std::vector<wire::BodyPose> poses, PosesDone done);
  /// The hull's file of a body that is here, by its hash; null: none.
  std::shared_ptr<const std::string> FindMesh(std::uint64_t hash) const;
  /// Who holds the lease of a body; empty: nobody.
  std::string HolderOf(std::uint32_t body_id) const;

  /// The observer gets OnWelcomeChanged from inside this call, or OnClosed if the session is
  /// closed.
  void AddObserver(std::shared_ptr<SessionObserver> observer);
  /// After it returns no more calls arrive.
  void RemoveObserver(const SessionObserver* observer);

  /// Counts viewers for SessionInfo and the limit kViewersPerSessionMax.
  bool TryAddViewer();
  void RemoveViewer();

  /// Ends the session: observers get OnClosed(reason), waiting steps get NotFound. Idempotent;
  /// joins the thread, so never from an observer or a StepDone.
  void Close(std::string_view reason);

 private:
  struct WaitingPoses {
    std::vector<wire::BodyPose> poses;
    PosesDone done;
  };

  void Run();
  void TakePoses(std::int64_t until_ns);
  void WaitUntil(std::int64_t wake_ns);
  void Wake();
  bool IsWoken();
  std::optional<WaitingPoses> NextPoses();
  void PublishView() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  absl::Status EndedStatus() const;
  absl::Status OpenStatus() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  Tick DefaultStartTick() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const std::string name_;
  const int tick_rate_hz_;
  const Clock& clock_;
  const std::shared_ptr<const wire::EncodedTerrain> terrain_;
  const std::vector<wire::WaterLevel> water_level_;
  absl::Mutex weather_mutex_ ABSL_ACQUIRED_BEFORE(mutex_);  // one change of weather at a time
  mutable absl::Mutex mutex_ ABSL_ACQUIRED_BEFORE(view_mutex_, wake_mutex_);
  SessionRunner runner_ ABSL_GUARDED_BY(mutex_);
  bool closed_ ABSL_GUARDED_BY(mutex_) = false;
  mutable absl::Mutex view_mutex_;
  SessionView view_ ABSL_GUARDED_BY(view_mutex_);
  // Apart from `mutex_`, which is held for as long as a tick takes.
  absl::Mutex wake_mutex_;
  absl::CondVar changed_;
  bool woken_ ABSL_GUARDED_BY(wake_mutex_) = false;
  bool poses_refused_ ABSL_GUARDED_BY(wake_mutex_) = false;  // closed
  std::deque<WaitingPoses> poses_ ABSL_GUARDED_BY(wake_mutex_);
  std::atomic<int> viewer_count_{0};
  absl::Mutex join_mutex_;
  std::thread thread_;
};

}  // namespace onesea::server
