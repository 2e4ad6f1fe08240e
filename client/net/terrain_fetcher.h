#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "client/net/backoff.h"
#include "client/net/channel.h"
#include "common/base/clock.h"
#include "common/sea/terrain.h"

namespace onesea::client {

/// Fetches the terrain of a session on a thread of its own, so that nothing else waits for it: up
/// to 64 MB of samples.
///
/// A lost connection is tried again, with growing pauses. What trying again can't cure (bytes that
/// are no terrain, another hash than the wanted one, a session without terrain) is told to
/// `on_failed`, and the next Want() tries anew.
class TerrainFetcher {
 public:
  struct Events {
    std::function<void(std::shared_ptr<const sea::Terrain>)> on_terrain;  ///< the wanted one
    std::function<void(const absl::Status&)> on_failed;
  };

  /// The events come from the fetcher's thread, which starts with the first Want().
  TerrainFetcher(ChannelFactory connect, std::string session, Events events,
                 BackoffOptions backoff = {}, const Clock& clock = SystemClock());
  /// Stops.
  ~TerrainFetcher();

  /// Cancels the call that is under way; no event follows. Idempotent, but never from an event.
  void Stop();

  /// The terrain with this hash is wanted, 0: none any more. Any thread; returns at once. Nothing
  /// happens if it is under way already.
  void Want(std::uint64_t hash);

 private:
  struct Call;

  void Run();
  absl::StatusOr<sea::Terrain> Fetch(std::uint64_t hash);
  void FetchUntilDone(std::uint64_t hash);
  bool IsWanted(std::uint64_t hash) const;

  const ChannelFactory connect_;
  const std::string session_;
  const Events events_;
  const BackoffOptions backoff_;
  const Clock& clock_;
  mutable absl::Mutex mutex_;
  std::uint64_t wanted_ ABSL_GUARDED_BY(mutex_) = 0;
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;
  Call* call_ ABSL_GUARDED_BY(mutex_) = nullptr;  // to cancel it
  std::thread thread_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace onesea::client
