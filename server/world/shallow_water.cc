#include "server/world/shallow_water.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/base/range_check.h"
#include "common/base/real_math.h"
#include "common/sea/constants.h"
#include "server/world/shallow_water_kernel.h"

namespace onesea::world {
namespace {

// Two passes through the edge multiply a wave by this at most (before the outer face takes its
// part).
constexpr double kEdgeResidue = 0.2;

class ShallowWater final : public WaveSolver {
 public:
  ShallowWater(const SolverSpec& spec, double theta);

  const SolverSpec& spec() const override { return spec_; }
  void Step(const StepForcing& forcing) override;
  std::span<const float> height_m() const override { return {f_.height.get(), cells_}; }
  void Velocity(std::span<float> x, std::span<float> y, std::span<float> z) const override;
  void Adopt(const WaveSolver& other) override;
  std::vector<float> State() const override;
  void Restore(std::span<const float> state) override;

 private:
  std::size_t At(int i, int j) const { return static_cast<std::size_t>(j) * f_.pitch + i; }
  std::size_t Across(int i, int j) const {
    return (static_cast<std::size_t>(j / kStripLines) * f_.columns + i) * kStripLines +
           static_cast<std::size_t>(j % kStripLines);
  }
  float RestLevel(int i, int j) const { return std::max(0.0f, f_.bottom[At(i, j)]); }
  void Allocate();
  void SetBottom();
  void SetEdges();
  void SetVelocityMax();
  void RefreshHeights();

  SolverSpec spec_;
  std::size_t cells_;
  ShallowFields f_;
};

ShallowWater::ShallowWater(const SolverSpec& spec, double theta)
    : spec_(spec), cells_(spec.cells.cells()) {
  f_.columns = spec.cells.columns;
  f_.rows = spec.cells.rows;
  f_.pitch = static_cast<std::size_t>(f_.columns) + kRowPadding;
  f_.step_s = static_cast<float>(spec.step_s);
  f_.step_per_cell = static_cast<float>(spec.step_s / spec.cells.cell_m);
  f_.theta = static_cast<float>(theta);
  f_.keep_velocity = static_cast<float>(real::Exp(-spec.damping_per_s * spec.step_s));
  f_.open = spec.edge_cells > 0;
  Allocate();
  SetBottom();
  SetEdges();
  SetVelocityMax();
  RefreshHeights();
}

void ShallowWater::Allocate() {
  const std::size_t natural = f_.pitch * f_.rows;
  for (sea::FloatArray* array : {&f_.level, &f_.bottom, &f_.v}) {
    *array = sea::AllocateZeros<float>(natural);
  }
  for (sea::FloatArray* array : {&f_.bottom_across, &f_.u, &f_.height, &f_.zeros}) {
    *array = sea::AllocateZeros<float>(cells_);
  }
  f_.keep_x = sea::AllocateZeros<float>(f_.columns);
  f_.keep_y = sea::AllocateZeros<float>(f_.rows);
  const std::size_t strip =
      (static_cast<std::size_t>(std::max(f_.columns, f_.rows)) + kRowPadding) * kStripLines;
  for (sea::FloatArray* array : {&f_.gain, &f_.offset, &f_.depth, &f_.moved, &f_.flux,
                                 &f_.level_across, &f_.pressure_across, &f_.solid_across}) {
    *array = sea::AllocateZeros<float>(strip);
  }
}

void ShallowWater::SetBottom() {
  const sea::CellRect& cells = spec_.cells;
  for (int j = 0; j < f_.rows; ++j) {
    for (int i = 0; i < f_.columns; ++i) {
      const double elevation_m =
          spec_.terrain == nullptr
              ? -spec_.depth_m
              : spec_.terrain->ElevationAt(cells.PlaceOf(cells.west + i, cells.south + j));
      const float bottom = static_cast<float>(elevation_m);
      f_.bottom[At(i, j)] = f_.bottom_across[Across(i, j)] = bottom;
      f_.level[At(i, j)] = std::max(0.0f, bottom);
    }
  }
}

// A rate that grows with the square of the way into the edge, such that a wave of the fastest speed
// there is left with kEdgeResidue after both ways.
void ShallowWater::SetEdges() {
  const int edge = spec_.edge_cells;
  float deepest_m = 0.0f;
  for (int j = 0; j < f_.rows; ++j) {
    for (int i = 0; i < f_.columns; ++i) {
      const int from_rim = std::min({i, j, f_.columns - 1 - i, f_.rows - 1 - j});
      if (from_rim < edge) deepest_m = std::max(deepest_m, -f_.bottom[At(i, j)]);
    }
  }
  const double speed_m_per_s = std::sqrt(sea::kGravity * deepest_m);
  const double width_m = edge * spec_.cells.cell_m;
  const double rate_per_s =
      edge == 0 ? 0.0 : -1.5 * speed_m_per_s * real::Log(kEdgeResidue) / width_m;
  const auto fill = [&](float* keep, int count) {
    for (int n = 0; n < count; ++n) {
      const int from_rim = std::min(n, count - 1 - n);
      const double way =
          from_rim < edge ? (edge - from_rim - 0.5) / static_cast<double>(edge) : 0.0;
      keep[n] = static_cast<float>(real::Exp(-rate_per_s * way * way * spec_.step_s));
    }
  };
  fill(f_.keep_x.get(), f_.columns);
  fill(f_.keep_y.get(), f_.rows);
}

// Without advection nothing holds a steady flow down a slope; the front of a broken dam runs at
// 2 sqrt(g H).
void ShallowWater::SetVelocityMax() {
  float low = f_.bottom[0], high = std::max(0.0f, f_.bottom[0]);
  for (int j = 0; j < f_.rows; ++j) {
    for (int i = 0; i < f_.columns; ++i) {
      low = std::min(low, f_.bottom[At(i, j)]);
      high = std::max(high, f_.bottom[At(i, j)]);
    }
  }
  f_.velocity_max = 2.0f * std::sqrt(static_cast<float>(sea::kGravity) * (high - low));
}

void ShallowWater::RefreshHeights() {
  for (int j = 0; j < f_.rows; ++j) {
    for (int i = 0; i < f_.columns; ++i) {
      const float level = f_.level[At(i, j)];
      const bool wet = level - f_.bottom[At(i, j)] > kDryDepthM;
      f_.height[static_cast<std::size_t>(j) * f_.columns + i] = wet ? level : 0.0f;
    }
  }
}

void ShallowWater::Step(const StepForcing& forcing) {
  const auto cells_of = [&](std::span<const float> span) -> const float* {
    ONESEA_CHECK(span.empty() || span.size() == cells_) << "forcing of " << span.size() << " cells";
    return span.empty() ? nullptr : span.data();
  };
  ShallowForcing whole = {.source_m = cells_of(forcing.source_m),
                          .pressure_head_m = cells_of(forcing.pressure_head_m),
                          .solid = cells_of(forcing.solid),
                          .rest_height_m = cells_of(forcing.rest_height_m)};
  if (whole.solid == nullptr) whole.rest_height_m = nullptr;
  StepShallowWater(f_, whole);
}

void ShallowWater::Velocity(std::span<float> x, std::span<float> y, std::span<float> z) const {
  ONESEA_CHECK(x.size() == cells_ && y.size() == cells_ && z.size() == cells_) << "one per cell";
  ShallowWaterVelocities(f_, static_cast<float>(1.0 / spec_.cells.cell_m), x.data(), y.data(),
                         z.data());
}

void ShallowWater::Adopt(const WaveSolver& other) {
  const auto* from = dynamic_cast<const ShallowWater*>(&other);
  ONESEA_CHECK(from != nullptr && from->spec_.cells.cell_m == spec_.cells.cell_m &&
               from->spec_.step_s == spec_.step_s)
      << "only shallow water of the same cell_m and step_s can be adopted";
  const sea::CellRect both = sea::Intersection(spec_.cells, from->spec_.cells);
  const int i0 = static_cast<int>(both.west - spec_.cells.west);
  const int j0 = static_cast<int>(both.south - spec_.cells.south);
  const int other_i0 = static_cast<int>(both.west - from->spec_.cells.west);
  const int other_j0 = static_cast<int>(both.south - from->spec_.cells.south);
  for (int j = 0; j < both.rows; ++j) {
    for (int i = 0; i < both.columns; ++i) {
      const int oi = other_i0 + i, oj = other_j0 + j;
      float& level = f_.level[At(i0 + i, j0 + j)];
      // In this order, so that a region at rest takes the other's level unrounded.
      level = from->f_.level[from->At(oi, oj)] + (level - RestLevel(i0 + i, j0 + j));
      level = std::max(level, f_.bottom[At(i0 + i, j0 + j)]);
      if (i + 1 < both.columns) f_.u[Across(i0 + i, j0 + j)] += from->f_.u[from->Across(oi, oj)];
      if (j + 1 < both.rows) f_.v[At(i0 + i, j0 + j)] += from->f_.v[from->At(oi, oj)];
    }
  }
  RefreshHeights();
}

// (3 x rows x columns): level, u, v.
std::vector<float> ShallowWater::State() const {
  std::vector<float> state;
  state.reserve(3 * cells_);
  for (int field = 0; field < 3; ++field) {
    for (int j = 0; j < f_.rows; ++j) {
      for (int i = 0; i < f_.columns; ++i) {
        state.push_back(field == 0   ? f_.level[At(i, j)]
                        : field == 1 ? f_.u[Across(i, j)]
                                     : f_.v[At(i, j)]);
      }
    }
  }
  return state;
}

void ShallowWater::Restore(std::span<const float> state) {
  ONESEA_CHECK(state.size() == 3 * cells_) << "state of " << state.size() << " numbers";
  const float* next = state.data();
  for (int field = 0; field < 3; ++field) {
    for (int j = 0; j < f_.rows; ++j) {
      for (int i = 0; i < f_.columns; ++i) {
        (field == 0   ? f_.level[At(i, j)]
         : field == 1 ? f_.u[Across(i, j)]
                      : f_.v[At(i, j)]) = *next++;
      }
    }
  }
  RefreshHeights();
}

}  // namespace

absl::StatusOr<std::unique_ptr<WaveSolver>> MakeShallowWater(const SolverSpec& spec, double theta) {
  if (absl::Status s = ValidateSolverSpec(spec); !s.ok()) return s;
  if (absl::Status s = CheckInRange("region.theta", theta, 0.5, 1.0); !s.ok()) return s;
  if (spec.terrain == nullptr) {
    if (absl::Status s = CheckInRange("region.depth_m", spec.depth_m, kDepthMinM, kDepthMaxM);
        !s.ok()) {
      return s;
    }
  } else if (absl::Status s = sea::ValidateTerrain(*spec.terrain); !s.ok()) {
    return s;
  }
  return std::make_unique<ShallowWater>(spec, theta);
}

}  // namespace onesea::world
