#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "common/sea/point_query.h"
#include "server/session/command_queue.h"
#include "server/session/lease_book.h"
#include "server/session/lock_step.h"
#include "server/session/pacer.h"
#include "server/session/session.h"
#include "server/session/session_observer.h"

/// Everything that a session's thread does, without the thread: the time is an argument, so tests
/// need no sleeping. Not thread-safe; SessionLoop guards it.
namespace onesea::server {

/// What streamed poses met.
struct PosesResult {
  Tick tick = 0;  ///< of the water
  std::vector<wire::BodyWrench> wrenches;
};

class SessionRunner {
 public:
  /// What is to be called after the lock is given back.
  using Deferred = std::vector<std::function<void()>>;

  SessionRunner(SessionSpec spec, std::shared_ptr<const sea::Components> components,
                sea::TransformKind transform, std::int64_t now_ns,
                std::unique_ptr<world::World> world = nullptr);

  /// Makes the ticks that are due, the stamps and the barrier's work; at most kTicksPerAdvance
  /// ticks, so that commands get their turn. Returns when to call again [ns, monotonic].
  std::int64_t Advance(std::int64_t now_ns, Deferred& deferred);

  absl::Status Hold(std::int64_t now_ns);
  absl::Status Resume(std::int64_t now_ns, Deferred& deferred);
  absl::Status SetSpeed(double speed, std::int64_t now_ns);
  absl::Status ChangeWeather(std::shared_ptr<const sea::Components> components,
                             std::int64_t now_ns);
  /// As SessionLoop's.
  std::uint64_t Step(StepRequest request, StepDone done, std::int64_t now_ns, Deferred& deferred);
  void CancelStep(std::uint64_t ticket, Deferred& deferred);
  /// As SessionLoop's.
  void Command(CommandRequest request, CommandDone done, std::int64_t now_ns, Deferred& deferred);
  /// As World::SetPoses, for whoever shows the leases of the bodies; PermissionDenied.
  absl::StatusOr<PosesResult> SetPoses(std::span<const wire::BodyPose> poses, std::int64_t now_ns);
  std::string HolderOf(std::uint32_t body_id, std::int64_t now_ns) const {
    return leases_.Holder(body_id, now_ns);
  }
  void Close(std::string_view reason, Deferred& deferred);

  void AddObserver(std::shared_ptr<SessionObserver> observer);
  void RemoveObserver(const SessionObserver* observer);

  const Session& session() const { return session_; }
  Pace pace() const { return pace_; }
  double speed() const { return pacer_.speed(); }
  /// `viewer_count` is left 0.
  SessionInfo Info() const;

 private:
  static constexpr int kTicksPerAdvance = 1000;
  static constexpr int kTicksPerAdvanceWithWorld = 20;  // of milliseconds each
  static constexpr std::size_t kOpenedMax = 16;

  // A barrier that opened: these wait until its ticks are made.
  struct Opened {
    std::int64_t ticks_left = 0;
    std::vector<LockStepBarrier::Waiting> waiting;
  };

  void AdvanceRealTime(std::int64_t now_ns);
  void AdvanceSteps(std::int64_t now_ns, Deferred& deferred);
  void StartSecond(std::int64_t now_ns);
  void TellLate(std::int64_t now_ns);
  void Tell(std::int64_t due_ns, bool stream_instant);
  void TellChange(std::int64_t now_ns);
  std::shared_ptr<const wire::Welcome> MakeWelcome() const;
  wire::Stamp StampAt(std::int64_t due_ns) const;
  std::int64_t LastDueNs(std::int64_t now_ns) const;
  bool IsStreamInstant() const;
  void SampleProbes();
  void FailSteps(const absl::Status& status, Deferred& deferred);
  void MakeTick(std::int64_t now_ns);
  int TicksPerAdvance() const;
  void Do(const CommandQueue::Due& due, std::int64_t now_ns);
  absl::StatusOr<CommandResult> Act(const CommandRequest& request, std::int64_t now_ns);
  void HandOver(Deferred& deferred);

  Session session_;
  sea::TransformKind transform_;
  Pace pace_;
  Pacer pacer_;
  LockStepBarrier barrier_;
  std::deque<Opened> opened_;
  CommandQueue commands_;
  LeaseBook leases_{RandomSecret};
  Deferred answered_;  // of commands, for the next who gives the lock back
  std::int64_t next_second_ns_ = 0;
  bool stamp_owed_ = true;   // the next event is a stamp
  bool probes_owed_ = true;  // and carries probe heights
  bool told_slow_ = false;
  std::vector<std::shared_ptr<SessionObserver>> observers_;
  std::unique_ptr<sea::SnapshotBuilder> probe_builder_;  // null after the weather changed
  std::shared_ptr<const sea::SeaSnapshot> probe_snapshot_;
  std::vector<sea::SurfaceSample> probe_samples_;
  wire::ProbeHeights probes_;
};

}  // namespace onesea::server
