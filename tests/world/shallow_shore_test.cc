// The shallow-water solver where the water ends: shores, pools, walls.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/sea/constants.h"
#include "tests/world/shallow_scene.h"

namespace onesea::world {
namespace {

SolverSpec Spec(int columns, int rows, double cell_m, double step_s,
                const std::function<double(double x, double y)>& elevation_m) {
  SolverSpec spec;
  spec.kind = SolverKind::kShallowWater;
  spec.cells = {.columns = columns, .rows = rows, .cell_m = cell_m};
  spec.cells.west = -columns / 2;
  spec.cells.south = -rows / 2;
  spec.step_s = step_s;
  spec.edge_cells = 0;
  spec.terrain = TerrainOf(spec.cells, elevation_m);
  return spec;
}

double Rough(double x, double y) {
  return -1.5 + 2.6 * std::sin(0.21 * x) * std::cos(0.17 * y) + 0.8 * std::sin(1.9 * x + 2.3 * y);
}

TEST(ShallowWater, LakeStaysFlatForAnHour) {
  for (const int edge_cells : {0, 16}) {
    SolverSpec spec = Spec(64, 64, 1.0, 1.0 / 60.0, Rough);
    spec.edge_cells = edge_cells;
    ShallowScene scene(spec);
    const std::vector<float> start = scene.state;
    for (int n = 0; n < 60 * 3600; ++n) scene.solver->Step({});
    EXPECT_EQ(scene.solver->State(), start);
    const auto heights = scene.solver->height_m();
    EXPECT_EQ(std::count(heights.begin(), heights.end(), 0.0f), std::ssize(heights));
  }
}

// A pool above the mean level and a lake stay where they are, whatever their level.
TEST(ShallowWater, PerchedPoolsStay) {
  ShallowScene scene(Spec(128, 64, 1.0, 0.1, [](double x, double y) {
    return x > 0 ? 3.0 - 2.0 * std::exp(-((x - 30) * (x - 30) + y * y) / 200.0) : -4.0;
  }));
  scene.SetLevel([](double x, double) { return x > 0 ? 1.7 : 0.37; });
  const std::vector<float> start = scene.state;
  scene.Run(1000);
  EXPECT_EQ(scene.state, start);
}

// A flood over islands: nothing appears or vanishes, and no cell owes water.
TEST(ShallowWater, KeepsVolumeWhileWettingAndDrying) {
  for (const double step_s : {1.0 / 60.0, 0.2}) {
    ShallowScene scene(Spec(128, 96, 1.0, step_s, Rough));
    scene.SetLevel([](double x, double) { return x < -20 ? 2.0 : -2.0; });
    const double volume_m3 = scene.Volume();
    for (int burst = 0; burst < 20; ++burst) {
      scene.Run(30);
      EXPECT_NEAR(scene.Volume() / volume_m3, 1.0, 1e-6);
      for (int j = 0; j < scene.rows(); ++j) {
        for (int i = 0; i < scene.columns(); ++i) {
          ASSERT_GE(scene.Level(i, j), scene.Bottom(i, j)) << i << ' ' << j;
          ASSERT_LT(scene.Level(i, j), 9.0f) << i << ' ' << j;
        }
      }
    }
  }
}

// Thacker's plane surface that swings in a paraboloid is a solution of our equations too, since its
// velocity is the same everywhere and advects nothing. The shoreline moves all the time.
// Source: W. C. Thacker, "Some exact solutions to the nonlinear shallow-water wave equations", J.
// Fluid Mech. 107, 1981.
constexpr double kBowlDepth = 2.0, kBowlRadius = 30.0, kBowlShift = 8.0;

// How far the centre of the water is from its place after one period, in amplitudes of the swing.
double ErrorAfterASwing(int side, double cell_m) {
  ShallowScene scene(Spec(side, side, cell_m, 1.0 / 60.0, [](double x, double y) {
    return kBowlDepth * ((x * x + y * y) / (kBowlRadius * kBowlRadius) - 1.0);
  }));
  const double omega = std::sqrt(2 * sea::kGravity * kBowlDepth) / kBowlRadius;
  scene.SetLevel([](double x, double) {
    return kBowlShift * kBowlDepth / (kBowlRadius * kBowlRadius) * (2 * x - kBowlShift);
  });
  scene.Run(static_cast<int>(std::lround(2 * sea::kPi / omega * 60)));
  double moment_x = 0.0, moment_y = 0.0, volume = 0.0;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const Vec2d p = scene.PlaceOf(i, j);
      const double depth = scene.Level(i, j) - scene.Bottom(i, j);
      moment_x += depth * p.x;
      moment_y += depth * p.y;
      volume += depth;
    }
  }
  return std::hypot(moment_x / volume - kBowlShift, moment_y / volume) / kBowlShift;
}

TEST(ShallowWater, SwingsInAParaboloidAsThackerSays) { EXPECT_LT(ErrorAfterASwing(192, 0.5), 0.1); }

// Run-up of a wave that doesn't break: R/d = 2.831 √(cot β) (H/d)^5/4. The law follows from the
// linear theory, whose largest run-up is the non-linear one's; ours lacks the advection, which
// costs it some 15 %.
// Source: C. E. Synolakis, "The runup of solitary waves", J. Fluid Mech. 185, 1987.
TEST(ShallowWater, RunsUpABeachAsSynolakisSays) {
  constexpr double kSlope = 19.85, kHeight = 0.0185;  // of a depth of 1 m
  // The shore is at x = 0, the toe at -19.85.
  SolverSpec spec = Spec(1024, 64, 0.08, 1.0 / 100.0,
                         [](double x, double) { return std::max(-1.0, (x - 35.0) / kSlope); });
  ShallowScene scene(spec);
  const double gamma = std::sqrt(0.75 * kHeight);
  const double centre = 35.0 - kSlope - std::acosh(std::sqrt(20.0)) / gamma;
  const auto shape = [&](double x) {
    return kHeight / std::pow(std::cosh(gamma * (x - centre)), 2);
  };
  scene.SetLevel([&](double x, double) { return shape(x); });
  scene.SetVelocity(
      [&](double x, double) {
        return x < 35.0 - kSlope
                   ? shape(x) * std::sqrt(sea::kGravity)
                   : shape(x) * std::sqrt(sea::kGravity / std::max(0.05, (35.0 - x) / kSlope));
      },
      [](double, double) { return 0.0; });
  float run_up_m = 0.0f;
  for (int n = 0; n < 250; ++n) {
    scene.Run(10);
    for (const float h : scene.solver->height_m()) run_up_m = std::max(run_up_m, h);
  }
  const double law = 2.831 * std::sqrt(kSlope) * std::pow(kHeight, 1.25);
  EXPECT_NEAR(run_up_m / law, 1.0, 0.2);
}

TEST(ShallowWater, WallsReflectAndKeepVolume) {
  SolverSpec spec = Spec(256, 64, 1.0, 1.0 / 60.0, [](double, double) { return -4.0; });
  ShallowScene scene(spec);
  scene.SetLevel([](double x, double) { return 0.01 * std::exp(-std::pow((x + 60) / 8, 2)); });
  std::vector<float> solid(scene.cells());
  for (int j = 0; j < 64; ++j) solid[scene.At(128, j)] = 1.0f;  // x = 0
  const double volume_m3 = scene.Volume();
  scene.Run(60 * 12, {.solid = solid});
  EXPECT_NEAR(scene.Volume() / volume_m3, 1.0, 1e-6);
  float west_m = 0.0f, east_m = 0.0f;
  for (int i = 0; i < 256; ++i) {
    (i < 128 ? west_m : east_m) = std::max(i < 128 ? west_m : east_m, std::abs(scene.Level(i, 32)));
  }
  EXPECT_EQ(east_m, 0.0f);
  EXPECT_NEAR(west_m, 0.005, 0.0005);  // two pulses of half the height, one reflected
}

// A half-solid cell lets the same wave through whether the second has 60 steps or 240.
TEST(ShallowWater, SolidsDontDependOnTheNumberOfSteps) {
  const auto passed = [](double step_s, bool held) {
    SolverSpec spec = Spec(256, 64, 1.0, step_s, [](double, double) { return -4.0; });
    ShallowScene scene(spec);
    scene.SetLevel([](double x, double) { return 0.01 * std::exp(-std::pow((x + 40) / 8, 2)); });
    std::vector<float> solid(scene.cells()), rest(scene.cells());
    for (int j = 0; j < 64; ++j) solid[scene.At(128, j)] = solid[scene.At(129, j)] = 0.6f;
    StepForcing forcing{.solid = solid};
    if (held) forcing.rest_height_m = rest;
    scene.Run(static_cast<int>(std::lround(10.0 / step_s)), forcing);
    float peak_m = 0.0f;
    for (int i = 131; i < 256; ++i) peak_m = std::max(peak_m, scene.Level(i, 32));
    return peak_m;
  };
  for (const bool held : {false, true}) {
    const float coarse_m = passed(1.0 / 60.0, held), fine_m = passed(1.0 / 240.0, held);
    EXPECT_GT(fine_m, 1e-4f);
    EXPECT_LT(fine_m, 0.0049f);
    EXPECT_NEAR(coarse_m / fine_m, 1.0, 0.03) << "held " << held;
  }
}

// Water whose total must stand still in a solid is held at minus the incident sea, to the bit, and
// behind a wall the held wave cancels the incident one.
TEST(ShallowWater, HoldsSolidsAtTheirRestHeight) {
  SolverSpec spec = Spec(256, 64, 1.0, 1.0 / 60.0, [](double, double) { return -4.0; });
  spec.edge_cells = 0;
  ShallowScene scene(spec);
  std::vector<float> solid(scene.cells()), rest(scene.cells());
  for (int j = 0; j < 64; ++j) solid[scene.At(128, j)] = 1.0f;
  const double c = std::sqrt(sea::kGravity * 4.0);
  const auto incident = [&](double x, double t) { return 0.01 * std::sin(0.15 * (x - c * t)); };
  for (int n = 1; n <= 600; ++n) {
    for (int j = 0; j < 64; ++j)
      rest[scene.At(128, j)] = static_cast<float>(-incident(0, n / 60.0));
    scene.Run(1, {.solid = solid, .rest_height_m = rest});
  }
  EXPECT_EQ(scene.Level(128, 20), rest[scene.At(128, 20)]);
  for (int i = 129; i < 168; ++i) {
    EXPECT_NEAR(scene.Level(i, 20) + incident(i - 128, 10.0), 0.0, 5e-4) << i;
  }
}

}  // namespace
}  // namespace onesea::world
