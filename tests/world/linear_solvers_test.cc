// What holds for every linear solver, over a flat bottom and over terrain.
#include <gtest/gtest.h>

#include <string>

#include "hwy/targets.h"
#include "tests/sea/allocation_count.h"
#include "tests/world/grid_waves.h"

namespace onesea::world {
namespace {

struct Case {
  std::string name;
  SolverSpec spec;
};

std::shared_ptr<const sea::Terrain> Beach() {
  auto terrain = std::make_shared<sea::Terrain>();
  terrain->cell_m = 8.0;
  terrain->columns = terrain->rows = 10;
  for (int n = 0; n < 100; ++n) {
    const float x = static_cast<float>(n % 10) * 8.0f, y = static_cast<float>(n / 10) * 8.0f;
    terrain->elevation_m.push_back(-5.0f + 0.11f * x + 0.01f * y);  // land from x = 45 m or so on
  }
  return terrain;
}

std::vector<Case> Cases() {
  std::vector<Case> cases;
  for (const auto& [name, kind] : {std::pair("WaveEquation", SolverKind::kWaveEquation),
                                   std::pair("Iwave", SolverKind::kIwave)}) {
    cases.push_back({name, Region(kind, 128, 96, 0.5, 3.0)});
    cases.push_back({std::string(name) + "OverTerrain", cases.back().spec});
    cases.back().spec.terrain = Beach();
  }
  return cases;
}

class LinearSolver : public testing::TestWithParam<Case> {
 protected:
  SolverSpec Closed() const {
    SolverSpec spec = GetParam().spec;
    spec.edge_cells = 0;
    return spec;
  }
};

INSTANTIATE_TEST_SUITE_P(Solvers, LinearSolver, testing::ValuesIn(Cases()),
                         [](const auto& test) { return test.param.name; });

TEST_P(LinearSolver, KeepsTheVolumeOfWhatIsPouredIn) {
  const auto solver = Solver(Closed());
  std::vector<float> rain(solver->height_m().size());
  for (std::size_t n = 0; n < rain.size(); ++n) rain[n] = n % 7 == 0 ? 0.001f : 0.0f;
  for (int n = 0; n < 60; ++n) solver->Step({.source_m = rain});
  const double poured = Volume(*solver);
  EXPECT_GT(poured, 5.0);  // m³
  SetWaves(*solver, Hump(40, 48, 6.0), Hump(50, 40, 5.0, 3.0));
  const double before = Volume(*solver);
  RunSteps(*solver, 1200);
  EXPECT_NEAR(Volume(*solver), before, 1e-4 * before);
}

// ⟨η,η⟩ alone swings with the waves; its mean over a second settles at half the energy.
TEST_P(LinearSolver, KeepsItsEnergy) {
  const auto solver = Solver(Closed());
  SetWaves(*solver, Hump(40, 48, 6.0), Nothing());
  const auto mean = [&] {
    double sum = 0.0;
    for (int n = 0; n < 600; ++n) {
      solver->Step({});
      sum += HeightSquares(*solver) / 600.0;
    }
    return sum;
  };
  mean();
  const double early = mean();
  RunSteps(*solver, 60 * 40);
  EXPECT_NEAR(mean() / early, 1.0, 0.05);
}

TEST_P(LinearSolver, DampingTakesEnergyAndNoFlatOffset) {
  SolverSpec spec = Closed();
  const auto free = Solver(spec);
  spec.damping_per_s = 0.3;
  const auto damped = Solver(spec);
  for (const auto& solver : {free.get(), damped.get()}) {
    SetWaves(*solver, Hump(40, 48, 3.0), Nothing());
  }
  // Both swing alike, so the ratio of energies is steady: exp(-0.3 * 4).
  double kept = 0.0, whole = 0.0;
  for (int n = 0; n < 480; ++n) {
    free->Step({});
    damped->Step({});
    if (n < 240 - 60 || n > 240 + 60) continue;
    kept += HeightSquares(*damped);
    whole += HeightSquares(*free);
  }
  EXPECT_NEAR(kept / whole, std::exp(-0.3 * 4.0), 0.15 * std::exp(-0.3 * 4.0));
  if (spec.terrain != nullptr) return;
  SetWaves(
      *damped, [](double, double) { return 0.25; }, Nothing());
  RunSteps(*damped, 600);
  for (const float height : damped->height_m()) ASSERT_FLOAT_EQ(height, 0.25f);
}

TEST_P(LinearSolver, PressureDigsItsOwnHead) {
  SolverSpec spec = GetParam().spec;
  spec.damping_per_s = 2.0;
  const auto solver = Solver(spec);
  std::vector<float> head(solver->height_m().size());
  for (int row = 0; row < 96; ++row) {
    for (int column = 0; column < 128; ++column) {
      head[static_cast<std::size_t>(row) * 128 + column] =
          static_cast<float>(Hump(50, 48, 8.0, 0.2)(column, row));
    }
  }
  for (int n = 0; n < 1200; ++n) solver->Step({.pressure_head_m = head});
  EXPECT_NEAR(At(*solver, 50, 48), -0.2, 0.01);
  EXPECT_NEAR(At(*solver, 58, 48), -0.2 * std::exp(-1.0), 0.01);
}

// A solid cell is held at its rest height, however the time is cut into steps, and what lies behind
// a wall stays in its shadow.
TEST_P(LinearSolver, SolidsAreHeldWhateverTheStep) {
  SolverSpec spec = GetParam().spec;
  std::vector<float> at_end;
  for (const int rate : {60, 120}) {
    spec.step_s = 1.0 / rate;
    const auto solver = Solver(spec);
    SetWaves(*solver, Hump(30, 48, 4.0), Nothing());
    std::vector<float> solid(solver->height_m().size()), rest(solid.size());
    for (int n = 0; n < 96 * 3; ++n) {
      solid[static_cast<std::size_t>(n / 3) * 128 + 43 + n % 3] = 1.0f;
    }
    for (int row = 30; row < 60; ++row) solid[static_cast<std::size_t>(row) * 128 + 36] = 0.3f;
    rest[20 * 128 + 44] = -0.05f;
    double behind = 0.0;
    for (int n = 0; n < 3 * rate; ++n) {
      solver->Step({.solid = solid, .rest_height_m = rest});
      behind = std::max(behind, std::abs(static_cast<double>(At(*solver, 60, 48))));
    }
    EXPECT_FLOAT_EQ(At(*solver, 44, 20), -0.05f);
    EXPECT_EQ(At(*solver, 44, 50), 0.0f);
    EXPECT_LT(behind, 0.01);
    at_end.push_back(At(*solver, 30, 40));
  }
  EXPECT_NEAR(at_end[0], at_end[1], 0.01);
  EXPECT_GT(std::abs(at_end[0]), 0.003);
}

TEST_P(LinearSolver, RestoresToTheBit) {
  const auto solver = Solver(GetParam().spec);
  SetWaves(*solver, Hump(40, 48, 6.0), Hump(44, 40, 5.0, 3.0));
  RunSteps(*solver, 37);
  const std::vector<float> state = solver->State();
  const auto other = Solver(GetParam().spec);
  other->Restore(state);
  EXPECT_EQ(other->State(), state);
  const std::size_t cells = solver->height_m().size();
  std::vector<float> x(cells), y(cells), z(cells), other_x(cells), other_y(cells), other_z(cells);
  solver->Velocity(x, y, z);
  other->Velocity(other_x, other_y, other_z);
  EXPECT_EQ(x, other_x);
  EXPECT_EQ(y, other_y);
  EXPECT_EQ(z, other_z);
  RunSteps(*solver, 50);
  RunSteps(*other, 50);
  EXPECT_EQ(other->State(), solver->State());
}

// Oracle: what moved. The surface's vertical velocity is the change of height, and the horizontal
// velocities are the potential's slopes: of a wave along x, in phase with the height.
TEST_P(LinearSolver, VelocitiesAreThoseOfTheWater) {
  const auto solver = Solver(Closed());
  SetWaves(*solver, Hump(40, 48, 8.0), Nothing());
  RunSteps(*solver, 20);
  const std::size_t cells = solver->height_m().size();
  std::vector<float> x(cells), y(cells), z(cells),
      before(solver->height_m().begin(), solver->height_m().end());
  solver->Step({});
  solver->Velocity(x, y, z);
  const std::vector<float> state = solver->State();
  double greatest = 0.0;
  for (int row = 2; row < 94; ++row) {
    for (int column = 2; column < 126; ++column) {
      const std::size_t at = static_cast<std::size_t>(row) * 128 + column;
      const double rise = (solver->height_m()[at] - before[at]) / solver->spec().step_s;
      ASSERT_NEAR(z[at], rise, 1e-3);
      greatest = std::max(greatest, std::abs(rise));
      if (column > 80) continue;  // no land there
      const auto potential = [&](std::size_t n) {
        return state[cells + n] - 0.5 * sea::kGravity * solver->spec().step_s * state[n];
      };
      ASSERT_NEAR(x[at], potential(at + 1) - potential(at - 1), 1e-3);
      ASSERT_NEAR(y[at], potential(at + 128) - potential(at - 128), 1e-3);
    }
  }
  EXPECT_GT(greatest, 0.1);
}

// Waves continue in a larger region as if they had always been there.
TEST_P(LinearSolver, AdoptsWavesWhereTheyAre) {
  const SolverSpec spec = GetParam().spec;
  SolverSpec larger = spec;
  larger.cells = {.west = -32, .south = -32, .columns = 192, .rows = 160, .cell_m = 0.5};
  const auto small = Solver(spec), grown = Solver(larger), whole = Solver(larger);
  SetWaves(*small, Hump(40, 48, 5.0), Nothing());
  SetWaves(*whole, Hump(72, 80, 5.0), Nothing());
  RunSteps(*small, 20);
  RunSteps(*whole, 20);
  grown->Adopt(*small);
  RunSteps(*grown, 60);
  RunSteps(*whole, 60);
  double error = 0.0;
  for (int row = 60; row < 100; ++row) {
    for (int column = 50; column < 90; ++column) {
      error = std::max(
          error, std::abs(static_cast<double>(At(*grown, column, row)) - At(*whole, column, row)));
    }
  }
  EXPECT_LT(error, 1e-3);
  EXPECT_GT(Greatest(whole->height_m()), 0.05);
}

TEST_P(LinearSolver, HasTheSameBitsOnEverySimdTarget) {
  std::vector<float> first;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    const auto solver = Solver(GetParam().spec);
    SetWaves(*solver, Hump(40, 48, 2.0), Hump(44, 40, 3.0, 3.0));
    std::vector<float> head(solver->height_m().size(), 0.0f);
    head[48 * 128 + 50] = 0.3f;
    for (int n = 0; n < 90; ++n) solver->Step({.pressure_head_m = head});
    if (first.empty()) first = solver->State();
    EXPECT_EQ(solver->State(), first) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST_P(LinearSolver, AStepAllocatesNothing) {
  const auto solver = Solver(GetParam().spec);
  const std::vector<float> ones(solver->height_m().size(), 0.5f);
  std::vector<float> x(ones), y(ones), z(ones);
  solver->Step({});
  const std::int64_t before = AllocationCount();
  solver->Step({.source_m = ones, .pressure_head_m = ones, .solid = ones, .rest_height_m = ones});
  solver->Velocity(x, y, z);
  EXPECT_EQ(AllocationCount(), before);
}

// The border: what comes back of a ring wave, against the same ring in a sea without borders near.
// The ring of a hat of this radius is about 3 radii long.
TEST_P(LinearSolver, BorderAbsorbs) {
  if (GetParam().spec.terrain != nullptr) GTEST_SKIP() << "land reflects";
  SolverSpec spec = GetParam().spec;
  spec.cells.rows = 128;
  SolverSpec open = spec;
  open.cells.columns = open.cells.rows = 512;
  for (const double radius : {3.0, 6.0}) {
    const auto hat = [=](double middle) {
      return [=](double x, double y) {
        const double r2 =
            ((x - middle) * (x - middle) + (y - middle) * (y - middle)) / (radius * radius);
        return (1.0 - r2) * std::exp(-r2);
      };
    };
    const auto bordered = Solver(spec), wide = Solver(open);
    SetWaves(*bordered, hat(64), Nothing());
    SetWaves(*wide, hat(256), Nothing());
    double reflected = 0.0, incident = 0.0;
    for (int n = 0; n < 1200; ++n) {
      bordered->Step({});
      wide->Step({});
      // Just outside the border, where the ring has its last full height.
      incident = std::max(incident, std::abs(static_cast<double>(At(*wide, 256 + 46, 256))));
      for (const int offset : {0, 12, 24, 36}) {
        const double difference =
            static_cast<double>(At(*bordered, 64 + offset, 64)) - At(*wide, 256 + offset, 256);
        reflected = std::max(reflected, std::abs(difference));
      }
    }
    std::printf("hat of %.0f cells: %.4f m of %.4f m come back: %.1f %%\n", radius, reflected,
                incident, 100.0 * reflected / incident);
    EXPECT_LT(reflected, 0.1 * incident);
  }
}

}  // namespace
}  // namespace onesea::world
