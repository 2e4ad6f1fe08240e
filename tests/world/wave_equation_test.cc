#include "server/world/wave_equation.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/world/grid_waves.h"

namespace onesea::world {
namespace {

constexpr double kPi = sea::kPi;

// Oracle: a closed basin of length L swings in mode m with ω = √(g d) π m / L.
TEST(WaveEquation, BasinSwingsAtItsPeriod) {
  for (const double depth_m : {1.0, 20.0}) {
    for (const double cell_m : {0.25, 2.0}) {
      SolverSpec spec = Region(SolverKind::kWaveEquation, 128, 64, cell_m, depth_m);
      spec.edge_cells = 0;
      const auto solver = Solver(spec);
      constexpr int kMode = 10;  // 25.6 cells a wave
      SetWaves(
          *solver, [](double x, double) { return std::cos(kPi * kMode * (x + 0.5) / 128.0); },
          Nothing());
      const double omega = std::sqrt(sea::kGravity * depth_m) * kPi * kMode / (128.0 * cell_m);
      // η(0, t) = cos ωt for the half step that φ lags: count the falling zeros of 20 periods.
      const double step_s = spec.step_s;
      double first = -1.0, last = -1.0, before = At(*solver, 0, 0);
      int falls = 0;
      for (int n = 1; falls < 21; ++n) {
        solver->Step({});
        const double now = At(*solver, 0, 0);
        if (before > 0.0 && now <= 0.0) {
          last = (n - 1 + before / (before - now)) * step_s;
          if (falls++ == 0) first = last;
        }
        before = now;
      }
      EXPECT_NEAR((last - first) / 20.0 * omega / (2.0 * kPi), 1.0, 0.01)
          << depth_m << " m deep, cells of " << cell_m;
    }
  }
}

// Green's law: a long wave over a slope that is gentle for it grows as depth^(-1/4).
TEST(WaveEquation, WavesGrowWithGreensLaw) {
  SolverSpec spec = Region(SolverKind::kWaveEquation, 640, 64, 1.0, 0.0);
  spec.edge_cells = 0;
  auto terrain = std::make_shared<sea::Terrain>();
  terrain->cell_m = 10.0;
  terrain->columns = 65;
  terrain->rows = 8;
  for (int n = 0; n < 65 * 8; ++n) {
    const double x = 10.0 * (n % 65);
    terrain->elevation_m.push_back(
        static_cast<float>(-std::clamp(8.0 - 6.0 * (x - 200.0) / 300.0, 2.0, 8.0)));
  }
  spec.terrain = terrain;
  const auto solver = Solver(spec);
  const double speed = std::sqrt(sea::kGravity * 8.0);
  // A hump that runs east: φ = g/c ∫η dx.
  SetWaves(
      *solver, [](double x, double) { return std::exp(-(x - 90.0) * (x - 90.0) / 900.0); },
      [=](double x, double) {
        return sea::kGravity / speed * 30.0 * std::sqrt(kPi) / 2.0 * std::erf((x - 90.0) / 30.0);
      });
  double deep = 0.0, shallow = 0.0;
  for (int n = 0; n < 60 * 80; ++n) {
    solver->Step({});
    deep = std::max(deep, static_cast<double>(At(*solver, 180, 32)));
    shallow = std::max(shallow, static_cast<double>(At(*solver, 540, 32)));
  }
  EXPECT_NEAR(shallow / deep, std::pow(4.0, 0.25), 0.03 * std::sqrt(2.0));
}

// Oracle: the bow wave of a body at speed U > c lies on the Mach line, asin(c / U).
TEST(WaveEquation, FastBodyDrawsTheMachAngle) {
  SolverSpec spec = Region(SolverKind::kWaveEquation, 512, 256, 0.5, 1.0);
  const auto solver = Solver(spec);
  const double speed = 2.0 * std::sqrt(sea::kGravity * 1.0);  // Mach 2: 30°
  std::vector<float> head(spec.cells.cells());
  double column = 40.0;
  while (column < 440.0) {
    for (int row = 112; row < 144; ++row) {
      for (int i = static_cast<int>(column) - 16; i < static_cast<int>(column) + 17; ++i) {
        head[static_cast<std::size_t>(row) * 512 + i] =
            static_cast<float>(Hump(column, 128, 5.0, 0.1)(i, row));
      }
    }
    solver->Step({.pressure_head_m = head});
    std::fill(head.begin(), head.end(), 0.0f);
    column += speed * spec.step_s / spec.cells.cell_m;
  }
  // The crest line: the highest cell of each row, fitted by a line through the wake.
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  int count = 0;
  for (int row = 150; row < 220; ++row) {
    const float* cells = solver->height_m().data() + static_cast<std::size_t>(row) * 512;
    const auto crest = static_cast<double>(std::max_element(cells, cells + 512) - cells);
    const double y = row - 128.0;
    sx += y;
    sy += crest;
    sxx += y * y;
    sxy += y * crest;
    ++count;
  }
  const double columns_per_row = (count * sxy - sx * sy) / (count * sxx - sx * sx);
  EXPECT_NEAR(std::atan2(1.0, -columns_per_row) * 180.0 / kPi, 30.0, 1.0);
}

TEST(WaveEquation, RefusesWhatItCannotStep) {
  const auto message = [](const SolverSpec& spec) {
    const auto made = MakeSolver(spec);
    EXPECT_FALSE(made.ok());
    return std::string(made.status().message());
  };
  SolverSpec spec = Region(SolverKind::kWaveEquation, 128, 64, 0.5, 0.0);
  EXPECT_NE(message(spec).find("region.depth_m"), std::string::npos);
  spec.depth_m = 5000.0;
  spec.cells.cell_m = 0.1;
  EXPECT_NE(message(spec).find("sub-steps"), std::string::npos);
}

}  // namespace
}  // namespace onesea::world
