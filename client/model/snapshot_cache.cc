#include "client/model/snapshot_cache.h"

#include <algorithm>
#include <utility>

namespace onesea::client {

SnapshotCache::SnapshotCache(std::shared_ptr<const sea::Components> components)
    : builder_(std::move(components)) {}

std::shared_ptr<const sea::SeaSnapshot> SnapshotCache::At(SimTime time, sea::QueryDetail detail) {
  if (auto found = Find(time, detail)) return found;
  absl::MutexLock build_lock(&build_mutex_);
  if (auto found = Find(time, detail)) return found;
  auto made = builder_.At(time, detail, TakeOldest());
  Insert(made);
  return made;
}

std::shared_ptr<const sea::SeaSnapshot> SnapshotCache::Find(SimTime time, sea::QueryDetail detail) {
  absl::MutexLock lock(&mutex_);
  for (Entry& entry : entries_) {
    if (entry.snapshot == nullptr || entry.snapshot->time() != time) continue;
    if (entry.snapshot->detail() < detail) continue;
    entry.last_use = ++uses_;
    return entry.snapshot;
  }
  return nullptr;
}

// Moves the least recently used snapshot out, so that the builder, if it is the only owner then,
// can write into its storage.
std::shared_ptr<const sea::SeaSnapshot> SnapshotCache::TakeOldest() {
  absl::MutexLock lock(&mutex_);
  Entry& oldest = *std::ranges::min_element(entries_, {}, &Entry::last_use);
  oldest.last_use = 0;
  return std::exchange(oldest.snapshot, nullptr);
}

void SnapshotCache::Insert(std::shared_ptr<const sea::SeaSnapshot> snapshot) {
  absl::MutexLock lock(&mutex_);
  *std::ranges::min_element(entries_, {}, &Entry::last_use) = {std::move(snapshot), ++uses_};
}

}  // namespace onesea::client
