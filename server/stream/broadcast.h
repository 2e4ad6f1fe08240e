#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "server/session/session_observer.h"
#include "server/stream/encoded_frame.h"
#include "server/stream/frame_builder.h"

namespace onesea::server {

/// The frames of one session, offered to every thread that sends them. The session's thread writes,
/// shard threads read; a reader takes what is newest and is never queued for.
class Broadcast final : public SessionObserver {
 public:
  /// `wake` is called, on the session's thread and without a lock of this class, when there is
  /// something new to send; it must return quickly.
  explicit Broadcast(std::function<void()> wake) : wake_(std::move(wake)) {}

  void OnWelcomeChanged(std::shared_ptr<const wire::Welcome> welcome) override;
  void OnTick(const TickEvent& event) override;
  void OnClosed(std::string_view reason) override;

  /// Tells ticks that were held back.
  void Flush(std::int64_t now_ns);

  struct Newest {
    std::int64_t sequence = -1;  ///< -1: nothing can be told yet
    FramePtr frame;              ///< for those who have the one before; null before the first
    FramePtr keyframe;           ///< of the newest state, if asked for
    bool closed = false;         ///< these carry the farewell; nothing follows
  };
  /// All of one moment. The keyframe is encoded here if this is the first to ask for it in this
  /// tick.
  Newest newest(Audience audience, bool with_keyframe) const;
  bool closed() const { return closed_.load(std::memory_order_acquire); }

  void AddViewer(Audience audience) { ++viewers_[static_cast<int>(audience)]; }
  void RemoveViewer(Audience audience) { --viewers_[static_cast<int>(audience)]; }
  int viewer_count(Audience audience) const { return viewers_[static_cast<int>(audience)]; }

 private:
  FrameBuilder& builder(Audience audience) const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return builders_[static_cast<int>(audience)];
  }

  std::function<void()> wake_;
  mutable absl::Mutex mutex_;
  mutable std::array<FrameBuilder, kAudiences> builders_ ABSL_GUARDED_BY(mutex_) = {
      FrameBuilder(Audience::kStamps), FrameBuilder(Audience::kEveryFrame)};
  std::array<std::atomic<int>, kAudiences> viewers_{};
  std::atomic<bool> closed_{false};
};

}  // namespace onesea::server
