#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <span>

#include "absl/status/statusor.h"
#include "common/sea/interaction_past.h"
#include "common/wire/query.h"
#include "common/wire/world_spec.h"
#include "server/query/snapshot_cache.h"

/// Answers point queries of one session from shared immutable snapshots.
namespace onesea::server {

/// OK, or InvalidArgument with field, index, value and limit: coordinates, time, depths.
absl::Status ValidateQuery(const wire::QueryRequest& request, const sea::Recipe& recipe);

/// What a session's water has beside the spectral sea.
struct QueryWorld {
  /// The layer at tick `now`, or null, and what is kept of the time before, or null: added to
  /// answers for moments from the oldest of it on, 20 ns a point and region (60 between snapshots).
  /// Depth answers are without it.
  const sea::InteractionSnapshot* interaction = nullptr;
  const sea::InteractionPast* past = nullptr;
  std::span<const wire::WaterLevel> water_level{};
};

class QueryEngine {
 public:
  explicit QueryEngine(sea::TransformKind transform = sea::TransformKind::kOwn)
      : snapshots_(transform) {}

  /// Thread-safe. `now` is the tick that a request without a time means. Depth answers are direct
  /// sums, about 15 µs a point. Points on land that no water covers, and those asked for above the
  /// surface, are listed as dry and get no depth answer. `world` adds to the spectral sea;
  /// `layers` says what did.
  absl::StatusOr<wire::QueryAnswer> Answer(const std::shared_ptr<const sea::Components>& components,
                                           Tick now, const wire::QueryRequest& request,
                                           const QueryWorld& world = {});

  /// Thread-safe. Notes that the present tick `now` was asked for; guesses when it will be next:
  /// as many ticks later as this was after the last time. Nothing if the tick was noted already or
  /// those who ask are slower than kStrideMax. Whoever asks SnapshotOf() that tick spares the next
  /// of them the synthesis.
  std::optional<Tick> NoteAsked(Tick now);
  static constexpr Tick kStrideMax = 8;

  /// Thread-safe. What answers for this tick are read from; made here if nobody asked yet.
  std::shared_ptr<const sea::SeaSnapshot> SnapshotOf(
      const std::shared_ptr<const sea::Components>& components, Tick tick,
      sea::QueryDetail detail = sea::QueryDetail::kHeight);

  std::int64_t snapshots_built() const { return snapshots_.built_count(); }

 private:
  SnapshotCache snapshots_;
  std::atomic<Tick> last_asked_{-kStrideMax - 1};  // the first tick is 0
};

}  // namespace onesea::server
