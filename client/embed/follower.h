#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <thread>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "client/model/local_sea.h"
#include "common/wire/frame.h"

namespace onesea::client {

/// Turns the frames of a session into a LocalSea, on a thread of its own: building components takes
/// tens of milliseconds, and the network thread, which measures clocks, must not wait for that.
///
/// Welcomes and probe heights are worked off in their order; when the work falls behind, the newest
/// of each is enough.
class Follower {
 public:
  struct Events {
    std::function<void()> on_new_sea;               ///< a welcome was followed
    std::function<void(const Drift&)> on_compared;  ///< probe heights were compared
    std::function<void(const absl::Status&)>
        on_refused;  ///< a welcome or probes could not be followed
  };

  /// The events come from the follower's thread.
  explicit Follower(Events events);
  /// Ends the thread after the piece of work at hand.
  ~Follower();

  /// Any thread; returns at once.
  void Offer(const wire::Frame& frame);

  /// Null until the first welcome was followed; then the same sea for ever.
  LocalSea* sea() const;
  /// Waits until sea() is there or a welcome was refused. DeadlineExceeded; or why it was refused.
  absl::Status WaitForSea(absl::Time deadline) const;

 private:
  void Run();
  absl::Status Follow(const wire::Welcome& welcome);

  const Events events_;
  mutable absl::Mutex mutex_;
  std::unique_ptr<LocalSea> sea_ ABSL_GUARDED_BY(mutex_);
  absl::Status refusal_ ABSL_GUARDED_BY(mutex_);
  std::optional<wire::Welcome> welcome_ ABSL_GUARDED_BY(mutex_);
  std::optional<wire::ProbeHeights> probes_ ABSL_GUARDED_BY(mutex_);
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;
  std::thread thread_;
};

}  // namespace onesea::client
