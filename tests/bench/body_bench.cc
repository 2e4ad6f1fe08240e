// Forces on hulls: the stepping path against a plain scalar loop in the same run.
#include <benchmark/benchmark.h>

#include <cmath>

#include "server/world/hull_shapes.h"
#include "server/world/wet_hull.h"
#include "tests/bench/thread_seconds.h"
#include "tests/world/regular_wave_patch.h"

namespace onesea::world {
namespace {

constexpr double kRho = 1025.0;

WaterPatch Sea(int bands) {
  WaterPatch patch;
  if (bands == 0) return patch;
  // As the world samples the water around a hull of 2 m radius.
  patch.cell_m = 0.92, patch.corner_m = {-2.3, -2.3};
  patch.Resize(6, 6, bands);
  for (int b = 0; b < bands; ++b) {
    const RegularWave wave{.amplitude_m = 0.1 / (1 + b),
                           .wavenumber_rad_per_m = 0.05 * std::pow(1.6, b),
                           .to_rad = 0.7 * b};
    wave.Fill(3.0, patch, b);
  }
  return patch;
}

// The usual way: every triangle by itself, its corners sampled anew, libm's exp.
Vec3d ScalarForce(const TriangleMesh& mesh, const HullMotion& motion, const WaterPatch& patch,
                  const wire::Drag& drag) {
  const Mat3d turn = ToMatrix(motion.pose.turn);
  Vec3d total;
  for (const auto& t : mesh.triangles) {
    Vec3d corner[3], water[3];
    double head[3], depth[3];
    for (int k = 0; k < 3; ++k) {
      corner[k] = motion.pose.centre_m + turn * mesh.vertices[t[k]];
      const double u = (corner[k].x - patch.corner_m.x) / patch.cell_m,
                   v = (corner[k].y - patch.corner_m.y) / patch.cell_m;
      const int i = patch.bands ? std::clamp(static_cast<int>(u), 0, patch.columns - 2) : 0;
      const int j = patch.bands ? std::clamp(static_cast<int>(v), 0, patch.rows - 2) : 0;
      double field[kWaterBandsMax][4], height = 0;
      for (int b = 0; b < patch.bands; ++b) {
        for (int c = 0; c < 4; ++c) {
          const auto at = [&](int di, int dj) {
            return double{
                patch.samples[4 * (patch.bands * ((j + dj) * patch.columns + i + di) + b) + c]};
          };
          const double wu = u - i, wv = v - j;
          field[b][c] = (1 - wv) * ((1 - wu) * at(0, 0) + wu * at(1, 0)) +
                        wv * ((1 - wu) * at(0, 1) + wu * at(1, 1));
        }
        height += field[b][0];
      }
      depth[k] = height - corner[k].z;
      head[k] = depth[k];
      water[k] = {};
      for (int b = 0; b < patch.bands; ++b) {
        const double e = std::exp(-patch.wavenumber_rad_per_m[b] * std::max(0.0, depth[k]));
        head[k] -= field[b][0] * (1 - e);
        water[k] = water[k] + e * Vec3d{field[b][1], field[b][2], field[b][3]};
      }
    }
    if (depth[0] <= 0 && depth[1] <= 0 && depth[2] <= 0) continue;
    const Vec3d twice = Cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double area = 0.5 * Norm(twice);
    const Vec3d n = (0.5 / area) * twice;
    for (int k = 0; k < 3; ++k) {
      total = total - (kRho * 9.81 * area / 3 * std::max(0.0, head[k])) * n;
    }
    const Vec3d w = (1.0 / 3) * (water[0] + water[1] + water[2]) - motion.velocity_m_per_s;
    const double into = -Dot(w, n), speed = Norm(w);
    const Vec3d tangent = w + into * n;
    total = total + (0.5 * kRho * area * drag.friction * speed) * tangent -
            (0.5 * kRho * area * (into > 0 ? drag.pressure : -drag.suction) * into * into) * n;
  }
  return total;
}

// A boat of some hundred or some thousand triangles, half under water.
void Buoyancy(benchmark::State& state) {
  const WaterPatch patch = Sea(static_cast<int>(state.range(0)));
  const TriangleMesh mesh = SphereMesh(2.0, static_cast<int>(state.range(1)));
  const WetHull hull(mesh, {});
  const HullMotion motion{.pose = {{0.1, 0.2, 0}, AboutAxis({1, 0, 0}, 0.3)},
                          .velocity_m_per_s = {3, 0.2, 0.1},
                          .spin_rad_per_s = {0.1, 0.2, 0.3}};
  WetScratch scratch;
  int wet = 0;
  for (auto _ : state) {
    wet = hull.Evaluate(motion, patch, kRho, {}, scratch).wet_triangles;
    benchmark::DoNotOptimize(wet);
  }
  const double fast = MedianThreadSeconds(
      [&] { benchmark::DoNotOptimize(hull.Evaluate(motion, patch, kRho, {}, scratch)); });
  const double plain =
      MedianThreadSeconds([&] { benchmark::DoNotOptimize(ScalarForce(mesh, motion, patch, {})); });
  state.counters["wet"] = wet;
  state.counters["ns_per_wet_triangle"] = 1e9 * fast / wet;
  state.counters["plain_ns"] = 1e9 * plain / wet;
  state.counters["times_plain"] = plain / fast;
}
BENCHMARK(Buoyancy)->ArgsProduct({{0, 5, 9}, {8, 32}})->Iterations(50);

}  // namespace
}  // namespace onesea::world
