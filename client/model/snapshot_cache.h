#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "common/sea/point_query.h"

namespace onesea::client {

/// The snapshots of one sea that were asked for last, so that a render thread and several game
/// threads which look at the same moments share the synthesis. Thread-safe.
///
/// A hit costs a lock and a scan of kSnapshotsHeld entries. A miss costs one synthesis (about 0.6
/// ms for heights with the default cascades); misses of several threads queue, and one that waited
/// for its own moment finds it made.
class SnapshotCache {
 public:
  /// Two moments of the interpolation lattice for "now", one for rendering, one for a game's step,
  /// and their predecessors, which somebody may still be reading.
  static constexpr int kSnapshotsHeld = 8;

  explicit SnapshotCache(std::shared_ptr<const sea::Components> components);

  /// A snapshot at exactly `time` with at least `detail`.
  std::shared_ptr<const sea::SeaSnapshot> At(SimTime time, sea::QueryDetail detail);

 private:
  struct Entry {
    std::shared_ptr<const sea::SeaSnapshot> snapshot;
    std::uint64_t last_use = 0;
  };

  std::shared_ptr<const sea::SeaSnapshot> Find(SimTime time, sea::QueryDetail detail);
  std::shared_ptr<const sea::SeaSnapshot> TakeOldest();
  void Insert(std::shared_ptr<const sea::SeaSnapshot> snapshot);

  absl::Mutex build_mutex_ ABSL_ACQUIRED_BEFORE(mutex_);
  sea::SnapshotBuilder builder_ ABSL_GUARDED_BY(build_mutex_);
  absl::Mutex mutex_;
  std::array<Entry, kSnapshotsHeld> entries_ ABSL_GUARDED_BY(mutex_);
  std::uint64_t uses_ ABSL_GUARDED_BY(mutex_) = 0;
};

}  // namespace onesea::client
