#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "client/embed/follower.h"
#include "client/model/local_world.h"
#include "client/net/session_client.h"
#include "client/net/terrain_fetcher.h"

namespace onesea::client {

struct JoinedSessionOptions {
  std::string address, session;
  std::string client_name = "onesea";
  bool world = true;  ///< wakes and bodies too: every streamed frame instead of a stamp a second
  SimTime past = {};  ///< of wakes, that world() keeps
  std::function<void(const std::string& line)> on_event = {};  ///< for people; from any thread
};

/// One session as a process follows it, for games and viewers alike: a SessionClient for frames and
/// time, a Follower for the waves, a LocalWorld for wakes and bodies, a TerrainFetcher for what
/// lies below them. A lost connection comes back by itself. Thread-safe.
class JoinedSession final : private SessionListener {
 public:
  explicit JoinedSession(JoinedSessionOptions options);
  ~JoinedSession() override;

  /// Null until the first welcome was followed; then the same sea for ever.
  LocalSea* sea() const { return follower_->sea(); }
  LocalWorld& world() { return world_; }
  const LocalWorld& world() const { return world_; }
  SeaTime Now() const { return client_->Now(); }
  LinkStats stats() const { return client_->stats(); }
  LinkEvent link() const;
  /// OK, or why this process can't show the session any more, the first reason of all.
  absl::Status status() const;

 private:
  void OnFrame(const wire::Frame& frame) override;
  void OnLink(const LinkEvent& event) override;
  void OnNewSea();
  void Tell(const std::string& line) const;
  void Fail(const absl::Status& status);

  const JoinedSessionOptions options_;
  LocalWorld world_;
  int tick_rate_hz_ = 0;  // of the newest welcome; the link's thread alone
  mutable absl::Mutex mutex_;
  absl::Status status_ ABSL_GUARDED_BY(mutex_);
  LinkEvent link_ ABSL_GUARDED_BY(mutex_);
  std::atomic<SessionClient*> drift_sink_{nullptr};  // client_, once it is constructed
  std::unique_ptr<Follower> follower_;
  std::unique_ptr<TerrainFetcher> terrain_;
  std::unique_ptr<SessionClient> client_;
};

}  // namespace onesea::client
