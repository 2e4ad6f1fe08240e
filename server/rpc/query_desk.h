#pragma once

#include <map>
#include <memory>

#include "absl/base/thread_annotations.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "common/base/clock.h"
#include "server/query/query_engine.h"
#include "server/rpc/worker.h"
#include "server/session/registry.h"

/// Brings a query to the engine of its session. Thread-safe.
namespace onesea::server {

class QueryDesk {
 public:
  /// Both outlive it.
  QueryDesk(Registry& registry, const Clock& clock, sea::TransformKind transform)
      : registry_(registry), clock_(clock), transform_(transform) {}

  /// NotFound, or as QueryEngine::Answer; "now" is the session's present tick.
  absl::StatusOr<wire::QueryAnswer> Answer(const wire::QueryRequest& request);
  absl::StatusOr<wire::QueryAnswer> Answer(const std::shared_ptr<SessionLoop>& session,
                                           const wire::QueryRequest& request);

  /// Would it hold a gRPC thread for more than a millisecond or two?
  static bool IsHeavy(const wire::QueryRequest& request);

  /// Lets go of the engines of sessions that are gone.
  void Prune();

  std::shared_ptr<QueryEngine> EngineOf(const std::shared_ptr<SessionLoop>& session);

 private:
  // Has the snapshot of the tick that will be asked for next made before it is.
  void PrepareNext(const std::shared_ptr<SessionLoop>& session,
                   const std::shared_ptr<QueryEngine>& engine, Tick now, sea::QueryDetail detail);

  Registry& registry_;
  const Clock& clock_;
  const sea::TransformKind transform_;
  absl::Mutex mutex_;
  std::map<std::weak_ptr<SessionLoop>, std::shared_ptr<QueryEngine>, std::owner_less<>> engines_
      ABSL_GUARDED_BY(mutex_);
  Worker ahead_;  // last: what it does uses the others
};

}  // namespace onesea::server
