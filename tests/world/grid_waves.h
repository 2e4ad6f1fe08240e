#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <vector>

#include "common/sea/constants.h"
#include "server/world/wave_solver.h"

// Waves to start a solver with and what to measure on them. A linear solver's state is η, then φ
// half a step earlier, one float per cell each.
namespace onesea::world {

inline std::unique_ptr<WaveSolver> Solver(const SolverSpec& spec) {
  auto solver = MakeSolver(spec);
  EXPECT_TRUE(solver.ok()) << solver.status();
  return std::move(*solver);
}

inline SolverSpec Region(SolverKind kind, int columns, int rows, double cell_m, double depth_m) {
  SolverSpec spec;
  spec.kind = kind;
  spec.cells = {.columns = columns, .rows = rows, .cell_m = cell_m};
  spec.depth_m = depth_m;
  return spec;
}

// η and φ as functions of the place in cells.
using Field = std::function<double(double column, double row)>;

inline void SetWaves(WaveSolver& solver, const Field& height, const Field& potential) {
  const sea::CellRect& cells = solver.spec().cells;
  std::vector<float> state;
  for (const Field* field : {&height, &potential}) {
    for (int row = 0; row < cells.rows; ++row) {
      for (int column = 0; column < cells.columns; ++column) {
        state.push_back(static_cast<float>((*field)(column, row)));
      }
    }
  }
  solver.Restore(state);
}

inline Field Nothing() {
  return [](double, double) { return 0.0; };
}

inline Field Hump(double column, double row, double radius_cells, double height_m = 1.0) {
  return [=](double x, double y) {
    const double r2 = (x - column) * (x - column) + (y - row) * (y - row);
    return height_m * std::exp(-r2 / (radius_cells * radius_cells));
  };
}

inline double Volume(const WaveSolver& solver) {
  double sum = 0.0;
  for (const float height : solver.height_m()) sum += height;
  return sum * solver.spec().cells.cell_m * solver.spec().cells.cell_m;
}

// Potential energy per rho g, that of the surface.
inline double HeightSquares(const WaveSolver& solver) {
  double sum = 0.0;
  for (const float height : solver.height_m()) sum += static_cast<double>(height) * height;
  return sum;
}

inline double Greatest(std::span<const float> values) {
  double greatest = 0.0;
  for (const float v : values) greatest = std::max(greatest, std::abs(static_cast<double>(v)));
  return greatest;
}

inline float At(const WaveSolver& solver, int column, int row) {
  return solver.height_m()[static_cast<std::size_t>(row) * solver.spec().cells.columns + column];
}

inline void RunSteps(WaveSolver& solver, int steps) {
  for (int n = 0; n < steps; ++n) solver.Step({});
}

}  // namespace onesea::world
