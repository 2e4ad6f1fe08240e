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
/// kind and cell become one where their bounding rectangle isn't much larger than both; else they
/// stand side by side, and their heights add. Everything follows from the asks, their order and
/// the rectangles before: the same on every machine.
namespace onesea::world {

struct RegionAsk {
  std::uint64_t id = 0;  ///< of the asker: a body, or a place; unique among the asks
  SolverKind kind = SolverKind::kIwave;
  double cell_m = 0.5;
  int columns = 256;  ///< rounded up to multiples of kRegionSideStep
  int rows = 256;
  Vec2d centre_m;  ///< of the body that it follows, or of the place where it stands
};

/// A snapped ask: remembered, so that a body to and fro over a boundary moves no memory.
struct PlacedAsk {
  std::uint64_t id = 0;
  SolverKind kind = SolverKind::kIwave;
  sea::CellRect cells;
};

struct Region {
  SolverKind kind = SolverKind::kIwave;
  sea::CellRect cells;
  friend bool operator==(const Region&, const Region&) = default;
};

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
