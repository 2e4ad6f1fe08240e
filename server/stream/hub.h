#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "server/session/registry.h"
#include "server/stream/broadcast.h"

namespace onesea::server {

/// A viewer's place in a session: counts it while it lives. Movable.
class Seat {
 public:
  Seat() = default;
  Seat(std::shared_ptr<SessionLoop> session, std::shared_ptr<Broadcast> broadcast,
       Audience audience);
  ~Seat();
  Seat(Seat&& other) noexcept = default;
  Seat& operator=(Seat&& other) noexcept;

  Broadcast* broadcast() const { return broadcast_.get(); }
  Audience audience() const { return audience_; }

 private:
  void Leave();

  std::shared_ptr<SessionLoop> session_;
  std::shared_ptr<Broadcast> broadcast_;
  Audience audience_ = Audience::kStamps;
};

/// Where viewers meet sessions: one Broadcast per watched session. Thread-safe. Must outlive the
/// registry's sessions or be destroyed after they closed.
class Hub {
 public:
  explicit Hub(Registry& registry) : registry_(registry) {}
  ~Hub();

  /// Called, on any thread, when a shard may have something to send. After SetWake returns the
  /// former one isn't called.
  void SetWake(std::function<void()> wake);

  /// NotFound; ResourceExhausted at kViewersPerSessionMax.
  absl::StatusOr<Seat> TakeSeat(std::string_view session, Audience audience);

  /// Housekeeping, a few times a second: tells held-back ticks and forgets closed sessions.
  void Sweep(std::int64_t now_ns);

 private:
  struct Watched {
    std::shared_ptr<SessionLoop> session;
    std::shared_ptr<Broadcast> broadcast;
  };
  void Wake();
  std::shared_ptr<Broadcast> BroadcastOf(const std::shared_ptr<SessionLoop>& session);

  Registry& registry_;
  absl::Mutex wake_mutex_;
  std::function<void()> wake_ ABSL_GUARDED_BY(wake_mutex_);
  absl::Mutex mutex_;
  std::vector<Watched> watched_ ABSL_GUARDED_BY(mutex_);  // at most kSessionsMax live ones
};

}  // namespace onesea::server
