#include "server/world/wave_equation.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/sea/constants.h"
#include "server/world/potential_solver.h"

namespace onesea::world {
namespace {

class WaveEquation final : public PotentialSolver {
 public:
  WaveEquation(const SolverSpec& spec, int substeps, double speed_m_per_s)
      : PotentialSolver(spec, substeps, speed_m_per_s) {
    const double per_depth = SubstepS() / (spec.cells.cell_m * spec.cells.cell_m);
    uniform_ = static_cast<float>(per_depth * spec.depth_m);
    if (spec.terrain != nullptr) BuildFaces(per_depth);
  }

 private:
  // Before the faces: the west face of the very first cell is read, times zero.
  static constexpr std::size_t kBefore = 16;

  void BuildFaces(double per_depth) {
    const int columns = spec().cells.columns, rows = spec().cells.rows;
    east_ = sea::AllocateZeros<float>(spec().cells.cells() + kBefore);
    north_ = sea::AllocateZeros<float>(spec().cells.cells() + kBefore);
    const auto face = [&](int column, int row, int to_column, int to_row) {
      if (!Wet(column, row) || !Wet(to_column, to_row)) return 0.0f;
      return static_cast<float>(
          per_depth * std::max(0.0, DepthAt(0.5 * (column + to_column), 0.5 * (row + to_row))));
    };
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const std::size_t at = kBefore + static_cast<std::size_t>(row) * columns + column;
        if (column + 1 < columns) east_[at] = face(column, row, column + 1, row);
        if (row + 1 < rows) north_[at] = face(column, row, column, row + 1);
      }
    }
  }

  HeightPass Pass(WavePlane* phi) const {
    HeightPass pass{.psi = phi, .uniform = uniform_};
    if (east_ != nullptr) {
      pass.east = east_.get() + kBefore;
      pass.north = north_.get() + kBefore;
    }
    return pass;
  }

  void Advance(const GridPass& grid, const PotentialPass& potential) override {
    AdvanceBoth(grid, potential, Pass(potential.phi));
  }

  void PotentialChanged(WavePlane&) override {}

  void Outflow(std::span<float> m_per_s) const override {
    const int columns = spec().cells.columns, rows = spec().cells.rows;
    const auto per_step = static_cast<float>(1.0 / SubstepS());
    float west[kRegionSideMax + 1];  // what enters each cell from the west; 0 at both ends
    west[0] = west[columns] = 0.0f;
    std::fill(m_per_s.begin(), m_per_s.end(), 0.0f);
    for (int row = 0; row < rows; ++row) {
      const std::size_t at = static_cast<std::size_t>(row) * columns;
      const float* here = phi().Row(row);
      const float* north = phi().Row(row + 1);
      const bool last = row + 1 == rows;
      for (int n = 1; n < columns; ++n) {
        const float face = east_ == nullptr ? uniform_ : east_[kBefore + at + n - 1];
        west[n] = face * (here[n] - here[n - 1]);
      }
      for (int n = 0; n < columns; ++n) m_per_s[at + n] += per_step * (west[n] - west[n + 1]);
      for (int n = 0; n < columns && !last; ++n) {
        const float face = north_ == nullptr ? uniform_ : north_[kBefore + at + n];
        const float flow = per_step * face * (north[n] - here[n]);
        m_per_s[at + n] -= flow;
        m_per_s[at + columns + n] += flow;
      }
    }
  }

  float uniform_ = 0.0f;          // sub-step * d / cell²
  sea::FloatArray east_, north_;  // the same at each face, from kBefore on; null: uniform
};

}  // namespace

absl::StatusOr<std::unique_ptr<WaveSolver>> MakeWaveEquation(const SolverSpec& spec) {
  ONESEA_RETURN_IF_ERROR(ValidateSolverSpec(spec));
  const double depth_m = GreatestDepth(spec);
  if (!(depth_m > 0.0)) {
    return absl::InvalidArgumentError(
        "region.depth_m = 0: the wave equation needs a depth, or a terrain under water");
  }
  const double speed = std::sqrt(sea::kGravity * depth_m);
  ONESEA_ASSIGN_OR_RETURN(const int substeps,
                          SubstepsFor(spec, std::sqrt(8.0) * speed / spec.cells.cell_m));
  return std::make_unique<WaveEquation>(spec, substeps, speed);
}

}  // namespace onesea::world
