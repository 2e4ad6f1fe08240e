#include "server/world/wave_solver.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/limits.h"
#include "common/base/range_check.h"

namespace onesea::world {

absl::Status ValidateSolverSpec(const SolverSpec& spec) {
  for (const auto& [name, value] : {std::pair("region.columns", spec.cells.columns),
                                    std::pair("region.rows", spec.cells.rows)}) {
    if (absl::Status s = CheckInRange(name, value, kRegionSideMin, kRegionSideMax); !s.ok()) {
      return s;
    }
  }
  if (spec.cells.columns % kRegionSideStep != 0 || spec.cells.rows % kRegionSideStep != 0) {
    return absl::InvalidArgumentError(
        absl::StrCat("region of ", spec.cells.columns, " x ", spec.cells.rows,
                     " cells: sides must be multiples of ", kRegionSideStep));
  }
  if (absl::Status s =
          CheckInRange("region.cell_m", spec.cells.cell_m, kRegionCellMinM, kRegionCellMaxM);
      !s.ok()) {
    return s;
  }
  if (absl::Status s = CheckAbove("region.step_s", spec.step_s, 0.0, 1.0); !s.ok()) return s;
  if (absl::Status s = CheckInRange("region.depth_m", spec.depth_m, 0.0, kDepthMaxM); !s.ok()) {
    return s;
  }
  if (absl::Status s = CheckInRange("region.damping_per_s", spec.damping_per_s, 0.0, 10.0);
      !s.ok()) {
    return s;
  }
  const int edge_cells_max = std::min(spec.cells.columns, spec.cells.rows) / 2;
  return CheckInRange("region.edge_cells", spec.edge_cells, 0, edge_cells_max);
}

}  // namespace onesea::world
