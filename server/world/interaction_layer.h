#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "common/base/vec.h"
#include "common/sea/interaction_field.h"
#include "common/sea/terrain.h"
#include "server/world/interaction_grid.h"
#include "server/world/region_layout.h"

/// The interaction layer of a session: regions of waves that add to the spectral sea.
///
/// A tick: Place(asks) where bodies and people want regions; deposits; Step(); Snapshot().
///
/// A region that moves, grows, merges or splits is a new one that adopts the waves of the old ones,
/// each cell's once: that happens every few seconds and costs a millisecond or so (over terrain
/// 20 ms), so no wrap-around storage is needed. What leaves a region is absorbed by its border.
///
/// Regions that overlap without merging stand side by side: heights add, which is right since the
/// equations are linear, and each deposit enters exactly one of them, that in which its place lies
/// furthest from the border. (kShallowWater's shore is not linear: give it disjoint places.)
///
/// iWave, the dearest, steps only every second or third tick where its shortest waves are slow
/// enough (cells of 0.35 m and more at 60 Hz); in between its heights go over linearly, sources
/// wait for the next step, and velocities are those of up to two ticks ahead. Those of the other
/// solvers are up to two ticks old.
///
/// Deterministic: same asks, deposits and order, same bits. Not thread-safe; snapshots are.
namespace onesea::world {

struct InteractionOptions {
  double step_s = 1.0 / 60.0;
  double depth_m = 0.0;  ///< of regions beside terrain; 0 = deep
  std::shared_ptr<const sea::Terrain> terrain = {};
  double damping_per_s = 0.02;  ///< of every region, beside what is asked for
  int edge_cells = 16;
  FoamOptions foam = {};
};

/// Everything that the next step depends on.
struct InteractionState {
  std::int64_t steps = 0;
  std::vector<PlacedAsk> asks;
  std::vector<RegionState> regions;
};

class InteractionLayer {
 public:
  explicit InteractionLayer(InteractionOptions options);
  ~InteractionLayer();

  /// Lays out the regions anew; waves, foam and deposits go over to them. Asks that are invalid
  /// or whose solver can't be made (no water there, too many sub-steps) go without a region: the
  /// first such error is returned, the others are placed all the same. Cheap where nothing changes.
  absl::Status Place(std::span<const RegionAsk> asks);

  std::vector<Region> regions() const;

  /// The forcing of the region in which this place lies furthest from the border, or null. Valid
  /// until the next Place.
  RegionForcing* ForcingAt(Vec2d place);

  /// Calls `fill` with each region's forcing.
  void ForEachForcing(const std::function<void(RegionForcing&)>& fill);

  /// Adds water [m³] over a disc as (1 - r²/R²)², R at least 1.5 cells; what is added is
  /// `volume_m3` exactly but for rounding. False: no region there.
  bool AddSource(Vec2d place, double radius_m, double volume_m3);
  /// Presses with `force_n` on the surface during the next step, spread likewise.
  bool AddPressure(Vec2d place, double radius_m, double force_n);
  /// Holds the surface at `rest_height_m` over a disc during the next step.
  bool AddSolid(Vec2d place, double radius_m, double rest_height_m);
  /// Foam that turbulence makes: `share` of the surface at once, spread likewise.
  bool AddFoam(Vec2d place, double radius_m, double share);

  /// Advances all regions by step_s and forgets the deposits. A region whose heights are no longer
  /// numbers of this world (forced beyond all measure) is calm again.
  void Step();
  int resets() const { return resets_; }  ///< how often that happened

  /// Adds what hulls feel of the layer at these places: the heights plus the pressure heads put in
  /// for the next step, and the velocities of the last Snapshot().
  /// Cost: 25 ns a place and region, 40 where hulls press.
  void AddFelt(std::span<const Vec2d> places, std::span<sea::InteractionFelt> sum) const;

  /// Cost: 20 µs a region of 256 x 256, every third tick another 100 for the velocities.
  std::shared_ptr<const sea::InteractionSnapshot> Snapshot(std::int64_t tick);

  InteractionState State() const;
  /// InvalidArgument: regions that cannot be made or states of another size. The layer is then
  /// empty.
  absl::Status Restore(const InteractionState& state);
  std::uint64_t Hash() const;

 private:
  absl::StatusOr<std::unique_ptr<InteractionGrid>> MakeGrid(const Region& region) const;
  InteractionGrid* BestAt(Vec2d place);
  /// Moves the waves of grids that are no more to those that are.
  void AdoptFrom(std::vector<std::unique_ptr<InteractionGrid>>& dropped);

  InteractionOptions options_;
  std::int64_t steps_ = 0;
  int resets_ = 0;
  std::vector<PlacedAsk> asks_;
  std::vector<std::unique_ptr<InteractionGrid>> grids_;
};

}  // namespace onesea::world
