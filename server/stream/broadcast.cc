#include "server/stream/broadcast.h"

#include <string>

namespace onesea::server {

void Broadcast::OnWelcomeChanged(std::shared_ptr<const wire::Welcome> welcome) {
  {
    absl::MutexLock lock(&mutex_);
    for (FrameBuilder& builder : builders_) builder.OnWelcome(welcome);
  }
  wake_();
}

void Broadcast::OnTick(const TickEvent& event) {
  bool news = false;
  {
    absl::MutexLock lock(&mutex_);
    for (int audience = 0; audience < kAudiences; ++audience) {
      // The first tick makes the keyframe possible that newcomers wait for.
      const bool first = builders_[audience].newest_sequence() < 0;
      const bool watched = viewers_[audience].load() > 0;
      const bool emitted = builders_[audience].OnTick(event, watched);
      news = news || emitted || (first && watched);
    }
  }
  if (news) wake_();
}

void Broadcast::OnClosed(std::string_view reason) {
  {
    absl::MutexLock lock(&mutex_);
    for (FrameBuilder& builder : builders_) builder.OnClosed(std::string(reason));
    closed_.store(true, std::memory_order_release);
  }
  wake_();
}

void Broadcast::Flush(std::int64_t now_ns) {
  bool news = false;
  {
    absl::MutexLock lock(&mutex_);
    for (FrameBuilder& builder : builders_) news = builder.Flush(now_ns) || news;
  }
  if (news) wake_();
}

Broadcast::Newest Broadcast::newest(Audience audience, bool with_keyframe) const {
  absl::MutexLock lock(&mutex_);
  FrameBuilder& from = builder(audience);
  Newest newest;
  // First, since it may make a new frame.
  if (with_keyframe && from.newest_sequence() >= 0) newest.keyframe = from.Keyframe();
  newest.sequence = from.newest_sequence();
  newest.frame = from.newest();
  newest.closed = closed();
  return newest;
}

}  // namespace onesea::server
