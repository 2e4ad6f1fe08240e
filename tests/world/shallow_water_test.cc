// The shallow-water solver over flat and gently sloping bottoms: waves.
#include "server/world/shallow_water.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <string>

#include "common/sea/constants.h"
#include "hwy/targets.h"
#include "tests/world/shallow_scene.h"

namespace onesea::world {
namespace {

SolverSpec Flat(int columns, int rows, double depth_m, double step_s = 1.0 / 60.0) {
  SolverSpec spec;
  spec.kind = SolverKind::kShallowWater;
  spec.cells = {.columns = columns, .rows = rows, .cell_m = 1.0};
  spec.depth_m = depth_m;
  spec.step_s = step_s;
  spec.edge_cells = 0;
  return spec;
}

// Oracle: on one mode cos(k x) cos(l y) of a closed basin a sweep is a 2 x 2 matrix of the theta
// scheme with the grid's frequency 2c/dx sin(k dx/2); the product of both is iterated in double.
void ExpectMode(double step_s, double theta, int m, int n) {
  SCOPED_TRACE(testing::Message() << "step " << step_s << " theta " << theta << " mode " << m << ' '
                                  << n);
  const int columns = 96, rows = 64;
  ShallowScene scene(Flat(columns, rows, 2.0, step_s), theta);
  const double k = m * sea::kPi / columns, l = n * sea::kPi / rows, amplitude_m = 1e-4;
  const auto mode = [&](double x, double y) {
    return std::cos(k * (x + 0.5)) * std::cos(l * (y + 0.5));
  };
  scene.SetLevel([&](double x, double y) { return amplitude_m * mode(x, y); });
  const double c = std::sqrt(sea::kGravity * 2.0);
  const double a = 2.0 * c * std::sin(k / 2) * step_s, b = 2.0 * c * std::sin(l / 2) * step_s;
  double eta = 1.0, u = 0.0, v = 0.0;  // u, v scaled to the energy of eta
  const auto sweep = [theta](double w, double& level, double& speed) {
    // level' = level - w (θ speed' + (1-θ) speed), speed' = speed + w (θ level' + (1-θ) level)
    const double explicit_level = level - w * (1 - theta) * speed;
    const double explicit_speed = speed + w * (1 - theta) * level;
    level = (explicit_level - w * theta * explicit_speed) / (1 + w * w * theta * theta);
    speed = explicit_speed + w * theta * level;
  };
  double norm = 0.0;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) norm += std::pow(mode(i, j), 2);
  }
  for (int step = 1; step <= 200; ++step) {
    scene.Run(1);
    sweep(a, eta, u);
    sweep(b, eta, v);
    double found = 0.0;
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns; ++i) found += scene.Level(i, j) * mode(i, j);
    }
    // The depth moves with the wave, by 1e-4 of 2 m.
    ASSERT_NEAR(found / (norm * amplitude_m), eta, 1e-3) << "step " << step;
  }
}

TEST(ShallowWater, StandingWavesHaveThePeriodAndTheDecayOfTheThetaScheme) {
  for (const double theta : {0.5, kShallowTheta, 0.75, 1.0}) {
    ExpectMode(1.0 / 60.0, theta, 4, 0);
    ExpectMode(1.0 / 60.0, theta, 0, 3);
    ExpectMode(0.2, theta, 5, 7);
    ExpectMode(1.0, theta, 20, 11);  // three cells a step: any step is stable
  }
}

// (1 + θ²w²) of energy in 1 + (1-θ)²w²: at the default θ a wave of 4 s has 98 % after a minute.
TEST(ShallowWater, DefaultThetaHardlyDampsWaves) {
  const double w = 2 * sea::kPi / 4.0 / 60.0, theta = kShallowTheta;
  const double per_step = (1 + std::pow((1 - theta) * w, 2)) / (1 + theta * theta * w * w);
  EXPECT_GT(std::pow(per_step, 3600), 0.97);
}

TEST(ShallowWater, DampingIsAnEnergyRate) {
  SolverSpec spec = Flat(128, 64, 2.0);
  spec.damping_per_s = 0.1;
  ShallowScene scene(spec, 0.5);
  const double k = 4 * sea::kPi / 128;
  scene.SetLevel([&](double x, double) { return 1e-3 * std::cos(k * (x + 0.5)); });
  const double omega = k * std::sqrt(sea::kGravity * 2.0), period_s = 2 * sea::kPi / omega;
  scene.Run(static_cast<int>(std::lround(5 * period_s * 60)));
  EXPECT_NEAR(scene.Level(0, 10) / 1e-3, std::exp(-0.1 * 5 * period_s / 2), 0.02);
}

double Centroid(const ShallowScene& scene, int first) {
  double sum = 0.0, moment = 0.0;
  for (int i = first; i < scene.columns(); ++i) {
    sum += scene.Level(i, 32);
    moment += i * double{scene.Level(i, 32)};
  }
  return moment / sum;
}

TEST(ShallowWater, PulsesRunAtSqrtGd) {
  ShallowScene scene(Flat(512, 64, 5.0));
  scene.SetLevel([](double x, double) { return 1e-3 * std::exp(-std::pow((x - 128) / 12, 2)); });
  scene.Run(600);  // 10 s
  EXPECT_NEAR((Centroid(scene, 128) - 128) / 10.0, std::sqrt(sea::kGravity * 5.0), 0.03);
}

// Green's law: a long wave on a slow slope keeps its energy flux, so its height goes as d^-1/4.
TEST(ShallowWater, ShoalsByGreensLaw) {
  SolverSpec spec = Flat(1024, 64, 0.0);
  spec.terrain = TerrainOf(spec.cells, [](double x, double) {
    return -10.0 + 7.5 * std::clamp((x - 300) / 550, 0.0, 1.0);
  });
  ShallowScene scene(spec);
  const auto shape = [](double x) { return 1e-3 * std::exp(-std::pow((x - 160) / 25, 2)); };
  const double c = std::sqrt(sea::kGravity * 10.0);
  scene.SetLevel([&](double x, double) { return shape(x); });
  scene.SetVelocity([&](double x, double) { return shape(x) * c / 10.0; },
                    [](double, double) { return 0.0; });
  float peak_m = 0.0f;
  for (int n = 0; n < 108 * 60; n += 30) {
    scene.Run(30);
    peak_m = std::max(peak_m, scene.Level(900, 32));
  }
  EXPECT_NEAR(peak_m / 1e-3, std::pow(10.0 / 2.5, 0.25), 0.02);
}

TEST(ShallowWater, VelocityBelongsToTheWave) {
  ShallowScene scene(Flat(512, 64, 4.0));
  const auto shape = [](double x) { return 0.01 * std::exp(-std::pow((x - 200) / 20, 2)); };
  const double c = std::sqrt(sea::kGravity * 4.0);
  scene.SetLevel([&](double x, double) { return shape(x); });
  scene.SetVelocity([&](double x, double) { return shape(x) * c / 4.0; },
                    [](double, double) { return 0.0; });
  scene.Run(300);
  std::vector<float> x(scene.cells()), y(x), z(x);
  scene.solver->Velocity(x, y, z);
  for (int i = 150; i < 350; ++i) {
    const std::size_t at = scene.At(i, 20);
    EXPECT_NEAR(x[at], scene.Level(i, 20) * std::sqrt(sea::kGravity / 4.0), 2e-4);
    EXPECT_EQ(y[at], 0.0f);
    // Travelling to the east, dη/dt = -c dη/dx.
    const double slope = 0.5 * (scene.Level(i + 1, 20) - scene.Level(i - 1, 20));
    EXPECT_NEAR(z[at], -c * slope, 2e-4);
  }
}

// Oracle: the same wave in a basin so large that nothing has come back from its walls. The waves
// are round and their reflections cross.
TEST(ShallowWater, EdgesTakeWavesOfAnyLength) {
  for (const double width_m : {4.0, 16.0}) {
    const auto pulse = [&](double x, double y) {
      return 0.01 * std::exp(-(std::pow(x - 100, 2) + std::pow(y - 128, 2)) / (width_m * width_m));
    };
    SolverSpec spec = Flat(256, 256, 5.0);
    spec.edge_cells = 16;
    ShallowScene scene(spec);
    spec.cells = {.west = -160, .south = -128, .columns = 576, .rows = 512, .cell_m = 1.0};
    spec.edge_cells = 0;
    ShallowScene vast(spec);
    scene.SetLevel(pulse);
    vast.SetLevel(pulse);
    float incident_m = 0.0f, error_m = 0.0f;
    for (int second = 1; second <= 22; ++second) {
      scene.Run(60);
      vast.Run(60);
      for (int j = 16; j < 240; ++j) {
        incident_m = std::max(incident_m, std::abs(vast.Level(176, j + 128)));
        for (int i = 16; i < 240; ++i) {
          const float exact_m = vast.Level(i + 160, j + 128);
          error_m = std::max(error_m, std::abs(scene.Level(i, j) - exact_m));
        }
      }
    }
    RecordProperty("reflected_" + std::to_string(static_cast<int>(width_m)),
                   std::to_string(error_m / incident_m));
    EXPECT_LT(error_m, 0.15 * incident_m) << "pulse of " << width_m << " m";
  }
}

// A head of p lowers the level by p where it rests: η + p is flat.
TEST(ShallowWater, PressurePressesTheLevelDown) {
  SolverSpec spec = Flat(128, 128, 3.0);
  spec.edge_cells = 16;
  spec.damping_per_s = 0.3;
  ShallowScene scene(spec);
  std::vector<float> head(scene.cells());
  for (int j = 0; j < 128; ++j) {
    for (int i = 0; i < 128; ++i) {
      head[scene.At(i, j)] =
          static_cast<float>(0.05 * std::exp(-(std::pow(i - 64, 2) + std::pow(j - 64, 2)) / 100.0));
    }
  }
  scene.Run(60 * 60, {.pressure_head_m = head});
  EXPECT_NEAR(scene.Level(64, 64), -0.05, 1e-4);
  EXPECT_NEAR(scene.Level(70, 60), -head[scene.At(70, 60)], 1e-4);
}

std::vector<float> Busy(ShallowScene& scene, int steps) {
  std::vector<float> source(scene.cells()), head(source), solid(source), rest(source);
  for (std::size_t n = 0; n < source.size(); ++n) {
    source[n] = n % 977 == 0 ? 0.01f : 0.0f;
    head[n] = n % 1409 == 0 ? 0.02f : 0.0f;
    solid[n] = n % 613 == 0 ? 1.0f : n % 411 == 0 ? 0.3f : 0.0f;
    rest[n] = -0.01f;
  }
  for (int n = 0; n < steps; ++n) {
    scene.Run(1, {.source_m = source});
    scene.Run(1, {.pressure_head_m = head, .solid = solid});
    scene.Run(1, {.solid = solid, .rest_height_m = rest});
  }
  return scene.state;
}

SolverSpec Rough() {
  SolverSpec spec = Flat(160, 96, 0.0);
  spec.cells.west = -40;
  spec.edge_cells = 12;
  spec.terrain = TerrainOf(spec.cells, [](double x, double y) {
    return -2.0 + 2.5 * std::sin(0.11 * x) * std::cos(0.07 * y) + 0.5 * std::sin(1.9 * x + y);
  });
  return spec;
}

TEST(ShallowWater, HasTheSameBitsOnEverySimdTarget) {
  std::vector<std::vector<float>> states;
  for (std::int64_t targets = hwy::SupportedTargets(), t; targets != 0; targets &= ~t) {
    t = targets & -targets;
    hwy::SetSupportedTargetsForTest(t);
    ShallowScene scene(Rough());
    states.push_back(Busy(scene, 40));
    EXPECT_EQ(states.back(), states.front()) << hwy::TargetName(t);
  }
  hwy::SetSupportedTargetsForTest(0);
  EXPECT_GT(states.size(), 1u);
}

TEST(ShallowWater, RestoreOfStateIsTheIdentity) {
  ShallowScene scene(Rough()), twin(Rough());
  Busy(scene, 20);
  twin.solver->Restore(scene.state);
  EXPECT_EQ(twin.solver->State(), scene.state);
  EXPECT_TRUE(std::ranges::equal(twin.solver->height_m(), scene.solver->height_m()));
  EXPECT_EQ(Busy(twin, 5), Busy(scene, 5));
}

TEST(ShallowWater, MovesWithoutLosingAWave) {
  SolverSpec spec = Flat(128, 96, 3.0);
  ShallowScene before(spec);
  before.SetLevel([](double x, double y) {
    return 0.02 * std::exp(-(std::pow(x - 80, 2) + std::pow(y - 50, 2)) / 50.0);
  });
  before.Run(60);
  spec.cells.west = 32;
  spec.cells.columns = 160;
  ShallowScene after(spec);
  after.solver->Adopt(*before.solver);
  before.Run(60);
  after.Run(60);
  for (int j = 0; j < 96; ++j) {
    for (int i = 40; i < 128; ++i) {
      // Waves reach x = 32 and 128 only as the tails of an implicit solution.
      ASSERT_NEAR(after.Level(i - 32, j), before.Level(i, j), 1e-8) << i << ' ' << j;
    }
  }
  EXPECT_GT(std::abs(before.solver->height_m()[50 * 128 + 80]), 1e-4f);
}

TEST(ShallowWater, RefusalsNameTheField) {
  const auto message = [](SolverSpec spec, double theta) {
    return std::string(MakeShallowWater(spec, theta).status().message());
  };
  EXPECT_THAT(message(Flat(64, 64, 0.0), 0.5), testing::HasSubstr("region.depth_m"));
  EXPECT_THAT(message(Flat(64, 64, 1.0), 0.4), testing::HasSubstr("region.theta"));
  EXPECT_THAT(message(Flat(65, 64, 1.0), 0.5), testing::HasSubstr("multiples of 32"));
  SolverSpec spec = Flat(64, 64, 1.0);
  spec.terrain = std::make_shared<sea::Terrain>();
  EXPECT_THAT(message(spec, 0.5), testing::HasSubstr("terrain."));
}

}  // namespace
}  // namespace onesea::world
