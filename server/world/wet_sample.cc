// The water at a hull's vertices, many at once.
//
// Places of vertices and their velocities: lanes of doubles. The waves in each depth: lanes are
// depths, all bands are summed. Then each vertex reads two depths of four records side by side, so
// that no gather is needed. Nothing is fused: the same bits on every SIMD target.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/world/wet_sample.cc"
#include "hwy/foreach_target.h"
//
#include <algorithm>

#include "hwy/highway.h"
#include "server/world/wet_kernel.h"
#include "server/world/wet_vector-inl.h"

HWY_BEFORE_NAMESPACE();
namespace onesea::world {
namespace HWY_NAMESPACE {
using namespace wet;

using DF = hn::CappedTag<float, 16>;
constexpr int kDepths = WaterProfile::kDepths, kRecord = WaterProfile::kRecord;
constexpr float kLast = kDepths - 1;

// As in water_patch.cc, operation by operation.
HWY_INLINE hn::Vec<DF> ExpMinus(hn::Vec<DF> x) {
  const DF d;
  const hn::RebindToSigned<DF> di;
  const auto turns = hn::Mul(hn::Min(x, hn::Set(d, 80.0f)), hn::Set(d, 1.44269504f));
  const auto whole = hn::ConvertTo(di, hn::Add(turns, hn::Set(d, 0.5f)));
  const auto g = hn::Mul(hn::Sub(turns, hn::ConvertTo(d, whole)), hn::Set(d, -0.693147181f));
  auto p = hn::Set(d, 1.0f / 720.0f);
  for (const float c : {1.0f / 120.0f, 1.0f / 24.0f, 1.0f / 6.0f, 0.5f, 1.0f, 1.0f}) {
    p = hn::Add(hn::Mul(p, g), hn::Set(d, c));
  }
  const auto power = hn::ShiftLeft<23>(hn::Sub(hn::Set(di, 127), whole));
  return hn::Mul(p, hn::BitCast(d, power));
}

// cosh k(H - d) / cosh kH and sinh k(H - d) / sinh kH, or exp(-kd), of all bands.
struct alignas(64) Fading {
  float along[16], up[16];
};
HWY_INLINE void FadeAt(const WaterSampler& sampler, float depth_m, Fading& out) {
  const DF d;
  for (int b = 0; b < sampler.patch->bands; b += static_cast<int>(hn::Lanes(d))) {
    const auto decay = ExpMinus(hn::Mul(hn::LoadU(d, sampler.wavenumber + b), hn::Set(d, depth_m)));
    // At or below the bottom: what is left there.
    const auto down = hn::Max(decay, hn::LoadU(d, sampler.least_decay + b));
    const auto image = hn::Div(hn::LoadU(d, sampler.bottom_image + b), down);
    hn::Store(hn::Mul(hn::Add(down, image), hn::LoadU(d, sampler.per_sum + b)), d, out.along + b);
    hn::Store(hn::Mul(hn::Sub(down, image), hn::LoadU(d, sampler.per_difference + b)), d,
              out.up + b);
  }
}

// Four numbers, again and again.
HWY_INLINE hn::Vec<DF> LoadFour(const float* four, int lane) {
  const DF d;
  if constexpr (hn::MaxLanes(d) >= 4) {
    return hn::LoadDup128(d, four);
  } else {
    return hn::LoadU(d, four + lane % 4);
  }
}

// Heights of all samples. Returns the greatest.
HWY_INLINE float SumHeights(const WaterPatch& patch, WaterProfile& profile) {
  const int samples = patch.columns * patch.rows;
  float highest = -1e30f;
  for (int n = 0; n < samples; ++n) {
    const float* bands = patch.samples.data() + std::int64_t{4} * patch.bands * n;
    float height = 0.0f;
    for (int b = 0; b < patch.bands; ++b) height += bands[4 * b];
    profile.height_m[n] = height;
    highest = std::max(highest, height);
  }
  return highest;
}

HWY_INLINE void FillRecords(const WaterSampler& sampler, float deepest_m, WaterProfile& profile) {
  const DF d;
  const WaterPatch& patch = *sampler.patch;
  HWY_ALIGN float weight[kWaterBandsMax][kRecord];
  for (int n = 0; n < kDepths; ++n) {
    Fading fading;
    FadeAt(sampler, deepest_m * (static_cast<float>(n * n) / (kLast * kLast)), fading);
    for (int b = 0; b < patch.bands; ++b) {
      float* to = weight[b] + 4 * n;
      to[0] = to[1] = to[2] = fading.along[b];
      to[3] = fading.up[b];
    }
  }
  const int samples = patch.columns * patch.rows;
  for (int n = 0; n < samples; ++n) {
    const float* bands = patch.samples.data() + std::int64_t{4} * patch.bands * n;
    float* to = profile.record.get() + std::int64_t{kRecord} * n;
    for (int lane = 0; lane < kRecord; lane += static_cast<int>(hn::Lanes(d))) {
      auto sum = hn::Zero(d);
      for (int b = 0; b < patch.bands; ++b) {
        sum = hn::Add(sum, hn::Mul(LoadFour(bands + 4 * b, lane), hn::Load(d, weight[b] + lane)));
      }
      hn::Store(sum, d, to + lane);
    }
  }
}

// World heights of all vertices and their cells in the patch. Returns the least height.
double PlaceVertices(const WetMesh& mesh, const WetMotion& motion, const WaterSampler& sampler,
                     WetVertices& out) {
  const D d;
  const WaterPatch& patch = *sampler.patch;
  const auto& m = motion.turn.m;
  // The turn from the body's axes to those of the patch, in cells.
  const double c = patch.along.x * sampler.cells_per_m, s = patch.along.y * sampler.cells_per_m;
  const auto across = [&](double east, double north) {
    return Vec3d{east * m[0] + north * m[3], east * m[1] + north * m[4],
                 east * m[2] + north * m[5]};
  };
  const Vec2d from{motion.centre_m.x - patch.corner_m.x, motion.centre_m.y - patch.corner_m.y};
  const Vec3v to_column = SetAll(across(c, s)), to_row = SetAll(across(-s, c)),
              to_above = SetAll({m[6], m[7], m[8]});
  const V column = hn::Set(d, c * from.x + s * from.y), row = hn::Set(d, c * from.y - s * from.x),
          centre = hn::Set(d, motion.centre_m.z);
  const auto inside = [&](V at, int count) HWY_ATTR {
    return hn::Min(hn::Max(at, hn::Zero(d)), hn::Set(d, static_cast<double>(count - 1)));
  };
  V lowest = centre;
  for (std::size_t n = 0; n < mesh.vertices; n += hn::Lanes(d)) {
    const Vec3v place(hn::Load(d, mesh.x.get() + n), hn::Load(d, mesh.y.get() + n),
                      hn::Load(d, mesh.z.get() + n));
    const V above = hn::Add(centre, Product(to_above, place));
    lowest = hn::Min(lowest, above);
    hn::Store(above, d, out.above.get() + n);
    hn::Store(inside(hn::Add(column, Product(to_column, place)), patch.columns), d,
              out.column.get() + n);
    hn::Store(inside(hn::Add(row, Product(to_row, place)), patch.rows), d, out.row.get() + n);
  }
  return hn::GetLane(hn::MinOfLanes(d, lowest));
}

// Where a vertex lies between the samples of the profile.
struct Cell {
  int south_west;  // sample
  float east, north;
};
HWY_INLINE Cell CellOf(const WaterPatch& patch, const WetVertices& vertices, std::size_t n) {
  const double u = vertices.column[n], v = vertices.row[n];
  const int column = std::min(static_cast<int>(u), patch.columns - 2);
  const int row = std::min(static_cast<int>(v), patch.rows - 2);
  return {row * patch.columns + column, static_cast<float>(u - column),
          static_cast<float>(v - row)};
}

HWY_INLINE float HeightAt(const WaterProfile& profile, int columns, const Cell& cell) {
  const float* south = profile.height_m.get() + cell.south_west;
  const float* north = south + columns;
  const float a = south[0] + cell.east * (south[1] - south[0]);
  const float b = north[0] + cell.east * (north[1] - north[0]);
  return a + cell.north * (b - a);
}

// Head felt and velocity between depth `upper` and the next, `share` of the way down.
HWY_INLINE void WavesAt(const WaterProfile& profile, int columns, const Cell& cell, int upper,
                        float share, float* out) {
  const hn::CappedTag<float, 8> d;
  const hn::CappedTag<float, 4> d4;
  const float* south = profile.record.get() + std::int64_t{kRecord} * cell.south_west + 4 * upper;
  const float* north = south + std::int64_t{kRecord} * columns;
  const auto east = hn::Set(d, cell.east), up = hn::Set(d, cell.north);
  HWY_ALIGN float both[8];
  for (int n = 0; n < 8; n += static_cast<int>(hn::Lanes(d))) {
    const auto c00 = hn::LoadU(d, south + n), c10 = hn::LoadU(d, south + n + kRecord);
    const auto c01 = hn::LoadU(d, north + n), c11 = hn::LoadU(d, north + n + kRecord);
    const auto a = hn::Add(c00, hn::Mul(east, hn::Sub(c10, c00)));
    const auto b = hn::Add(c01, hn::Mul(east, hn::Sub(c11, c01)));
    hn::Store(hn::Add(a, hn::Mul(up, hn::Sub(b, a))), d, both + n);
  }
  for (int n = 0; n < 4; n += static_cast<int>(hn::Lanes(d4))) {
    const auto above = hn::Load(d4, both + n), below = hn::Load(d4, both + 4 + n);
    hn::Store(hn::Add(above, hn::Mul(hn::Set(d4, share), hn::Sub(below, above))), d4, out + n);
  }
}

// Depths of a block in the profile: that above each vertex, and the share of the way to the next.
HWY_INLINE void DepthsOf(const float* depth_m, float per_m, int* upper, float* share) {
  const hn::CappedTag<float, kWetBlock> d;
  const hn::RebindToSigned<decltype(d)> di;
  for (std::size_t n = 0; n < kWetBlock; n += hn::Lanes(d)) {
    const auto square =
        hn::Min(hn::Mul(hn::Max(hn::Load(d, depth_m + n), hn::Zero(d)), hn::Set(d, per_m)),
                hn::Set(d, kLast * kLast));
    const auto whole = hn::Min(hn::ConvertTo(di, hn::Sqrt(square)), hn::Set(di, kDepths - 2));
    const auto u = hn::ConvertTo(d, whole);
    hn::Store(whole, di, upper + n);
    hn::Store(hn::Div(hn::Sub(square, hn::Mul(u, u)), hn::Add(hn::Add(u, u), hn::Set(d, 1.0f))), d,
              share + n);
  }
}

// Water of one block of vertices, its velocity in world axes.
HWY_INLINE void SampleBlock(const WaterPatch& patch, float per_m, double dry_above_m,
                            std::size_t first, WetVertices& out, double (*water)[kWetBlock]) {
  Cell cells[kWetBlock];
  HWY_ALIGN float height[kWetBlock], depth[kWetBlock], share[kWetBlock];
  HWY_ALIGN int upper[kWetBlock];
  for (std::size_t n = 0; n < kWetBlock; ++n) {
    cells[n] = CellOf(patch, out, first + n);
    height[n] = HeightAt(out.profile, patch.columns, cells[n]);
    out.depth[first + n] = double{height[n]} - (out.above[first + n] - patch.level_m);
    depth[n] = static_cast<float>(out.depth[first + n]);
  }
  DepthsOf(depth, per_m, upper, share);
  for (std::size_t n = 0; n < kWetBlock; ++n) {
    const std::size_t at = first + n;
    HWY_ALIGN float waves[4] = {};
    if (out.above[at] > dry_above_m) {
      out.depth[at] = -1.0;
    } else {
      WavesAt(out.profile, patch.columns, cells[n], upper[n], share[n], waves);
    }
    const double lost = double{height[n]} - double{waves[0]};
    out.head[at] = out.depth[at] > 0.0 ? std::max(0.0, out.depth[at] - lost) : 0.0;
    water[0][n] = patch.current_m_per_s.x + double{waves[1]};
    water[1][n] = patch.current_m_per_s.y + double{waves[2]};
    water[2][n] = patch.current_m_per_s.z + double{waves[3]};
  }
}

// No waves: the level and the current.
HWY_INLINE void CalmBlock(const WaterPatch& patch, std::size_t first, WetVertices& out,
                          double (*water)[kWetBlock]) {
  for (std::size_t n = 0; n < kWetBlock; ++n) {
    out.depth[first + n] = patch.level_m - out.above[first + n];
    out.head[first + n] = std::max(0.0, out.depth[first + n]);
    water[0][n] = patch.current_m_per_s.x;
    water[1][n] = patch.current_m_per_s.y;
    water[2][n] = patch.current_m_per_s.z;
  }
}

// Of the water to the hull, body axes.
HWY_INLINE void SetRelative(const WetMesh& mesh, const WetMotion& motion, std::size_t first,
                            const double (*water)[kWetBlock], WetVertices& out) {
  const D d;
  const auto& m = motion.turn.m;
  const Vec3v velocity = SetAll(motion.velocity_m_per_s), spin = SetAll(motion.spin_rad_per_s);
  for (std::size_t n = 0; n < kWetBlock; n += hn::Lanes(d)) {
    const std::size_t at = first + n;
    const Vec3v place(hn::Load(d, mesh.x.get() + at), hn::Load(d, mesh.y.get() + at),
                      hn::Load(d, mesh.z.get() + at));
    const V u = hn::Load(d, water[0] + n), v = hn::Load(d, water[1] + n),
            w = hn::Load(d, water[2] + n);
    const auto column = [&](int c) HWY_ATTR {
      const V xy = hn::Add(hn::Mul(hn::Set(d, m[c]), u), hn::Mul(hn::Set(d, m[3 + c]), v));
      return hn::Add(xy, hn::Mul(hn::Set(d, m[6 + c]), w));
    };
    const Vec3v own = Sum(velocity, CrossOf(spin, place));
    hn::Store(hn::Sub(column(0), own.x), d, out.rx.get() + at);
    hn::Store(hn::Sub(column(1), own.y), d, out.ry.get() + at);
    hn::Store(hn::Sub(column(2), own.z), d, out.rz.get() + at);
  }
}

void SampleVerticesOf(const WetMesh& mesh, const WetMotion& motion, const WaterSampler& sampler,
                      WetVertices& out) {
  const WaterPatch& patch = *sampler.patch;
  const double lowest_m = PlaceVertices(mesh, motion, sampler, out);
  const bool waves = patch.bands > 0;
  double dry_above_m = 0.0;
  float per_m = 0.0f;  // of depth, squared depths of the profile
  if (waves) {
    out.profile.Reserve(static_cast<std::size_t>(patch.columns) * patch.rows);
    const double highest_m = patch.level_m + double{SumHeights(patch, out.profile)};
    dry_above_m = highest_m + 1.001 * motion.edge_max_m;
    const auto deepest_m = static_cast<float>(std::max(highest_m - lowest_m, 1e-3));
    FillRecords(sampler, deepest_m, out.profile);
    per_m = kLast * kLast / deepest_m;
  }
  HWY_ALIGN double water[3][kWetBlock];
  for (std::size_t first = 0; first < mesh.vertices; first += kWetBlock) {
    if (waves) {
      SampleBlock(patch, per_m, dry_above_m, first, out, water);
    } else {
      CalmBlock(patch, first, out, water);
    }
    SetRelative(mesh, motion, first, water, out);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace onesea::world
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace onesea::world {

HWY_EXPORT(SampleVerticesOf);

void WaterProfile::Reserve(std::size_t samples) {
  if (capacity >= samples) return;
  height_m = sea::AllocateZeros<float>(samples);
  record = sea::AllocateZeros<float>(kRecord * samples);
  capacity = samples;
}

void WetVertices::Reserve(const WetMesh& mesh) {
  if (capacity < mesh.vertices) {
    for (auto* array : {&depth, &head, &rx, &ry, &rz, &above, &column, &row}) {
      *array = sea::AllocateZeros<double>(mesh.vertices);
    }
    capacity = mesh.vertices;
  }
  if (triangle_capacity < mesh.triangles) {
    crossing = sea::AllocateZeros<std::int64_t>(mesh.triangles + kWetBlock);  // whole vectors
    triangle_capacity = mesh.triangles;
  }
}

void SampleVertices(const WetMesh& mesh, const WetMotion& motion, const WaterSampler& water,
                    WetVertices& out) {
  HWY_DYNAMIC_DISPATCH(SampleVerticesOf)(mesh, motion, water, out);
}

}  // namespace onesea::world
#endif  // HWY_ONCE
