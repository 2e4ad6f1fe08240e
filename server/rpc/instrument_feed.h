#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "common/wire/world_command.h"
#include "server/query/instruments.h"
#include "server/rpc/worker.h"
#include "server/session/session_loop.h"

/// The readings of one stream of instruments.
namespace onesea::server {

struct Reading {
  Tick tick = 0;
  std::vector<double> values;
  std::int64_t skipped_count = 0;  ///< left out just before this one
};

/// 1. The session's thread hands over the moments that are to be read: it keeps references to what
///    is immutable anyway, and never waits.
/// 2. A worker reads the instruments of one moment after the other, one a turn: it has other feeds.
/// 3. The stream takes readings as it can write them.
/// Both queues are bounded; what finds them full is left out and counted. Thread-safe.
class InstrumentFeed final : public SessionObserver,
                             public std::enable_shared_from_this<InstrumentFeed> {
 public:
  /// They hold a view of the world each.
  static constexpr std::size_t kMomentsMax = 4;
  static constexpr std::size_t kReadingsMax = 64;

  /// Of `session`, which it doesn't hold; it is to be added to its observers. `wake` is called from
  /// any thread when there is something for Next() or status(), until StopWaking() returns; it must
  /// be quick. `worker` outlives the feed's being observed.
  InstrumentFeed(const wire::InstrumentRequest& request, const SessionLoop& session,
                 std::shared_ptr<QueryEngine> engine, Worker& worker, std::function<void()> wake);

  void OnWelcomeChanged(std::shared_ptr<const wire::Welcome> /*welcome*/) override {}
  void OnTick(const TickEvent& event) override;
  void OnClosed(std::string_view reason) override;

  /// Oldest first.
  std::optional<Reading> Next();
  /// Not OK: the session ended, and after the readings that are left there are no more.
  absl::Status status() const;
  /// Calls `wake`, unless StopWaking() was called: that waits for a call which is under way.
  void Wake();
  void StopWaking();

 private:
  struct Moment {
    Tick tick = 0;
    std::shared_ptr<const sea::Components> components;
    std::shared_ptr<const world::WorldView> world, before;  // null: not known
    std::int64_t skipped_count = 0;
  };
  void PostReading() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void ReadMoment();
  void Keep(Reading reading);

  const std::vector<wire::WaterLevel> water_level_;
  const std::int64_t ticks_per_reading_;
  const std::shared_ptr<QueryEngine> engine_;
  Worker& worker_;
  InstrumentReader reader_;  // of the worker's thread

  mutable absl::Mutex mutex_;
  Tick last_tick_ ABSL_GUARDED_BY(mutex_);
  std::shared_ptr<const world::WorldView> last_world_ ABSL_GUARDED_BY(mutex_);
  std::deque<Moment> moments_ ABSL_GUARDED_BY(mutex_);
  std::deque<Reading> readings_ ABSL_GUARDED_BY(mutex_);
  std::int64_t moments_skipped_ ABSL_GUARDED_BY(mutex_) = 0;
  std::int64_t readings_skipped_ ABSL_GUARDED_BY(mutex_) = 0;
  bool at_worker_ ABSL_GUARDED_BY(mutex_) = false;
  absl::Status status_ ABSL_GUARDED_BY(mutex_);

  absl::Mutex wake_mutex_;
  std::function<void()> wake_ ABSL_GUARDED_BY(wake_mutex_);
};

}  // namespace onesea::server
