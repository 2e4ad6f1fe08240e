#include "client/net/session_client.h"

#include <pthread.h>

#include <cmath>
#include <utility>

#include "client/net/clock_sync.h"
#include "client/net/watch_attempt.h"

namespace onesea::client {
namespace {

// How long a server that said farewell may answer "no such session" before that is the truth: one
// that goes down, or comes up again and opens its sessions, needs less.
constexpr std::int64_t kGoneAfterNs = 3'000'000'000;

// "No such session" is final for a newcomer. For one that was live it may be a server that
// restarts; after a farewell it is so once it has been the only answer for a while.
class NotFoundPatience {
 public:
  bool After(const absl::Status& status, const WatchAttempt& attempt, std::int64_t now_ns) {
    if (attempt.was_live()) {
      ever_live_ = true;
      said_farewell_ = attempt.said_farewell();
    }
    if (!absl::IsNotFound(status)) {
      not_found_since_ns_ = -1;
      if (!attempt.was_live()) said_farewell_ = false;  // that server is away
      return true;
    }
    if (not_found_since_ns_ < 0) not_found_since_ns_ = now_ns;
    return ever_live_ && !(said_farewell_ && now_ns - not_found_since_ns_ >= kGoneAfterNs);
  }

 private:
  bool ever_live_ = false;
  bool said_farewell_ = false;
  std::int64_t not_found_since_ns_ = -1;
};

}  // namespace

SessionClient::SessionClient(ChannelFactory connect, SessionClientOptions options,
                             SessionListener& listener, const Clock& clock)
    : connect_(std::move(connect)),
      options_(std::move(options)),
      listener_(listener),
      clock_(clock) {
  thread_ = std::thread([this] {
    pthread_setname_np(pthread_self(), "sea-link");
    Run();
  });
}

SessionClient::~SessionClient() { Stop(); }

void SessionClient::Stop() {
  {
    absl::MutexLock lock(&mutex_);
    stopping_ = true;
    if (attempt_ != nullptr) attempt_->Cancel();
  }
  absl::MutexLock lock(&join_mutex_);
  if (thread_.joinable()) thread_.join();
}

void SessionClient::Run() {
  // Different for every process and client, so that a crowd does not come back in step.
  Backoff backoff(options_.backoff, static_cast<std::uint64_t>(clock_.MonotonicNs()) ^
                                        reinterpret_cast<std::uintptr_t>(this));
  NotFoundPatience patience;
  for (;;) {
    Tell({.state = LinkState::kConnecting, .status = {}, .retry_in_ns = 0});
    WatchAttempt attempt(*this);
    {
      absl::MutexLock lock(&mutex_);
      if (stopping_) break;
      attempt_ = &attempt;
    }
    const absl::Status status = attempt.Run();
    {
      absl::MutexLock lock(&mutex_);
      attempt_ = nullptr;
      if (stopping_) break;
    }
    if (attempt.was_live()) backoff.Reset();
    const bool patient = patience.After(status, attempt, clock_.MonotonicNs());
    if (!WorthAnotherTry(status, patient)) {
      return Tell({.state = LinkState::kFailed, .status = status, .retry_in_ns = 0});
    }
    const std::int64_t wait_ns = backoff.NextNs();
    Tell({.state = LinkState::kWaiting, .status = status, .retry_in_ns = wait_ns});
    if (!SleepUnlessStopped(wait_ns)) break;
  }
  absl::MutexLock lock(&mutex_);
  stats_.state = LinkState::kStopped;
}

bool SessionClient::WorthAnotherTry(const absl::Status& status, bool retry_not_found) {
  switch (status.code()) {
    case absl::StatusCode::kInvalidArgument:
    case absl::StatusCode::kFailedPrecondition:
    case absl::StatusCode::kUnimplemented:
    case absl::StatusCode::kUnauthenticated:
    case absl::StatusCode::kPermissionDenied:
      return false;
    case absl::StatusCode::kNotFound:
      return retry_not_found;
    default:
      return true;
  }
}

bool SessionClient::SleepUnlessStopped(std::int64_t span_ns) {
  absl::MutexLock lock(&mutex_);
  return !mutex_.AwaitWithTimeout(absl::Condition(&stopping_), absl::Nanoseconds(span_ns));
}

void SessionClient::Tell(const LinkEvent& event) {
  {
    absl::MutexLock lock(&mutex_);
    stats_.state = event.state;
  }
  listener_.OnLink(event);
}

SeaTime SessionClient::Now() {
  absl::MutexLock lock(&mutex_);
  SeaTime now;
  if (!sea_clock_.valid()) return now;
  const std::int64_t local_ns = clock_.MonotonicNs();
  now.valid = true;
  now.exact = sea_clock_.Exact(local_ns);
  now.render = sea_clock_.Render(local_ns);
  now.speed = sea_clock_.speed();
  const double age_ns = static_cast<double>(local_ns - bound_at_ns_);
  const double bound_ns = static_cast<double>(bound_ns_) + kClockDriftMax * age_ns;
  now.error_bound_s = bound_ns * 1e-9 * now.speed;
  return now;
}

LinkStats SessionClient::stats() const {
  absl::MutexLock lock(&mutex_);
  return stats_;
}

}  // namespace onesea::client
