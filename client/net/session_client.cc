#include "client/net/session_client.h"

#include <utility>

#include "client/net/connection.h"
#include "common/base/check.h"

namespace onesea::client {
namespace {

bool IsFinal(const absl::Status& status) {
  switch (status.code()) {
    case absl::StatusCode::kNotFound:
    case absl::StatusCode::kInvalidArgument:
    case absl::StatusCode::kFailedPrecondition:
    case absl::StatusCode::kUnimplemented:
    case absl::StatusCode::kPermissionDenied:
    case absl::StatusCode::kUnauthenticated:
      return true;
    default:
      return false;
  }
}

}  // namespace

SessionClient::SessionClient(const std::string& address, SessionClientOptions options,
                             SessionHandlers handlers, const Clock& clock)
    : SessionClient(MakeChannel(address), address, std::move(options), std::move(handlers), clock) {
}

SessionClient::SessionClient(std::shared_ptr<grpc::Channel> channel, std::string address,
                             SessionClientOptions options, SessionHandlers handlers,
                             const Clock& clock)
    : channel_(std::move(channel)),
      address_(std::move(address)),
      options_(std::move(options)),
      handlers_(std::move(handlers)),
      clock_(clock),
      // Different in every process and client: this only spreads reconnections.
      random_state_(static_cast<std::uint64_t>(clock.MonotonicNs()) ^
                    reinterpret_cast<std::uintptr_t>(this)),
      thread_([this] { Run(); }) {}

SessionClient::~SessionClient() {
  {
    absl::MutexLock lock(&mutex_);
    stopping_ = true;
    if (connection_ != nullptr) connection_->Cancel();
  }
  thread_.join();
}

std::optional<SimTime> SessionClient::SeaTime() const {
  absl::MutexLock lock(&mutex_);
  return sea_clock_.Now(clock_.MonotonicNs());
}

double SessionClient::Speed() const {
  absl::MutexLock lock(&mutex_);
  return sea_clock_.speed();
}

ConnectionReport SessionClient::Report() const {
  absl::MutexLock lock(&mutex_);
  ConnectionReport report = report_;
  report.clock = clock_sync_.Estimate(clock_.MonotonicNs());
  return report;
}

void SessionClient::Run() {
  Backoff backoff;
  while (true) {
    bool greeted = false;
    Connection connection(channel_, address_, options_, drift_m_, clock_,
                          {.on_frame =
                               [&](wire::Frame frame, std::size_t bytes) {
                                 if (!std::exchange(greeted, true)) {
                                   backoff.Reset();
                                   OnConnected();
                                 }
                                 OnFrame(std::move(frame), bytes);
                               },
                           .on_exchange = [&](const ClockSync& sync) { OnExchange(sync); }});
    {
      absl::MutexLock lock(&mutex_);
      if (stopping_) return;
      connection_ = &connection;
    }
    const absl::Status status = connection.Run();
    {
      absl::MutexLock lock(&mutex_);
      connection_ = nullptr;
      report_.connected = false;
      if (stopping_) return;
      if (IsFinal(status)) report_.final_status = status;
    }
    if (handlers_.on_connection) handlers_.on_connection(status);
    if (IsFinal(status)) return;
    if (!SleepUnlessStopped(backoff.NextNs(NextUniform()))) return;
  }
}

void SessionClient::OnConnected() {
  {
    absl::MutexLock lock(&mutex_);
    report_.connected = true;
    ++report_.connection_count;
    last_sequence_ = 0;
    clock_trusted_ = report_.connection_count == 1;
  }
  if (handlers_.on_connection) handlers_.on_connection(absl::OkStatus());
}

void SessionClient::OnFrame(wire::Frame frame, std::size_t bytes) {
  {
    absl::MutexLock lock(&mutex_);
    ++report_.frames_received;
    report_.bytes_received += static_cast<std::int64_t>(bytes);
    if (last_sequence_ > 0 && frame.sequence > last_sequence_ + 1) {
      report_.frames_skipped += frame.sequence - last_sequence_ - 1;
    }
    last_sequence_ = frame.sequence;
    if (frame.welcome) tick_rate_hz_ = frame.welcome->recipe.tick_rate_hz;
    if (frame.stamp) newest_stamp_ = frame.stamp;
    ApplyStamp();
  }
  if (handlers_.on_frame) handlers_.on_frame(frame);
}

void SessionClient::OnExchange(const ClockSync& sync) {
  absl::MutexLock lock(&mutex_);
  if (sync.exchange_count() >= kExchangesToTrust) clock_trusted_ = true;
  if (!clock_trusted_) return;
  clock_sync_ = sync;
  sea_clock_.SetOffset(sync.Estimate(clock_.MonotonicNs())->offset_ns);
  ApplyStamp();
}

// A stamp is only as good as the clock it is read by: the two change together.
void SessionClient::ApplyStamp() {
  if (!clock_trusted_ || !newest_stamp_ || tick_rate_hz_ == 0) return;
  sea_clock_.SetStamp(*newest_stamp_, tick_rate_hz_);
}

bool SessionClient::SleepUnlessStopped(std::int64_t duration_ns) {
  absl::MutexLock lock(&mutex_);
  mutex_.AwaitWithTimeout(absl::Condition(&stopping_), absl::Nanoseconds(duration_ns));
  return !stopping_;
}

double SessionClient::NextUniform() {
  // Linear congruential, Knuth's MMIX constants: only spreads reconnections.
  random_state_ = random_state_ * 6364136223846793005ULL + 1442695040888963407ULL;
  return static_cast<double>(random_state_ >> 11) * 0x1p-53;
}

}  // namespace onesea::client
