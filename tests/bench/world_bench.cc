// Steps of the interaction layer's solvers on 256 x 256 cells, beside the loops that are commonly
// published for them, in the same run.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "common/base/check.h"
#include "server/world/interaction_layer.h"
#include "server/world/wave_solver.h"

namespace onesea::world {
namespace {

constexpr int kSide = 256;

std::shared_ptr<const sea::Terrain> Bay() {
  auto terrain = std::make_shared<sea::Terrain>();
  terrain->cell_m = 2.0;
  terrain->columns = terrain->rows = 65;
  for (int n = 0; n < 65 * 65; ++n) {
    const double x = n % 65 / 64.0, y = n / 65 / 64.0;
    terrain->elevation_m.push_back(
        static_cast<float>(-12.0 + 14.0 * x * x + 1.5 * std::sin(6.0 * y)));
  }
  return terrain;
}

void Step(benchmark::State& state, SolverKind kind, bool over_terrain) {
  SolverSpec spec;
  spec.kind = kind;
  spec.cells = {.columns = kSide, .rows = kSide, .cell_m = 0.5};
  spec.depth_m = kind == SolverKind::kIwave ? 0.0 : 3.0;
  if (over_terrain) spec.terrain = Bay();
  auto solver = MakeSolver(spec);
  ONESEA_CHECK(solver.ok()) << solver.status();
  std::vector<float> source(spec.cells.cells());
  for (std::size_t n = 0; n < source.size(); ++n) {
    source[n] = static_cast<float>(0.1 * std::sin(0.37 * static_cast<double>(n)));
  }
  (*solver)->Step({.source_m = source});
  for (auto _ : state) (*solver)->Step({});
  benchmark::DoNotOptimize((*solver)->height_m().data());
}
BENCHMARK_CAPTURE(Step, wave_equation, SolverKind::kWaveEquation, false)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Step, wave_equation_over_terrain, SolverKind::kWaveEquation, true)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Step, iwave, SolverKind::kIwave, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Step, iwave_over_terrain, SolverKind::kIwave, true)
    ->Unit(benchmark::kMicrosecond);

// What a region that moves costs once.
void Build(benchmark::State& state, SolverKind kind, bool over_terrain) {
  SolverSpec spec;
  spec.kind = kind;
  spec.cells = {.columns = kSide, .rows = kSide, .cell_m = 0.5};
  spec.depth_m = kind == SolverKind::kIwave ? 0.0 : 3.0;
  if (over_terrain) spec.terrain = Bay();
  for (auto _ : state) {
    auto solver = MakeSolver(spec);
    ONESEA_CHECK(solver.ok()) << solver.status();
    benchmark::DoNotOptimize(solver->get());
  }
}
BENCHMARK_CAPTURE(Build, wave_equation_over_terrain, SolverKind::kWaveEquation, true)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Build, iwave, SolverKind::kIwave, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Build, iwave_over_terrain, SolverKind::kIwave, true)
    ->Unit(benchmark::kMillisecond);

void Velocities(benchmark::State& state) {
  SolverSpec spec;
  spec.cells = {.columns = kSide, .rows = kSide, .cell_m = 0.5};
  auto solver = MakeSolver(spec);
  ONESEA_CHECK(solver.ok()) << solver.status();
  std::vector<float> x(spec.cells.cells()), y(x), z(x);
  for (auto _ : state) {
    (*solver)->Velocity(x, y, z);
    benchmark::DoNotOptimize(x.data());
  }
}
BENCHMARK(Velocities)->Unit(benchmark::kMicrosecond);

// A tick of a layer with one region and a wake in it, and what its readers pay.
void LayerTick(benchmark::State& state) {
  InteractionLayer layer({});
  const std::vector<RegionAsk> asks{{.id = 1, .columns = kSide, .rows = kSide, .centre_m = {}}};
  ONESEA_CHECK(layer.Place(asks).ok());
  for (auto _ : state) {
    ONESEA_CHECK(layer.Place(asks).ok());
    layer.AddPressure({3.0, 2.0}, 2.0, 2e4);
    layer.Step();
    benchmark::DoNotOptimize(layer.Snapshot(0));
  }
}
BENCHMARK(LayerTick)->Unit(benchmark::kMicrosecond);

void Heights(benchmark::State& state) {
  InteractionLayer layer({});
  const std::vector<RegionAsk> asks{{.id = 1, .columns = kSide, .rows = kSide, .centre_m = {}}};
  ONESEA_CHECK(layer.Place(asks).ok());
  layer.AddSource({0, 0}, 5.0, 10.0);
  layer.Step();
  const auto snapshot = layer.Snapshot(0);
  std::vector<Vec2d> places(1000);
  for (std::size_t n = 0; n < places.size(); ++n) {
    const auto i = static_cast<double>(n);
    places[n] = {50.0 * std::sin(0.37 * i), 50.0 * std::cos(0.91 * i)};
  }
  std::vector<double> heights(places.size());
  for (auto _ : state) {
    sea::InteractionHeights(*snapshot, places, heights);
    benchmark::DoNotOptimize(heights.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(places.size()));
}
BENCHMARK(Heights)->Unit(benchmark::kMicrosecond);

// The five-point update as it is commonly published, cell by cell.
#if defined(__GNUC__) && !defined(__clang__)
__attribute__((optimize("no-tree-vectorize")))
#endif
void PublishedWaveEquation(benchmark::State& state) {
  std::vector<float> height(kSide * kSide), before(height);
  for (std::size_t n = 0; n < height.size(); ++n) height[n] = 0.001f * static_cast<float>(n % 97);
  const float courant = 0.2f;
  for (auto _ : state) {
    for (int y = 1; y + 1 < kSide; ++y) {
      for (int x = 1; x + 1 < kSide; ++x) {
        const std::size_t at = static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x);
        const float sum = height[at - 1] + height[at + 1] + height[at - kSide] + height[at + kSide];
        before[at] = 0.999f * (courant * sum + (2.0f - 4.0f * courant) * height[at] - before[at]);
      }
    }
    height.swap(before);
    benchmark::DoNotOptimize(height.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(PublishedWaveEquation)->Unit(benchmark::kMicrosecond);

// The published iWave loop: 169 taps a cell, row by row, with a border that is left out; scalar, as
// it was written.
#if defined(__GNUC__) && !defined(__clang__)
__attribute__((optimize("no-tree-vectorize")))
#endif
void PublishedIwave(benchmark::State& state) {
  constexpr int kR = 6;
  std::vector<float> kernel(13 * 13), height(kSide * kSide), before(height), derivative(height);
  for (std::size_t n = 0; n < kernel.size(); ++n) kernel[n] = 1.0f / static_cast<float>(n + 1);
  for (std::size_t n = 0; n < height.size(); ++n) height[n] = 0.001f * static_cast<float>(n % 97);
  const float step = 1.0f / 60.0f, damping = 0.3f, gravity = 9.8f * step * step * 0.01f;
  for (auto _ : state) {
    for (int y = kR; y < kSide - kR; ++y) {
      for (int x = kR; x < kSide - kR; ++x) {
        float sum = 0.0f;
        for (int j = -kR; j <= kR; ++j) {
          for (int i = -kR; i <= kR; ++i) {
            sum += kernel[static_cast<std::size_t>((j + kR) * 13 + i + kR)] *
                   height[static_cast<std::size_t>((y + j) * kSide + x + i)];
          }
        }
        derivative[static_cast<std::size_t>(y * kSide + x)] = sum;
      }
    }
    for (std::size_t n = 0; n < height.size(); ++n) {
      const float now = height[n];
      height[n] = (now * (2.0f - damping * step) - before[n] - gravity * derivative[n]) /
                  (1.0f + damping * step);
      before[n] = now;
    }
    benchmark::DoNotOptimize(height.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(PublishedIwave)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace onesea::world
