#include "server/world/potential_solver.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/base/real_math.h"
#include "common/sea/constants.h"

namespace onesea::world {
namespace {

// ∫σ dx / c over the border is a third of this. More would reflect long waves by itself: a border
// that is short beside the wave is best when it is weak and its rim matches.
constexpr double kBorderStrength = 3.0;
// ω times sub-step at most; 2 would be the limit of stability.
constexpr double kOmegaStepMax = 1.8;

sea::FloatArray BorderFactors(int cells, int edge_cells, double cell_m, double speed_m_per_s,
                              double step_s) {
  sea::FloatArray keep = sea::AllocateZeros<float>(static_cast<std::size_t>(cells));
  for (int n = 0; n < cells; ++n) {
    const int from_rim = std::min(n, cells - 1 - n);
    double sigma_per_s = 0.0;
    if (from_rim < edge_cells) {
      const double in = (edge_cells - from_rim - 0.5) / edge_cells;
      sigma_per_s = kBorderStrength * speed_m_per_s / (edge_cells * cell_m) * in * in;
    }
    keep[n] = static_cast<float>(real::Exp(-sigma_per_s * step_s));
  }
  return keep;
}

}  // namespace

double GreatestDepth(const SolverSpec& spec) {
  if (spec.terrain == nullptr) return spec.depth_m;
  double greatest = 0.0;
  for (int row = 0; row < spec.cells.rows; ++row) {
    for (int column = 0; column < spec.cells.columns; ++column) {
      greatest = std::max(greatest, -spec.terrain->ElevationAt(spec.cells.PlaceOf(
                                        spec.cells.west + column, spec.cells.south + row)));
    }
  }
  return greatest;
}

absl::StatusOr<int> SubstepsFor(const SolverSpec& spec, double omega_max_rad_per_s) {
  const double count = std::ceil(omega_max_rad_per_s * spec.step_s / kOmegaStepMax);
  if (count <= kSubstepsMax) return std::max(1, static_cast<int>(count));
  return absl::InvalidArgumentError(
      absl::StrCat("region.cell_m = ", spec.cells.cell_m, ": waves of ", omega_max_rad_per_s,
                   " rad/s on these cells need ", count,
                   " sub-steps in region.step_s = ", spec.step_s, ", at most ", kSubstepsMax));
}

PotentialSolver::PotentialSolver(const SolverSpec& spec, int substeps, double border_speed_m_per_s)
    : spec_(spec),
      cells_(spec.cells.cells()),
      substeps_(substeps),
      height_(sea::AllocateZeros<float>(cells_)),
      phi_(spec.cells.columns, spec.cells.rows),
      keep_x_(BorderFactors(spec.cells.columns, spec.edge_cells, spec.cells.cell_m,
                            border_speed_m_per_s, SubstepS())),
      keep_y_(BorderFactors(spec.cells.rows, spec.edge_cells, spec.cells.cell_m,
                            border_speed_m_per_s, SubstepS())) {
  if (spec.edge_cells > 0) {
    rim_keep_ =
        static_cast<float>(1.0 / (1.0 + border_speed_m_per_s * SubstepS() / spec.cells.cell_m));
  }
  if (spec_.terrain == nullptr) return;
  wet_.reserve(cells_);
  for (int row = 0; row < spec_.cells.rows; ++row) {
    for (int column = 0; column < spec_.cells.columns; ++column) {
      wet_.push_back(DepthAt(column, row) > 0.0);
    }
  }
  if (std::find(wet_.begin(), wet_.end(), 0) == wet_.end()) wet_.clear();
}

double PotentialSolver::DepthAt(double column, double row) const {
  if (spec_.terrain == nullptr) return spec_.depth_m;
  return -spec_.terrain->ElevationAt(
      {(static_cast<double>(spec_.cells.west) + column) * spec_.cells.cell_m,
       (static_cast<double>(spec_.cells.south) + row) * spec_.cells.cell_m});
}

GridPass PotentialSolver::Grid() {
  return {.columns = spec_.cells.columns,
          .rows = spec_.cells.rows,
          .height = height_.get(),
          .keep_x = keep_x_.get(),
          .keep_y = keep_y_.get(),
          .border = spec_.edge_cells};
}

void PotentialSolver::Step(const StepForcing& forcing) {
  for (const auto span :
       {forcing.source_m, forcing.pressure_head_m, forcing.solid, forcing.rest_height_m}) {
    ONESEA_CHECK(span.empty() || span.size() == cells_) << span.size() << " of " << cells_;
  }
  AddSource(forcing.source_m);
  const double step_s = SubstepS();
  const PotentialPass potential{
      .g_dt = static_cast<float>(sea::kGravity * step_s),
      .keep = static_cast<float>(real::Exp(-spec_.damping_per_s * step_s)),
      .pressure_head = forcing.pressure_head_m.empty() ? nullptr : forcing.pressure_head_m.data(),
      .phi = &phi_};
  for (int n = 0; n < substeps_; ++n) {
    Advance(Grid(), potential);
    DrainRim();
    HoldSolids(forcing);
  }
}

void PotentialSolver::AddSource(std::span<const float> source_m) {
  for (std::size_t n = 0; n < source_m.size(); ++n) height_[n] += source_m[n];
  if (source_m.empty() || !HasLand()) return;
  for (std::size_t n = 0; n < cells_; ++n) {
    if (wet_[n] == 0) height_[n] = 0.0f;
  }
}

void PotentialSolver::DrainRim() {
  if (rim_keep_ == 1.0f) return;
  const int columns = spec_.cells.columns, rows = spec_.cells.rows;
  float* last_row = height_.get() + static_cast<std::size_t>(rows - 1) * columns;
  for (int column = 0; column < columns; ++column) {
    height_[column] *= rim_keep_;
    last_row[column] *= rim_keep_;
  }
  for (int row = 0; row < rows; ++row) {
    float* cells = height_.get() + static_cast<std::size_t>(row) * columns;
    cells[0] *= rim_keep_;
    cells[columns - 1] *= rim_keep_;
  }
}

void PotentialSolver::HoldSolids(const StepForcing& forcing) {
  if (forcing.solid.empty()) return;
  const int columns = spec_.cells.columns;
  for (int row = 0; row < spec_.cells.rows; ++row) {
    const float* solid = forcing.solid.data() + static_cast<std::size_t>(row) * columns;
    if (*std::max_element(solid, solid + columns) <= 0.0f) continue;
    float* phi = phi_.Row(row);
    for (int column = 0; column < columns; ++column) {
      const double share = std::min(static_cast<double>(solid[column]), 1.0);
      if (!(share > 0.0)) continue;
      const double keep =
          share < 1.0 ? real::Exp(real::Log(1.0 - share) * SubstepS() / kSolidS) : 0.0;
      const std::size_t at = static_cast<std::size_t>(row) * columns + column;
      const double rest = forcing.rest_height_m.empty() ? 0.0 : forcing.rest_height_m[at];
      height_[at] = static_cast<float>(rest + (height_[at] - rest) * keep);
      phi[column] *= static_cast<float>(1.0 - share * SubstepS() / kSolidMemoryS);
    }
  }
}

void PotentialSolver::Velocity(std::span<float> x, std::span<float> y, std::span<float> z) const {
  ONESEA_CHECK(x.size() == cells_ && y.size() == cells_ && z.size() == cells_);
  Outflow(z);
  const int columns = spec_.cells.columns, rows = spec_.cells.rows;
  const auto half_step = static_cast<float>(0.5 * sea::kGravity * SubstepS());
  // The potential at the instant of the heights, since it is half a step behind; x holds it until
  // both slopes are known.
  for (int row = 0; row < rows; ++row) {
    const float* phi = phi_.Row(row);
    const std::size_t at = static_cast<std::size_t>(row) * columns;
    for (int n = 0; n < columns; ++n) x[at + n] = phi[n] - half_step * height_[at + n];
  }
  for (int row = 0; row < rows; ++row) SlopeAlongY(row, x, y);
  for (int row = 0; row < rows; ++row) SlopeAlongX(row, x);
}

// The mean of both faces' slopes; 0 through the faces of land and of the region's rim.
void PotentialSolver::SlopeAlongY(int row, std::span<const float> potential,
                                  std::span<float> y) const {
  const auto scale = static_cast<float>(0.5 / spec_.cells.cell_m);
  const int columns = spec_.cells.columns;
  const std::size_t at = static_cast<std::size_t>(row) * columns;
  const std::size_t south = row > 0 ? at - columns : at;
  const std::size_t north = row + 1 < spec_.cells.rows ? at + columns : at;
  for (int n = 0; n < columns; ++n) {
    float below = potential[at + n] - potential[south + n];
    float above = potential[north + n] - potential[at + n];
    if (HasLand()) {
      below *= static_cast<float>(wet_[at + n] & wet_[south + n]);
      above *= static_cast<float>(wet_[at + n] & wet_[north + n]);
    }
    y[at + n] = scale * (below + above);
  }
}

void PotentialSolver::SlopeAlongX(int row, std::span<float> x) const {
  const auto scale = static_cast<float>(0.5 / spec_.cells.cell_m);
  const int columns = spec_.cells.columns;
  const std::size_t at = static_cast<std::size_t>(row) * columns;
  float across[kRegionSideMax + 1];  // the face to the west of each cell; 0 at both ends
  across[0] = across[columns] = 0.0f;
  for (int n = 1; n < columns; ++n) across[n] = x[at + n] - x[at + n - 1];
  if (HasLand()) {
    for (int n = 1; n < columns; ++n) {
      across[n] *= static_cast<float>(wet_[at + n] & wet_[at + n - 1]);
    }
  }
  for (int n = 0; n < columns; ++n) x[at + n] = scale * (across[n] + across[n + 1]);
}

std::vector<float> PotentialSolver::State() const {
  std::vector<float> state(height_.get(), height_.get() + cells_);
  state.reserve(2 * cells_);
  for (int row = 0; row < spec_.cells.rows; ++row) {
    state.insert(state.end(), phi_.Row(row), phi_.Row(row) + spec_.cells.columns);
  }
  return state;
}

void PotentialSolver::Restore(std::span<const float> state) {
  ONESEA_CHECK(state.size() == 2 * cells_) << state.size();
  std::copy_n(state.begin(), cells_, height_.get());
  const float* phi = state.data() + cells_;
  for (int row = 0; row < spec_.cells.rows; ++row, phi += spec_.cells.columns) {
    std::copy_n(phi, spec_.cells.columns, phi_.Row(row));
  }
  PotentialChanged(phi_);
}

void PotentialSolver::Adopt(const WaveSolver& other) {
  const SolverSpec& from = other.spec();
  ONESEA_CHECK(from.kind == spec_.kind && from.step_s == spec_.step_s);
  const sea::CellRect both = sea::Intersection(from.cells, spec_.cells);
  const std::vector<float> state = other.State();
  for (std::int64_t j = both.south; j < both.north(); ++j) {
    const auto row = static_cast<int>(j - spec_.cells.south);
    for (std::int64_t i = both.west; i < both.east(); ++i) {
      const auto column = static_cast<int>(i - spec_.cells.west);
      if (!Wet(column, row)) continue;
      const std::size_t source = from.cells.IndexOf(i, j);
      height_[static_cast<std::size_t>(row) * spec_.cells.columns + column] += state[source];
      phi_.Row(row)[column] += state[from.cells.cells() + source];
    }
  }
  PotentialChanged(phi_);
}

}  // namespace onesea::world
