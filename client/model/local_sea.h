#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "client/model/snapshot_cache.h"
#include "common/base/vec.h"
#include "common/sea/components.h"
#include "common/sea/point_query.h"
#include "common/sea/terrain.h"
#include "common/wire/frame.h"

namespace onesea::client {

/// How far this process's heights are from those that the server sent, at the session's probes.
struct Drift {
  std::int64_t comparisons = 0;  ///< probe messages compared since the sea was made
  double last_m = 0.0;           ///< worst probe of the last message
  double worst_m = 0.0;          ///< worst of all messages
};

/// The session's sea, synthesised in this process from a Welcome. Heights are answered with no
/// round trip. They contain what everybody can know: the waves, lowered over the session's terrain,
/// and the water level; not the wakes, which are LocalWorld's.
///
/// A session with terrain begins incomplete: until SetTerrain() brings it, heights are those of the
/// open sea, and missing_terrain() says so.
///
/// Thread-safe: the network thread follows the session, render and game threads ask. An answer
/// belongs to one weather timeline as a whole: Follow() swaps it between two calls, never within
/// one.
///
/// Places must be finite (CHECK); people's numbers are checked by the callers, see client/embed and
/// client/app.
class LocalSea {
 public:
  /// Spacing in sea time of the moments that HeightNear() interpolates between: 1/60 s.
  static constexpr SimTime kLatticeStep{kFlicksPerSecond / 60};

  /// Builds the components (about 40 ms per wave system) and compares their hash with the server's.
  /// FailedPrecondition naming both hashes, or both versions, if this process would draw another
  /// sea.
  static absl::StatusOr<std::unique_ptr<LocalSea>> Make(const wire::Welcome& welcome);

  /// Takes over what a later Welcome says: new weather, or the same sea after a reconnection.
  /// Heights before the new weather's start are unchanged, so nothing jumps. On failure (as in
  /// Make) the earlier sea stays in force. Builds components only if the recipe changed, in the
  /// calling thread and without holding up queries.
  absl::Status Follow(const wire::Welcome& welcome);

  /// Hash of the terrain that the session has and this sea does not; 0: nothing is missing.
  std::uint64_t missing_terrain() const;
  /// From here on the sea over this terrain, if it is the missing one; else it is kept for a later
  /// welcome that names it. Cost: some 0.1 s in the calling thread; queries go on meanwhile.
  void SetTerrain(std::shared_ptr<const sea::Terrain> terrain);
  /// Of components(); null: none, or not yet.
  std::shared_ptr<const sea::Terrain> terrain() const;
  /// Mean level of the whole sea [m] at any time; heights contain it, snapshots and components
  /// don't.
  double WaterLevelAt(SimTime time) const;

  /// Height of the top sheet [m] above `place` at exactly `time`. The first call at a new time
  /// synthesises a snapshot.
  double HeightAt(Vec2d place, SimTime time) const;

  /// Height for callers that ask one place at ever new times: linear between the two moments of
  /// kLatticeStep around `time`, so that one snapshot serves 1/60 s of sea time. Differs from
  /// HeightAt() by the vertical acceleration of the surface times kLatticeStep²/8: 0.35 mm for 1 g
  /// (tests/model measures it).
  double HeightNear(Vec2d place, SimTime time) const;

  /// out[n] answers places[n] at exactly `time`; `detail` says which members are filled in. Answers
  /// the layers that are in the heights: a bit set of sea::kLayer...
  std::uint32_t Sample(std::span<const Vec2d> places, SimTime time, sea::QueryDetail detail,
                       std::span<sea::SurfaceSample> out) const;

  /// out[n] answers places[n], depth_m[n] >= 0 below z = 0: the exact sum over all waves, about
  /// 15 µs a place. Where Sample()'s height is lower than that there is no water, and the answer
  /// means nothing.
  void SampleAtDepth(std::span<const Vec2d> places, std::span<const double> depth_m, SimTime time,
                     std::span<sea::DepthSample> out) const;

  /// The waves at one moment, to ask many times, above WaterLevelAt() of it; stays valid and
  /// unchanged when the weather changes.
  std::shared_ptr<const sea::SeaSnapshot> SnapshotAt(SimTime time, sea::QueryDetail detail) const;

  /// Compares with heights that the server computed; answers the worst difference [m] and remembers
  /// it. InvalidArgument if the number of heights isn't that of the session's probes;
  /// FailedPrecondition while the terrain is missing, when there is nothing to compare.
  absl::StatusOr<double> CompareProbes(const wire::ProbeHeights& probes);
  Drift drift() const;

  /// For renderers: what Synthesiser, FoamWindow and MovingAttenuation are made from. Immutable;
  /// ask again to see new weather or terrain.
  std::shared_ptr<const sea::Components> components() const;
  /// As the last Welcome had it; its tick is of that time.
  SessionInfo session() const;
  /// Share of each weather entry of components()->recipe in the variance at `time`.
  std::vector<double> WeatherWeightsAt(SimTime time) const;
  /// 4 √variance [m].
  double SignificantWaveHeightAt(SimTime time) const;

 private:
  // One weather timeline with everything made from it.
  struct Version {
    std::shared_ptr<const sea::Components> components;
    std::shared_ptr<SnapshotCache> snapshots;
    SessionInfo session;
    std::vector<wire::WaterLevel> water_level;
    std::uint64_t missing_terrain = 0;
  };

  LocalSea() = default;
  std::shared_ptr<const Version> version() const;
  void Install(std::shared_ptr<const Version> next);

  absl::Mutex change_mutex_ ABSL_ACQUIRED_BEFORE(mutex_);  // one new version at a time
  std::shared_ptr<const sea::Terrain> terrain_ ABSL_GUARDED_BY(change_mutex_);  // the last one
  std::uint64_t terrain_hash_ ABSL_GUARDED_BY(change_mutex_) = 0;
  mutable absl::Mutex mutex_;
  std::shared_ptr<const Version> version_ ABSL_GUARDED_BY(mutex_);
  Drift drift_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace onesea::client
