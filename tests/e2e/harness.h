#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "client/net/remote_server.h"
#include "client/net/session_client.h"
#include "common/base/clock.h"
#include "server/rpc/rpc_server.h"
#include "server/session/registry.h"

/// A server and what talks to it, in one process.
namespace onesea::e2e {

/// Patience of these tests: only a failure takes this long.
inline constexpr absl::Duration kPatience = absl::Seconds(20);

/// The machine's clock, which tests may put forward.
class AdvancingClock final : public Clock {
 public:
  std::int64_t MonotonicNs() const override { return SystemClock().MonotonicNs() + ahead_ns_; }
  std::int64_t UtcNs() const override { return SystemClock().UtcNs() + ahead_ns_; }
  void SleepUntil(std::int64_t deadline_ns) const override {
    SystemClock().SleepUntil(deadline_ns - ahead_ns_);
  }
  void Advance(std::int64_t span_ns) { ahead_ns_ += span_ns; }

 private:
  std::atomic<std::int64_t> ahead_ns_{0};
};

/// One JONSWAP system on one small cascade: built in milliseconds. Streams at 60 Hz.
SessionSpec SmallSession(const std::string& name);

enum class Transport { kInProcess, kLoopback };

class TestServer {
 public:
  explicit TestServer(Transport transport, const Clock& clock = SystemClock())
      : transport_(transport), clock_(clock) {
    Start();
  }
  ~TestServer() { Stop(); }

  /// A new registry; on loopback at the same port as before.
  void Start();
  void Stop(double grace_s = 1.0);

  server::Registry& registry() { return *registry_; }
  server::RpcServer& rpc() { return *rpc_; }
  int port() const { return port_; }
  /// Creates the session or fails the test.
  std::shared_ptr<server::SessionLoop> Create(SessionSpec spec);
  /// Reaches whichever server runs when it is called; nobody, when none does.
  client::ChannelFactory Connect();
  std::unique_ptr<client::RemoteServer> Remote() {
    return std::make_unique<client::RemoteServer>(Connect());
  }

 private:
  const Transport transport_;
  const Clock& clock_;
  int port_ = 0;
  absl::Mutex mutex_;
  std::unique_ptr<server::Registry> registry_;
  std::unique_ptr<server::RpcServer> rpc_;
};

/// Remembers what a SessionClient said.
class Recorder final : public client::SessionListener {
 public:
  void OnFrame(const wire::Frame& frame) override {
    absl::MutexLock lock(&mutex_);
    frames_.push_back(frame);
  }
  void OnLink(const client::LinkEvent& event) override {
    absl::MutexLock lock(&mutex_);
    links_.push_back(event);
  }

  std::vector<wire::Frame> frames() const {
    absl::MutexLock lock(&mutex_);
    return frames_;
  }
  std::vector<client::LinkEvent> links() const {
    absl::MutexLock lock(&mutex_);
    return links_;
  }
  /// False if it did not come in time.
  bool AwaitFrame(const std::function<bool(const wire::Frame&)>& wanted) const;
  bool AwaitFrames(std::size_t count) const;
  bool AwaitLink(client::LinkState state) const;

 private:
  mutable absl::Mutex mutex_;
  std::vector<wire::Frame> frames_;
  std::vector<client::LinkEvent> links_;
};

/// Polls until `condition` holds; false if it did not in time.
bool Eventually(const std::function<bool()>& condition);

}  // namespace onesea::e2e
