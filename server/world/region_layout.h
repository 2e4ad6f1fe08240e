#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "absl/status/status.h"
#include "server/world/wave_solver.h"

/// Where the regions of a session lie.
///
/// Idea: a region is asked for by size and centre. Its rectangle is snapped to multiples of
/// kRegionSideStep cells, so that it moves in whole tiles of the wire and all coarse grids stay
/// aligned, and it stays until the centre is kStayCells off. Overlapping rectangles of the same
/// kind, cell and damping become one where their bounding rectangle isn't much larger than both;
/// else they stand side by side, and their heights add. Everything follows from the asks, their
/// order and the rectangles before: the same on every machine.
namespace onesea::world {

/// What a region has beside its grid. Of merged ones the finest step, the highest rate and the
/// heaviest rain hold for all.
struct RegionTraits {
  double height_step_m = 1e-3;  ///< on the wire
  int frames_per_update = 1;    ///< on the wire
  double rain_drops_per_m2_s = 0.0;
  friend bool operator==(const RegionTraits&, const RegionTraits&) = default;
};

struct RegionAsk {
  std::uint64_t id = 0;  ///< of the asker: a body, or a place; unique among the asks
  SolverKind kind = SolverKind::kIwave;
  double cell_m = 0.5;
  int columns = 256;  ///< rounded up to multiples of kRegionSideStep
  int rows = 256;
  Vec2d centre_m;              ///< of the body that it follows, or of the place where it stands
  double damping_per_s = 0.0;  ///< beside the layer's own; [0, 10]
  RegionTraits traits = {};
};

/// A snapped ask: remembered, so that a body to and fro over a boundary moves no memory.
struct PlacedAsk {
  std::uint64_t id = 0;
  SolverKind kind = SolverKind::kIwave;
  sea::CellRect cells;
  double damping_per_s = 0.0;
  RegionTraits traits = {};
};

struct Region {
  SolverKind kind = SolverKind::kIwave;
  sea::CellRect cells;
  double damping_per_s = 0.0;
  RegionTraits traits = {};
};

/// Can the waves of one go on in the other as they are?
inline bool SameGrid(const Region& a, const Region& b) {
  return a.kind == b.kind && a.cells == b.cells && a.damping_per_s == b.damping_per_s;
}

inline constexpr int kStayCells = 24;  // of the centre; half a step is 16
/// A merged region has at most this many times the cells that its parts cover.
inline constexpr double kMergeExcessMax = 1.3;

/// InvalidArgument naming field, value and limit; the whole region must lie within
/// ±kQueryCoordinateMaxM.
absl::Status ValidateRegionAsk(const RegionAsk& ask);

/// The asks' rectangles, given those before (any order). Pre: the asks are valid.
std::vector<PlacedAsk> SnapAsks(std::span<const RegionAsk> asks, std::span<const PlacedAsk> before);

/// The regions: merged, in the order of their first asks, at most kRegionsMax of together
/// kRegionCellsMax cells (later asks go without).
std::vector<Region> LayOut(std::span<const PlacedAsk> asks);

}  // namespace onesea::world
