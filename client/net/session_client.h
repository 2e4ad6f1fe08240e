#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "client/net/backoff.h"
#include "client/net/channel.h"
#include "client/net/clock_sync.h"
#include "client/net/sea_clock.h"
#include "common/base/clock.h"
#include "common/wire/frame.h"

/// Following a session: the Watch stream, its acknowledgements, the server's clock, and coming back
/// after a lost connection.
namespace onesea::client {

struct SessionClientOptions {
  std::string session = {};
  std::string client_name = "onesea";
  bool every_frame = false;  ///< every streamed frame, not just a stamp a second
  int credit = 8;            ///< unacknowledged frames allowed, [1, 64]
};

struct SessionHandlers {
  /// Every frame, in order. From the client's own thread: what is slow here delays the next frame.
  std::function<void(const wire::Frame&)> on_frame = nullptr;
  /// The connection came (OK) or went (why); after a final status nothing follows.
  std::function<void(const absl::Status&)> on_connection = nullptr;
};

struct ConnectionReport {
  bool connected = false;
  absl::Status final_status;          ///< not OK: given up, e.g. the session does not exist
  std::int64_t connection_count = 0;  ///< successful ones
  std::int64_t frames_received = 0;
  std::int64_t frames_skipped = 0;  ///< gaps in the sequence
  std::int64_t bytes_received = 0;  ///< of frames
  std::optional<ClockEstimate> clock;
};

/// Connecting → watching → (lost → connecting)* → ended. Only the client's own thread moves it.
/// It ends by the destructor, or by an answer that waiting can't mend (NotFound, InvalidArgument,
/// FailedPrecondition, Unimplemented, permission); everything else is tried again, with Backoff.
///
/// While connecting again, SeaTime() goes on by the last known stamp and clock. After a
/// reconnection the clock of the new connection takes over once kExchangesToTrust exchanges are
/// done; the very first connection trusts the first exchange, so that joining takes one round trip.
class SessionClient {
 public:
  static constexpr std::size_t kExchangesToTrust = 4;
  static constexpr std::int64_t kSyncPeriodNs = 1'000'000'000;
  static constexpr int kFramesPerAck = 4;

  SessionClient(const std::string& address, SessionClientOptions options, SessionHandlers handlers,
                const Clock& clock = SystemClock());
  SessionClient(std::shared_ptr<grpc::Channel> channel, std::string address,
                SessionClientOptions options, SessionHandlers handlers,
                const Clock& clock = SystemClock());
  /// Leaves the session and waits for the thread; no handler is called afterwards.
  ~SessionClient();

  /// The session's time now; nothing before the first stamp and exchange of clocks. Never goes back
  /// while the session goes on (SeaClock). Thread-safe.
  std::optional<SimTime> SeaTime() const;
  /// Sea seconds per real second now.
  double Speed() const;

  ConnectionReport Report() const;

  /// Sent with the next acknowledgement: this process's own worst probe error [m].
  void SetDrift(double drift_m) { drift_m_ = static_cast<float>(drift_m); }

 private:
  class Connection;

  void Run();
  void OnFrame(wire::Frame frame, std::size_t bytes);
  void OnConnected();
  void OnExchange(const ClockSync& sync);
  void ApplyStamp() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  bool SleepUnlessStopped(std::int64_t duration_ns);
  double NextUniform();

  const std::shared_ptr<grpc::Channel> channel_;
  const std::string address_;
  const SessionClientOptions options_;
  const SessionHandlers handlers_;
  const Clock& clock_;
  std::atomic<float> drift_m_{-1.0f};
  std::uint64_t random_state_;

  mutable absl::Mutex mutex_;
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;
  Connection* connection_ ABSL_GUARDED_BY(mutex_) = nullptr;  // for Cancel()
  mutable SeaClock sea_clock_ ABSL_GUARDED_BY(mutex_);
  ClockSync clock_sync_ ABSL_GUARDED_BY(mutex_);  // the one in force
  ConnectionReport report_ ABSL_GUARDED_BY(mutex_);
  std::int64_t last_sequence_ ABSL_GUARDED_BY(mutex_) = 0;
  int tick_rate_hz_ ABSL_GUARDED_BY(mutex_) = 0;
  std::optional<wire::Stamp> newest_stamp_ ABSL_GUARDED_BY(mutex_);
  bool clock_trusted_ ABSL_GUARDED_BY(mutex_) = true;
  std::thread thread_;
};

}  // namespace onesea::client
