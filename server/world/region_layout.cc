#include "server/world/region_layout.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "common/base/limits.h"
#include "common/base/range_check.h"

namespace onesea::world {
namespace {

int RoundedUp(int cells) {
  return (cells + kRegionSideStep - 1) / kRegionSideStep * kRegionSideStep;
}

std::int64_t SnappedStart(double centre_cells, int cells) {
  const double steps = (centre_cells - 0.5 * cells) / kRegionSideStep;
  return static_cast<std::int64_t>(std::floor(steps + 0.5)) * kRegionSideStep;
}

bool StillNear(double centre_cells, std::int64_t start, int cells) {
  return std::abs(centre_cells - (static_cast<double>(start) + 0.5 * cells)) <= kStayCells;
}

std::int64_t CellsOf(std::span<const Region> regions) {
  std::int64_t cells = 0;
  for (const Region& region : regions) cells += static_cast<std::int64_t>(region.cells.cells());
  return cells;
}

double Area(const sea::CellRect& cells) { return static_cast<double>(cells.cells()); }

bool CanMerge(const Region& a, const Region& b) {
  if (a.kind != b.kind || a.cells.cell_m != b.cells.cell_m || a.damping_per_s != b.damping_per_s) {
    return false;
  }
  const sea::CellRect common = sea::Intersection(a.cells, b.cells);
  if (common.cells() == 0) return false;
  const sea::CellRect whole = sea::BoundingRect(a.cells, b.cells);
  const double covered = Area(a.cells) + Area(b.cells) - Area(common);
  return whole.columns <= kRegionSideMax && whole.rows <= kRegionSideMax &&
         Area(whole) <= kMergeExcessMax * covered;
}

RegionTraits Both(const RegionTraits& a, const RegionTraits& b) {
  return {.height_step_m = std::min(a.height_step_m, b.height_step_m),
          .frames_per_update = std::min(a.frames_per_update, b.frames_per_update),
          .rain_drops_per_m2_s = std::max(a.rain_drops_per_m2_s, b.rain_drops_per_m2_s)};
}

}  // namespace

absl::Status ValidateRegionAsk(const RegionAsk& ask) {
  switch (ask.kind) {
    case SolverKind::kIwave:
    case SolverKind::kWaveEquation:
    case SolverKind::kShallowWater:
      break;
    default:
      return absl::InvalidArgumentError(
          absl::StrCat("region.kind = ", static_cast<int>(ask.kind), " is not a solver"));
  }
  if (absl::Status s = CheckInRange("region.cell_m", ask.cell_m, kRegionCellMinM, kRegionCellMaxM);
      !s.ok()) {
    return s;
  }
  for (const auto& [name, value] :
       {std::pair("region.columns", ask.columns), std::pair("region.rows", ask.rows)}) {
    if (absl::Status s = CheckInRange(name, value, kRegionSideMin, kRegionSideMax); !s.ok()) {
      return s;
    }
  }
  if (absl::Status s = CheckInRange("region.damping_per_s", ask.damping_per_s, 0.0, 10.0);
      !s.ok()) {
    return s;
  }
  const auto check_place = [&ask](const char* name, double centre_m, int cells) {
    // All of the region lies within the world, wherever it is snapped to.
    const double limit_m =
        kQueryCoordinateMaxM - (0.5 * RoundedUp(cells) + kRegionSideStep + kStayCells) * ask.cell_m;
    return CheckInRange(name, centre_m, -limit_m, limit_m);
  };
  absl::Status status = check_place("region.centre.x", ask.centre_m.x, ask.columns);
  status.Update(check_place("region.centre.y", ask.centre_m.y, ask.rows));
  return status;
}

std::vector<PlacedAsk> SnapAsks(std::span<const RegionAsk> asks,
                                std::span<const PlacedAsk> before) {
  std::vector<PlacedAsk> placed;
  placed.reserve(asks.size());
  for (const RegionAsk& ask : asks) {
    const int columns = RoundedUp(ask.columns), rows = RoundedUp(ask.rows);
    const double x = ask.centre_m.x / ask.cell_m, y = ask.centre_m.y / ask.cell_m;
    sea::CellRect cells{.west = SnappedStart(x, columns),
                        .south = SnappedStart(y, rows),
                        .columns = columns,
                        .rows = rows,
                        .cell_m = ask.cell_m};
    for (const PlacedAsk& old : before) {
      if (old.id == ask.id && old.kind == ask.kind && old.cells.cell_m == ask.cell_m &&
          old.cells.columns == columns && old.cells.rows == rows &&
          StillNear(x, old.cells.west, columns) && StillNear(y, old.cells.south, rows)) {
        cells = old.cells;
      }
    }
    placed.push_back({ask.id, ask.kind, cells, ask.damping_per_s, ask.traits});
  }
  return placed;
}

std::vector<Region> LayOut(std::span<const PlacedAsk> asks) {
  std::vector<Region> regions;
  for (const PlacedAsk& ask : asks) {
    regions.push_back({ask.kind, ask.cells, ask.damping_per_s, ask.traits});
    // A region that has grown may now reach others, so begin again until nothing changes.
    for (bool merged = true; merged;) {
      merged = false;
      for (std::size_t i = 0; i < regions.size() && !merged; ++i) {
        for (std::size_t j = i + 1; j < regions.size() && !merged; ++j) {
          if (!CanMerge(regions[i], regions[j])) continue;
          regions[i].cells = sea::BoundingRect(regions[i].cells, regions[j].cells);
          regions[i].traits = Both(regions[i].traits, regions[j].traits);
          regions.erase(regions.begin() + static_cast<std::ptrdiff_t>(j));
          merged = true;
        }
      }
    }
    if (regions.size() > kRegionsMax || CellsOf(regions) > kRegionCellsMax) regions.pop_back();
  }
  return regions;
}

}  // namespace onesea::world
