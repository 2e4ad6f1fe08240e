#include "server/stream/hub.h"

#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/limits.h"

namespace onesea::server {

Seat::Seat(std::shared_ptr<SessionLoop> session, std::shared_ptr<Broadcast> broadcast,
           Audience audience)
    : session_(std::move(session)), broadcast_(std::move(broadcast)), audience_(audience) {
  broadcast_->AddViewer(audience_);
}

Seat::~Seat() { Leave(); }

Seat& Seat::operator=(Seat&& other) noexcept {
  if (this == &other) return *this;
  Leave();
  session_ = std::move(other.session_);
  broadcast_ = std::move(other.broadcast_);
  audience_ = other.audience_;
  return *this;
}

void Seat::Leave() {
  if (session_ == nullptr) return;
  broadcast_->RemoveViewer(audience_);
  session_->RemoveViewer();
  session_.reset();
  broadcast_.reset();
}

Hub::~Hub() {
  absl::MutexLock lock(&mutex_);
  for (const Watched& watched : watched_) watched.session->RemoveObserver(watched.broadcast.get());
}

void Hub::SetWake(std::function<void()> wake) {
  absl::MutexLock lock(&wake_mutex_);
  wake_ = std::move(wake);
}

void Hub::Wake() {
  absl::ReaderMutexLock lock(&wake_mutex_);
  if (wake_ != nullptr) wake_();
}

absl::StatusOr<Seat> Hub::TakeSeat(std::string_view session, Audience audience) {
  absl::StatusOr<std::shared_ptr<SessionLoop>> found = registry_.Find(session);
  if (!found.ok()) return found.status();
  if (!(*found)->TryAddViewer()) {
    return absl::ResourceExhaustedError(absl::StrCat("session \"", std::string(session),
                                                     "\" already has ", kViewersPerSessionMax,
                                                     " viewers, the most it takes"));
  }
  std::shared_ptr<Broadcast> broadcast = BroadcastOf(*found);
  return Seat(*std::move(found), std::move(broadcast), audience);
}

std::shared_ptr<Broadcast> Hub::BroadcastOf(const std::shared_ptr<SessionLoop>& session) {
  absl::MutexLock lock(&mutex_);
  for (const Watched& watched : watched_) {
    if (watched.session == session) return watched.broadcast;
  }
  auto broadcast = std::make_shared<Broadcast>([this] { Wake(); });
  // Under the lock, so that a second viewer never meets a broadcast without its welcome.
  session->AddObserver(broadcast);
  watched_.push_back({session, broadcast});
  return broadcast;
}

void Hub::Sweep(std::int64_t now_ns) {
  std::vector<std::shared_ptr<Broadcast>> live;
  std::vector<std::shared_ptr<SessionLoop>> closed;  // destroyed without the lock
  {
    absl::MutexLock lock(&mutex_);
    std::erase_if(watched_, [&](Watched& watched) {
      if (!watched.broadcast->closed()) return false;
      closed.push_back(std::move(watched.session));
      return true;
    });
    for (const Watched& watched : watched_) live.push_back(watched.broadcast);
  }
  for (const std::shared_ptr<Broadcast>& broadcast : live) broadcast->Flush(now_ns);
}

}  // namespace onesea::server
