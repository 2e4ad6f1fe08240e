#pragma once

#include <grpcpp/server_builder.h>

#include <memory>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "common/base/clock.h"
#include "server/rpc/watch_methods.h"
#include "server/rpc/watch_shard.h"
#include "server/stream/hub.h"

namespace onesea::server {

struct WatchOptions {
  int shards = 0;  ///< threads that send; 0: one less than the machine's cores, at least 1
};

/// Serves Watch and WatchStamps. Order: construct with the builder, BuildAndStart, Start; at the
/// end close the sessions (their viewers get the farewell), AwaitFarewells, grpc::Server::Shutdown
/// with a deadline, Stop. `hub`, `methods` and `clock` outlive it. It sets the hub's wake-up.
class WatchServer {
 public:
  WatchServer(Hub& hub, WatchMethods& methods, grpc::ServerBuilder& builder,
              WatchOptions options = {}, const Clock& clock = SystemClock());
  ~WatchServer();

  void Start();
  /// After the sessions are closed: returns when every viewer has its farewell, or after `grace_s`.
  /// grpc::Server::Shutdown ends in-process calls at once, whatever its deadline, so the farewells
  /// must be out before.
  void AwaitFarewells(double grace_s) const;
  void Stop();

  WatchStats stats() const;

 private:
  // Exactly one call of each method is waited for, on the least loaded queue: with one per queue
  // gRPC was seen to give 998 of 1000 calls to one of two queues, and a call cannot move.
  void AcceptNext(bool bidi);
  WatchShard& LeastLoaded();

  Hub& hub_;
  WatchMethods& methods_;
  std::vector<std::unique_ptr<WatchShard>> shards_;
  absl::Mutex accept_mutex_;
  bool stopping_ ABSL_GUARDED_BY(accept_mutex_) = false;
};

}  // namespace onesea::server
