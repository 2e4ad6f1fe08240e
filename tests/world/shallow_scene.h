#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "common/base/check.h"
#include "server/world/shallow_water.h"

namespace onesea::world {

/// A terrain with one sample a cell of `cells`, so that the solver reads it without interpolation.
inline std::shared_ptr<const sea::Terrain> TerrainOf(
    const sea::CellRect& cells, const std::function<double(double x, double y)>& elevation_m) {
  auto terrain = std::make_shared<sea::Terrain>();
  const Vec2d corner = cells.PlaceOf(cells.west, cells.south);
  terrain->west_m = corner.x;
  terrain->south_m = corner.y;
  terrain->cell_m = cells.cell_m;
  terrain->columns = cells.columns;
  terrain->rows = cells.rows;
  for (int j = 0; j < cells.rows; ++j) {
    for (int i = 0; i < cells.columns; ++i) {
      const Vec2d place = cells.PlaceOf(cells.west + i, cells.south + j);
      terrain->elevation_m.push_back(static_cast<float>(elevation_m(place.x, place.y)));
    }
  }
  return terrain;
}

/// A solver and the state that it starts from, set cell by cell.
struct ShallowScene {
  explicit ShallowScene(const SolverSpec& spec, double theta = kShallowTheta)
      : solver(*MakeShallowWater(spec, theta)), state(solver->State()) {}

  std::size_t cells() const { return solver->spec().cells.cells(); }
  int columns() const { return solver->spec().cells.columns; }
  int rows() const { return solver->spec().cells.rows; }
  Vec2d PlaceOf(int i, int j) const {
    const sea::CellRect& c = solver->spec().cells;
    return c.PlaceOf(c.west + i, c.south + j);
  }

  /// level = max(bottom, given).
  void SetLevel(const std::function<double(double x, double y)>& level_m) {
    for (int j = 0; j < rows(); ++j) {
      for (int i = 0; i < columns(); ++i) {
        const Vec2d place = PlaceOf(i, j);
        const float level = static_cast<float>(level_m(place.x, place.y));
        state[At(i, j)] = std::max(level, Bottom(i, j));
      }
    }
    solver->Restore(state);
  }
  /// Velocities of the faces, u east and v north of each cell, where they are wet.
  void SetVelocity(const std::function<double(double x, double y)>& u,
                   const std::function<double(double x, double y)>& v) {
    const double half = 0.5 * solver->spec().cells.cell_m;
    for (int j = 0; j < rows(); ++j) {
      for (int i = 0; i < columns(); ++i) {
        const Vec2d p = PlaceOf(i, j);
        if (i + 1 < columns()) {
          state[cells() + At(i, j)] = static_cast<float>(u(p.x + half, p.y));
        }
        if (j + 1 < rows()) state[2 * cells() + At(i, j)] = static_cast<float>(v(p.x, p.y + half));
      }
    }
    solver->Restore(state);
  }

  void Run(int steps, const StepForcing& forcing = {}) {
    for (int n = 0; n < steps; ++n) solver->Step(forcing);
    state = solver->State();
  }
  std::size_t At(int i, int j) const { return static_cast<std::size_t>(j) * columns() + i; }
  float Level(int i, int j) const { return state[At(i, j)]; }
  float Bottom(int i, int j) const {
    const SolverSpec& spec = solver->spec();
    return static_cast<float>(spec.terrain == nullptr ? -spec.depth_m
                                                      : spec.terrain->ElevationAt(PlaceOf(i, j)));
  }
  /// Of water [m³].
  double Volume() const {
    double sum_m = 0.0;
    for (int j = 0; j < rows(); ++j) {
      for (int i = 0; i < columns(); ++i) sum_m += double{Level(i, j)} - double{Bottom(i, j)};
    }
    return sum_m * solver->spec().cells.cell_m * solver->spec().cells.cell_m;
  }

  std::unique_ptr<WaveSolver> solver;
  std::vector<float> state;  ///< level, u, v
};

}  // namespace onesea::world
