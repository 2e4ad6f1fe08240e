#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "client/net/backoff.h"
#include "client/net/channel.h"
#include "client/net/sea_clock.h"
#include "common/base/clock.h"
#include "common/wire/frame.h"

/// Joins a session and stays with it.
namespace onesea::client {

class WatchAttempt;

enum class LinkState : std::uint8_t {
  kConnecting,  ///< a try is under way
  kLive,        ///< the welcome has come
  kWaiting,     ///< the link is lost; the next try comes by itself
  kFailed,      ///< trying again is pointless; `status` says why
  kStopped,     ///< Stop() was called
};

struct LinkEvent {
  LinkState state = LinkState::kConnecting;
  absl::Status status;           ///< kWaiting, kFailed: why
  std::int64_t retry_in_ns = 0;  ///< kWaiting
};

/// Called on the client's own thread, one call at a time: return soon, and never destroy or Stop()
/// the client from here.
class SessionListener {
 public:
  virtual ~SessionListener() = default;
  /// In order of sequence. The first of every connection carries a welcome.
  virtual void OnFrame(const wire::Frame& frame) = 0;
  virtual void OnLink(const LinkEvent&) {}
};

struct SessionClientOptions {
  std::string session;
  bool every_frame = false;  ///< every streamed tick instead of a stamp a second
  int credit = 8;            ///< frames that may be unacknowledged, [1, 64]
  std::string client_name = "onesea";
  BackoffOptions backoff;
};

struct SeaTime {
  bool valid = false;     ///< false until the first stamp and the first exchange of clocks
  SimTime exact, render;  ///< see SeaClock
  double speed = 0.0;
  double error_bound_s =
      0.0;  ///< of the server's clock, as sea time at `speed`; grows while the link is lost
};

struct LinkStats {
  LinkState state = LinkState::kConnecting;
  std::int64_t frames = 0;         ///< received
  std::int64_t frame_bytes = 0;    ///< in them
  std::int64_t gaps = 0;           ///< times that frames were skipped for us
  std::int64_t connections = 0;    ///< that became live
  std::int64_t round_trip_ns = 0;  ///< of the best exchange of clocks
};

/// A viewer's connection: opens Watch, hands out decoded frames, acknowledges every fourth with the
/// reported drift, keeps the estimate of the server's clock, and when the link is lost comes back
/// by itself. While it is away the sea time runs on by the last stamp; the clock of a new
/// connection takes over only when it is as good as the old one was, so the return shows no jump.
///
/// All methods are thread-safe.
class SessionClient {
 public:
  /// Starts the thread. `listener` and `clock` outlive the client.
  SessionClient(ChannelFactory connect, SessionClientOptions options, SessionListener& listener,
                const Clock& clock = SystemClock());
  /// Stops.
  ~SessionClient();

  /// The sea's time now.
  SeaTime Now();
  LinkStats stats() const;

  /// The worst probe error [m] that this viewer sees, for the next acknowledgement; negative: not
  /// known.
  void ReportDrift(double drift_m) { drift_m_ = static_cast<float>(drift_m); }

  /// Ends the stream and the thread; no call of the listener follows. Idempotent.
  void Stop();

 private:
  friend class WatchAttempt;

  void Run();
  static bool WorthAnotherTry(const absl::Status& status, bool retry_not_found);
  void Tell(const LinkEvent& event);
  bool SleepUnlessStopped(std::int64_t span_ns);

  const ChannelFactory connect_;
  const SessionClientOptions options_;
  SessionListener& listener_;
  const Clock& clock_;
  std::atomic<float> drift_m_{-1.0f};

  mutable absl::Mutex mutex_;
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;
  WatchAttempt* attempt_ ABSL_GUARDED_BY(mutex_) = nullptr;  // to cancel it
  SeaClock sea_clock_ ABSL_GUARDED_BY(mutex_);
  // Error bound of the offset in use: at a local time, and growing from there.
  std::int64_t bound_ns_ ABSL_GUARDED_BY(mutex_) = 0;
  std::int64_t bound_at_ns_ ABSL_GUARDED_BY(mutex_) = 0;
  LinkStats stats_ ABSL_GUARDED_BY(mutex_);

  absl::Mutex join_mutex_;
  std::thread thread_;
};

}  // namespace onesea::client
