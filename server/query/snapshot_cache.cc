#include "server/query/snapshot_cache.h"

#include <algorithm>
#include <utility>

#include "common/sea/query_records.h"

namespace onesea::server {
namespace {

// Enough for the present tick, the one before and a few instants that clients return to; at the
// default grids an entry takes 4.3 MB, with velocities 8.6 MB.
constexpr std::size_t kEntriesMax = 6;
constexpr std::size_t kEntriesMin = 2;
constexpr std::size_t kBytesMax = 64 << 20;
constexpr std::size_t kIdleBuildersMax = 2;

std::size_t EntriesFor(const sea::Components& components) {
  std::size_t bytes = 1;
  for (const sea::CascadeComponents& cascade : components.cascades) {
    bytes += 2 * sizeof(std::uint32_t) * sea::RecordWords(cascade.cascade.query_grid_size);
  }
  return std::clamp(kBytesMax / bytes, kEntriesMin, kEntriesMax);
}

}  // namespace

std::shared_ptr<const sea::SeaSnapshot> SnapshotCache::Get(
    const std::shared_ptr<const sea::Components>& components, SimTime time,
    sea::QueryDetail detail) {
  std::unique_ptr<sea::SnapshotBuilder> builder;
  std::shared_ptr<const sea::SeaSnapshot> recycle;
  {
    absl::MutexLock lock(&mutex_);
    if (components_ != components) ResetFor(components);
    while (Entry* entry = Find(time, detail)) {
      entry->used = ++uses_;
      if (entry->snapshot != nullptr) return entry->snapshot;
      built_.Wait(&mutex_);
      if (components_ != components) ResetFor(components);
    }
    if (entries_.size() >= entries_max_) recycle = EvictOldest();
    entries_.push_back({time, detail, nullptr, ++uses_});
    if (!idle_builders_.empty()) {
      builder = std::move(idle_builders_.back());
      idle_builders_.pop_back();
    }
  }
  if (builder == nullptr) builder = std::make_unique<sea::SnapshotBuilder>(components, transform_);
  std::shared_ptr<const sea::SeaSnapshot> snapshot = builder->At(time, detail, std::move(recycle));

  absl::MutexLock lock(&mutex_);
  ++built_count_;
  built_.SignalAll();
  if (components_ != components) return snapshot;  // the weather changed meanwhile
  for (Entry& entry : entries_) {
    if (entry.time == time && entry.detail == detail) entry.snapshot = snapshot;
  }
  if (idle_builders_.size() < kIdleBuildersMax) idle_builders_.push_back(std::move(builder));
  return snapshot;
}

std::int64_t SnapshotCache::built_count() const {
  absl::MutexLock lock(&mutex_);
  return built_count_;
}

SnapshotCache::Entry* SnapshotCache::Find(SimTime time, sea::QueryDetail detail) {
  for (Entry& entry : entries_) {
    if (entry.time == time && entry.detail >= detail) return &entry;
  }
  return nullptr;
}

void SnapshotCache::ResetFor(const std::shared_ptr<const sea::Components>& components) {
  components_ = components;
  entries_max_ = EntriesFor(*components);
  entries_.clear();
  idle_builders_.clear();
  built_.SignalAll();
}

// The oldest that is built; its storage may serve again. Those being built stay, so the cache can
// grow by the number of threads for a moment.
std::shared_ptr<const sea::SeaSnapshot> SnapshotCache::EvictOldest() {
  auto oldest = entries_.end();
  for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
    if (entry->snapshot == nullptr) continue;
    if (oldest == entries_.end() || entry->used < oldest->used) oldest = entry;
  }
  if (oldest == entries_.end()) return nullptr;
  std::shared_ptr<const sea::SeaSnapshot> snapshot = std::move(oldest->snapshot);
  entries_.erase(oldest);
  return snapshot;
}

}  // namespace onesea::server
