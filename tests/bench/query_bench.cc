// Point queries: vectorised against a plain scalar loop in the same run.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/sea/attenuation.h"
#include "common/sea/point_query.h"
#include "tests/bench/thread_seconds.h"
#include "tests/sea/fake_sea.h"

namespace onesea::sea {
namespace {

std::vector<Vec2d> RandomPoints(int count) {
  std::uint64_t random = 5;
  std::vector<Vec2d> points(count);
  for (Vec2d& p : points) p = {2000.0 * NextUnit(random), 2000.0 * NextUnit(random)};
  return points;
}

// The usual way: floor, wrap and bilinear, four fixed-point iterations, then the height.
struct ScalarReference {
  explicit ScalarReference(const Components& sea) : rotation(sea.cascades[0].cascade.rotation_rad) {
    const auto shared = std::make_shared<Components>(sea);
    Synthesiser synthesiser(shared, 0, 256, kQueryFields);
    synthesiser.Evaluate(SimTime{}, fields);
    cells_per_m = static_cast<float>(256.0 / sea.cascades[0].cascade.length_m);
    cosine = static_cast<float>(std::cos(rotation)), sine = static_cast<float>(std::sin(rotation));
  }
  float Read(Field field, float px, float py) const {
    const float* plane = fields.Plane(field).data();
    const float u = (cosine * px + sine * py) * cells_per_m,
                v = (cosine * py - sine * px) * cells_per_m;
    const float fu = std::floor(u), fv = std::floor(v);
    const int x0 = static_cast<int>(fu) & 255, y0 = static_cast<int>(fv) & 255;
    const int x1 = (x0 + 1) & 255, y1 = (y0 + 1) & 255;
    const float a = plane[y0 * 256 + x0] + (u - fu) * (plane[y0 * 256 + x1] - plane[y0 * 256 + x0]);
    const float b = plane[y1 * 256 + x0] + (u - fu) * (plane[y1 * 256 + x1] - plane[y1 * 256 + x0]);
    return a + (v - fv) * (b - a);
  }
  float Height(Vec2d x) const {
    const auto x0 = static_cast<float>(x.x), y0 = static_cast<float>(x.y);
    float px = x0, py = y0;
    for (int n = 0; n < 4; ++n) {
      const float dx = Read(Field::kDisplacementX, px, py),
                  dy = Read(Field::kDisplacementY, px, py);
      px = x0 - dx;
      py = y0 - dy;
    }
    return Read(Field::kHeight, px, py);
  }
  double rotation;
  CascadeFields fields{256, kQueryFields};
  float cells_per_m, cosine, sine;
};

void Report(benchmark::State& state, const std::vector<Vec2d>& points, double seconds) {
  state.counters["ns_per_point"] = 1e9 * seconds / static_cast<double>(points.size());
  state.counters["Mpoints_per_s"] = 1e-6 * static_cast<double>(points.size()) / seconds;
}

void BM_OneCascadeHeight(benchmark::State& state) {
  const auto sea = FakeSea({.lengths_m = {250.0}, .hs_m = 2.1});
  SnapshotBuilder builder(sea);
  const auto snapshot = builder.At(SimTime{}, QueryDetail::kHeight);
  const auto points = RandomPoints(16384);
  std::vector<SurfaceSample> out(points.size());
  const auto run = [&] { snapshot->Sample(points, out); };
  for (auto _ : state) run();
  const ScalarReference reference(*sea);
  double own_s = 1e9, scalar_s = 1e9;
  for (int round = 0; round < 5; ++round) {
    own_s = std::min(own_s, MedianThreadSeconds(run));
    scalar_s = std::min(scalar_s, MedianThreadSeconds([&] {
                          float sum = 0;
                          for (const Vec2d& p : points) sum += reference.Height(p);
                          benchmark::DoNotOptimize(sum);
                        }));
  }
  Report(state, points, own_s);
  state.counters["scalar_ns"] = 1e9 * scalar_s / static_cast<double>(points.size());
  state.counters["times_scalar"] = scalar_s / own_s;
}
BENCHMARK(BM_OneCascadeHeight)->Unit(benchmark::kMicrosecond);

void BM_FourCascades(benchmark::State& state) {
  const auto sea = FakeSea({.hs_m = static_cast<double>(state.range(1))});
  SnapshotBuilder builder(sea);
  const auto snapshot = builder.At(SimTime{}, static_cast<QueryDetail>(state.range(0)));
  const auto points = RandomPoints(16384);
  std::vector<SurfaceSample> out(points.size());
  const auto run = [&] { snapshot->Sample(points, out); };
  for (auto _ : state) run();
  Report(state, points, MedianThreadSeconds(run));
  state.counters["folded"] = static_cast<double>(std::count_if(
                                 out.begin(), out.end(), [](const auto& s) { return s.folded; })) /
                             static_cast<double>(out.size());
}
BENCHMARK(BM_FourCascades)
    ->ArgNames({"detail", "hs"})
    ->Args({1, 1})
    ->Args({1, 3})
    ->Args({3, 1})
    ->Unit(benchmark::kMicrosecond);

// Against the open sea in the same run.
void BM_OverTerrain(benchmark::State& state) {
  auto terrain = std::make_shared<Terrain>();
  *terrain = {
      .west_m = 0, .south_m = 0, .cell_m = 5, .columns = 401, .rows = 401, .elevation_m = {}};
  for (int n = 0; n < 401 * 401; ++n) {
    terrain->elevation_m.push_back(static_cast<float>(-25.0 + 0.06 * (n % 401)));
  }
  const auto open = FakeSea({.hs_m = 1.0, .depth_m = 25.0});
  const auto sea = OverTerrain(open, terrain);
  const auto detail = static_cast<QueryDetail>(state.range(0));
  const auto over = SnapshotBuilder(sea).At(SimTime{}, detail);
  const auto without = SnapshotBuilder(open).At(SimTime{}, detail);
  const auto points = RandomPoints(16384);
  std::vector<SurfaceSample> out(points.size());
  for (auto _ : state) over->Sample(points, out);
  double over_s = 1e9, open_s = 1e9;
  for (int round = 0; round < 5; ++round) {
    over_s = std::min(over_s, MedianThreadSeconds([&] { over->Sample(points, out); }));
    open_s = std::min(open_s, MedianThreadSeconds([&] { without->Sample(points, out); }));
  }
  Report(state, points, over_s);
  state.counters["open_ns"] = 1e9 * open_s / static_cast<double>(points.size());
}
BENCHMARK(BM_OverTerrain)->ArgName("detail")->Arg(1)->Arg(3)->Unit(benchmark::kMicrosecond);

void BM_TerrainFactors(benchmark::State& state) {
  const auto open = FakeSea({.depth_m = 25.0});
  auto terrain = std::make_shared<Terrain>();
  *terrain = {
      .west_m = 0, .south_m = 0, .cell_m = 5, .columns = 401, .rows = 401, .elevation_m = {}};
  terrain->elevation_m.assign(401 * 401, -12.0f);
  const double build_s = MedianThreadSeconds([&] { OverTerrain(open, terrain); });
  const auto sea = OverTerrain(open, terrain);
  const std::vector<double> weights = {1.0};
  for (auto _ : state) benchmark::DoNotOptimize(sea->attenuation->At(weights));
  state.counters["build_ms"] = 1e3 * build_s;
}
BENCHMARK(BM_TerrainFactors)->Unit(benchmark::kMillisecond);

void BM_Snapshot(benchmark::State& state) {
  const auto sea = FakeSea();
  SnapshotBuilder builder(sea);
  const auto detail = static_cast<QueryDetail>(state.range(0));
  std::shared_ptr<const SeaSnapshot> snapshot;
  std::int64_t tick = 0;
  for (auto _ : state) {
    snapshot = builder.At(TimeOfTick(++tick, 60), detail, std::move(snapshot));
  }
}
BENCHMARK(BM_Snapshot)->ArgName("detail")->Arg(1)->Arg(3)->Unit(benchmark::kMicrosecond);

void BM_Depth(benchmark::State& state) {
  const auto sea = FakeSea({.depth_m = static_cast<double>(state.range(0))});
  const auto points = RandomPoints(64);
  const std::vector<double> depths(points.size(), 2.0);
  std::vector<DepthSample> out(points.size());
  const auto run = [&] { SampleAtDepth(*sea, SimTime{12345}, points, depths, out); };
  for (auto _ : state) run();
  Report(state, points, MedianThreadSeconds(run));
}
BENCHMARK(BM_Depth)->ArgName("water_m")->Arg(0)->Arg(20)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace onesea::sea
