#pragma once

#include <memory>

#include "absl/status/statusor.h"
#include "common/wire/query.h"
#include "server/query/snapshot_cache.h"

/// Answers point queries of one session from shared immutable snapshots.
namespace onesea::server {

/// OK, or InvalidArgument with field, index, value and limit: coordinates, time, depths.
absl::Status ValidateQuery(const wire::QueryRequest& request, const sea::Recipe& recipe);

class QueryEngine {
 public:
  explicit QueryEngine(sea::TransformKind transform = sea::TransformKind::kOwn)
      : snapshots_(transform) {}

  /// Thread-safe. `now` is the tick that a request without a time means. Depth answers are direct
  /// sums, about 15 µs a point; points above the surface are listed as dry and get zeros.
  absl::StatusOr<wire::QueryAnswer> Answer(const std::shared_ptr<const sea::Components>& components,
                                           Tick now, const wire::QueryRequest& request);

  std::int64_t snapshots_built() const { return snapshots_.built_count(); }

 private:
  SnapshotCache snapshots_;
};

}  // namespace onesea::server
