#include "server/world/iwave.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/check.h"
#include "common/base/real_math.h"
#include "common/sea/constants.h"
#include "server/world/iwave_operator.h"
#include "server/world/potential_solver.h"

namespace onesea::world {
namespace {

double StepNumber(const SolverSpec& spec, double substep_s) {
  return sea::kGravity * substep_s * substep_s / spec.cells.cell_m;
}

// Speed of waves twice as long as the border: shorter ones fade in it, longer ones reach its rim.
double BorderSpeed(const SolverSpec& spec, double depth_m) {
  const double k = sea::kPi / (std::max(spec.edge_cells, 1) * spec.cells.cell_m);
  const double tanh = std::isinf(depth_m) ? 1.0 : real::Tanh(k * depth_m);
  return std::sqrt(sea::kGravity * tanh / k);
}

// One depth, borders all round: T commutes with the gradient, so one application of it serves both
// directions.
class FlatIwave final : public PotentialSolver {
 public:
  FlatIwave(const SolverSpec& spec, int substeps, double depth_m)
      : PotentialSolver(spec, substeps, BorderSpeed(spec, depth_m)),
        integral_(spec.cells.columns, spec.cells.rows,
                  DesignIwave(depth_m / spec.cells.cell_m, StepNumber(spec, SubstepS()),
                              IwaveLevelsFor(spec.cells.columns, spec.cells.rows))),
        psi_(spec.cells.columns, spec.cells.rows) {}

 private:
  void Advance(const GridPass& grid, const PotentialPass& potential) override {
    AdvancePotential(grid, potential);
    integral_.Apply(*potential.phi, psi_);
    AdvanceHeight(grid,
                  {.psi = &psi_, .uniform = static_cast<float>(SubstepS() / spec().cells.cell_m)});
  }

  void PotentialChanged(WavePlane& phi) override { integral_.Apply(phi, psi_); }

  void Outflow(std::span<float> m_per_s) const override {
    const int columns = spec().cells.columns, rows = spec().cells.rows;
    const auto scale = static_cast<float>(1.0 / spec().cells.cell_m);
    for (int row = 0; row < rows; ++row) {
      float* out = m_per_s.data() + static_cast<std::size_t>(row) * columns;
      const float* here = psi_.Row(row);
      const float* south = psi_.Row(std::max(row - 1, 0));
      const float* north = psi_.Row(std::min(row + 1, rows - 1));
      for (int n = 1; n + 1 < columns; ++n) {
        out[n] = scale * (4.0f * here[n] - (here[n - 1] + here[n + 1] + south[n] + north[n]));
      }
      for (const int n : {0, columns - 1}) {
        const float beside = here[n == 0 ? 1 : n - 1];
        out[n] = scale * (3.0f * here[n] - (beside + south[n] + north[n]));
      }
    }
  }

  FlatIntegral integral_;
  WavePlane psi_;  // ∫φ dz [m²/s cells]
};

FacePlanes MakeFaces(const sea::CellRect& cells) {
  return {WavePlane(cells.columns, cells.rows), WavePlane(cells.columns, cells.rows)};
}

// Flow through faces, each with the depth at its middle. Also for a closed basin, whose walls the
// convolution over a flat bottom would not see.
class FacesIwave final : public PotentialSolver {
 public:
  FacesIwave(const SolverSpec& spec, int substeps, double depth_m)
      : PotentialSolver(spec, substeps, BorderSpeed(spec, depth_m)),
        open_(MakeFaces(spec.cells)),
        difference_(MakeFaces(spec.cells)),
        flow_(MakeFaces(spec.cells)) {
    const FacePlanes depth{FaceDepths(0.5, 0.0), FaceDepths(0.0, 0.5)};
    double least = kIwaveDeepCells, greatest = 0.0;  // of water
    for (int row = 0; row < spec.cells.rows; ++row) {
      for (int column = 0; column < spec.cells.columns; ++column) {
        open_.x.Row(row)[column] = Open(column, row, 0.5, 0.0) ? 1.0f : 0.0f;
        open_.y.Row(row)[column] = Open(column, row, 0.0, 0.5) ? 1.0f : 0.0f;
        for (const double cells : {depth.x.Row(row)[column], depth.y.Row(row)[column]}) {
          greatest = std::max(greatest, cells);
          if (cells > 0.0) least = std::min(least, cells);
        }
      }
    }
    const IwaveNodes nodes = DesignIwaveNodes(least, greatest, StepNumber(spec, SubstepS()),
                                              IwaveLevelsFor(spec.cells.columns, spec.cells.rows));
    integral_x_ = std::make_unique<TerrainIntegral>(depth.x, nodes);
    integral_y_ = std::make_unique<TerrainIntegral>(depth.y, nodes);
  }

 private:
  bool Open(int column, int row, double to_east, double to_north) const {
    const int east = column + (to_east > 0.0), north = row + (to_north > 0.0);
    return east < spec().cells.columns && north < spec().cells.rows && Wet(column, row) &&
           Wet(east, north);
  }

  // At the middle of each face. Faces of the rim carry nothing, but their depth weighs in the
  // coarser levels.
  WavePlane FaceDepths(double to_east, double to_north) const {
    const sea::CellRect& cells = spec().cells;
    const bool deep = spec().terrain == nullptr && spec().depth_m == 0.0;
    WavePlane depths(cells.columns, cells.rows);
    for (int row = 0; row < cells.rows; ++row) {
      for (int column = 0; column < cells.columns; ++column) {
        const bool rim =
            column + (to_east > 0.0) >= cells.columns || row + (to_north > 0.0) >= cells.rows;
        if (!rim && !Open(column, row, to_east, to_north)) continue;
        const double depth_m = DepthAt(column + to_east, row + to_north);
        depths.Row(row)[column] = static_cast<float>(
            deep ? kIwaveDeepCells : std::clamp(depth_m / cells.cell_m, 0.0, kIwaveDeepCells));
      }
    }
    return depths;
  }

  void Advance(const GridPass& grid, const PotentialPass& potential) override {
    AdvancePotential(grid, potential);
    PotentialChanged(*potential.phi);
    AdvanceHeightByFlow(grid, flow_, open_, static_cast<float>(SubstepS() / spec().cells.cell_m));
  }

  void PotentialChanged(WavePlane& phi) override {
    FaceDifferences(phi, open_, difference_);
    integral_x_->Apply(difference_.x, flow_.x);
    integral_y_->Apply(difference_.y, flow_.y);
  }

  void Outflow(std::span<float> m_per_s) const override {
    const int columns = spec().cells.columns, rows = spec().cells.rows;
    const auto scale = static_cast<float>(1.0 / spec().cells.cell_m);
    for (int row = 0; row < rows; ++row) {
      float* out = m_per_s.data() + static_cast<std::size_t>(row) * columns;
      // The margins, west and south of the first cells, are zero.
      const float *x = flow_.x.Row(row), *open_x = open_.x.Row(row);
      const float *y = flow_.y.Row(row), *open_y = open_.y.Row(row);
      const float *south = flow_.y.Row(row - 1), *open_south = open_.y.Row(row - 1);
      for (int n = 0; n < columns; ++n) {
        out[n] = scale * (x[n - 1] * open_x[n - 1] - x[n] * open_x[n] + south[n] * open_south[n] -
                          y[n] * open_y[n]);
      }
    }
  }

  FacePlanes open_;        // 1, or 0 where land or the rim closes the face
  FacePlanes difference_;  // of φ
  FacePlanes flow_;        // ∫u dz through the face, in cells
  std::unique_ptr<TerrainIntegral> integral_x_, integral_y_;
};

}  // namespace

absl::StatusOr<std::unique_ptr<WaveSolver>> MakeIwave(const SolverSpec& spec) {
  ONESEA_RETURN_IF_ERROR(ValidateSolverSpec(spec));
  double depth_m = GreatestDepth(spec);
  if (spec.terrain != nullptr && depth_m == 0.0) {
    return absl::InvalidArgumentError("region.terrain: no water in the region");
  }
  if (depth_m == 0.0) depth_m = std::numeric_limits<double>::infinity();
  if (depth_m > kIwaveDeepCells * spec.cells.cell_m) {
    depth_m = std::numeric_limits<double>::infinity();
  }
  ONESEA_ASSIGN_OR_RETURN(
      const int substeps,
      SubstepsFor(spec, std::sqrt(sea::kGravity * kIwaveSymbolMax / spec.cells.cell_m)));
  if (spec.terrain != nullptr || spec.edge_cells == 0)
    return std::make_unique<FacesIwave>(spec, substeps, depth_m);
  return std::make_unique<FlatIwave>(spec, substeps, depth_m);
}

}  // namespace onesea::world
