#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "common/sea/point_query.h"

/// Snapshots of one sea at the instants that were asked for last.
///
/// Problem: a snapshot costs a synthesis (0.6 ms and more), a point in it tens of nanoseconds; and
/// many callers ask for the same instant, the present tick above all.
/// Idea: keep the few used last; whoever asks for an instant that somebody is building waits for
/// that one. A snapshot of more detail serves requests of less. Storage of what falls out is used
/// again.
namespace onesea::server {

class SnapshotCache {
 public:
  explicit SnapshotCache(sea::TransformKind transform) : transform_(transform) {}

  /// Thread-safe. `components` other than the last call's empty the cache (the weather changed).
  std::shared_ptr<const sea::SeaSnapshot> Get(
      const std::shared_ptr<const sea::Components>& components, SimTime time,
      sea::QueryDetail detail);

  /// Syntheses so far; for tests and metrics.
  std::int64_t built_count() const;

 private:
  struct Entry {
    SimTime time;
    sea::QueryDetail detail = sea::QueryDetail::kHeight;
    std::shared_ptr<const sea::SeaSnapshot> snapshot;  // null while it is being built
    std::uint64_t used = 0;
  };

  Entry* Find(SimTime time, sea::QueryDetail detail) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void ResetFor(const std::shared_ptr<const sea::Components>& components)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  std::shared_ptr<const sea::SeaSnapshot> EvictOldest() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const sea::TransformKind transform_;
  mutable absl::Mutex mutex_;
  absl::CondVar built_;
  std::shared_ptr<const sea::Components> components_ ABSL_GUARDED_BY(mutex_);
  std::size_t entries_max_ ABSL_GUARDED_BY(mutex_) = 0;
  std::vector<Entry> entries_ ABSL_GUARDED_BY(mutex_);
  std::vector<std::unique_ptr<sea::SnapshotBuilder>> idle_builders_ ABSL_GUARDED_BY(mutex_);
  std::uint64_t uses_ ABSL_GUARDED_BY(mutex_) = 0;
  std::int64_t built_count_ ABSL_GUARDED_BY(mutex_) = 0;
};

}  // namespace onesea::server
