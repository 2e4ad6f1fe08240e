// Forces on hulls, many vertices and triangles at once.
//
// Vertices: places by lanes of doubles; then each vertex reads four records of the patch, all bands
//   side by side, so that no gather is needed; decays by lanes of bands.
// Triangles: lanes are triangles, corners are gathered. Sums are kept in eight parts and joined in
//   one order, nothing is fused: the same bits on every SIMD target.
// Triangles that cross the surface are cut one by one (wet_hull.cc), the pieces summed likewise.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/world/wet_kernel.cc"
#include "hwy/foreach_target.h"
//
#include <algorithm>
#include <cstring>

#include "hwy/highway.h"
#include "server/world/wet_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace onesea::world {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, kWetBlock>;
using V = hn::Vec<D>;
using DF = hn::CappedTag<float, 16>;
constexpr int kRecordMax = 4 * kWaterBandsMax;

struct Vec3v {
  HWY_INLINE Vec3v() {}  // an implicit one would not get the target's attributes
  HWY_INLINE Vec3v(V a, V b, V c) : x(a), y(b), z(c) {}
  V x, y, z;
};
HWY_INLINE Vec3v Sum(Vec3v a, Vec3v b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Vec3v Scaled(V s, Vec3v a) {
  return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)};
}
HWY_INLINE V Product(Vec3v a, Vec3v b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE Vec3v CrossOf(Vec3v a, Vec3v b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)),
          hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
HWY_INLINE Vec3v SetAll(Vec3d v) {
  const D d;
  return {hn::Set(d, v.x), hn::Set(d, v.y), hn::Set(d, v.z)};
}

// As ExpMinus in water_sample-inl.h, operation by operation.
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

// exp(-kd) to cosh k(H - d) / cosh kH, and sinh k(H - d) / sinh kH.
HWY_INLINE void FeelTheBottom(const WaterSampler& sampler, float* decay, float* vertical) {
  const DF d;
  for (int b = 0; b < sampler.patch->bands; b += static_cast<int>(hn::Lanes(d))) {
    const auto image = hn::LoadU(d, sampler.bottom_image + b);
    const auto down = hn::Max(hn::Load(d, decay + b), hn::LoadU(d, sampler.least_decay + b));
    const auto up = hn::Div(image, down);
    hn::Store(hn::Mul(hn::Add(down, up), hn::LoadU(d, sampler.per_sum + b)), d, decay + b);
    hn::Store(hn::Mul(hn::Sub(down, up), hn::LoadU(d, sampler.per_difference + b)), d,
              vertical + b);
  }
}

struct Cell {
  std::int64_t offset;  // of its south-west record, in floats
  float wu, wv;
};

// What is known of the vertices of a block on the way. Each stage runs over all of them before the
// next begins, since each is a chain of additions that would wait for itself.
struct alignas(64) Samples {
  float bands[kWetBlock][kRecordMax + 16];  // the patch's record here
  float decay[kWetBlock][32], vertical[kWetBlock][32];
  float height[kWetBlock];
  bool far_above[kWetBlock];
};

HWY_INLINE void ReadRecord(const WaterPatch& patch, const Cell& cell, Samples& s, std::size_t v) {
  const DF d;
  const int record = 4 * patch.bands;
  const float* low = patch.samples.data() + cell.offset;
  const float* high = low + record * patch.columns;
  float* bands = s.bands[v];
  const auto wu = hn::Set(d, cell.wu), wv = hn::Set(d, cell.wv);
  for (int n = 0; n < record; n += static_cast<int>(hn::Lanes(d))) {
    const auto c00 = hn::LoadU(d, low + n), c10 = hn::LoadU(d, low + n + record);
    const auto c01 = hn::LoadU(d, high + n), c11 = hn::LoadU(d, high + n + record);
    const auto a = hn::Add(c00, hn::Mul(wu, hn::Sub(c10, c00)));
    const auto b = hn::Add(c01, hn::Mul(wu, hn::Sub(c11, c01)));
    hn::Store(hn::Add(a, hn::Mul(wv, hn::Sub(b, a))), d, bands + n);
  }
}

HWY_INLINE void SumHeight(const WaterPatch& patch, Samples& s, std::size_t v) {
  float height = 0.0f;
  for (int b = 0; b < patch.bands; ++b) height += s.bands[v][4 * b];
  s.height[v] = height;
}

HWY_INLINE void Decay(const WaterSampler& sampler, double depth, Samples& s, std::size_t v) {
  const DF d;
  const auto below = hn::Set(d, static_cast<float>(std::max(0.0, depth)));
  for (int b = 0; b < sampler.patch->bands; b += static_cast<int>(hn::Lanes(d))) {
    hn::Store(ExpMinus(hn::Mul(hn::LoadU(d, sampler.wavenumber + b), below)), d, s.decay[v] + b);
  }
  if (!sampler.deep) FeelTheBottom(sampler, s.decay[v], s.vertical[v]);
}

// Height felt, and velocity.
HWY_INLINE void SumBands(const WaterSampler& sampler, const Samples& s, std::size_t v, float* sum) {
  const hn::CappedTag<float, 4> d4;
  const int count = sampler.patch->bands;
  for (int c = 0; c < 4; c += static_cast<int>(hn::Lanes(d4))) {
    auto total = hn::Zero(d4);
    for (int b = 0; b < count; ++b) {
      const auto share = hn::Load(d4, s.bands[v] + 4 * b + c);
      total = hn::Add(total, hn::Mul(share, hn::Set(d4, s.decay[v][b])));
    }
    hn::Store(total, d4, sum + c);
  }
  if (!sampler.deep) {
    sum[3] = 0.0f;
    for (int b = 0; b < count; ++b) sum[3] += s.bands[v][4 * b + 3] * s.vertical[v][b];
  }
}

// Depth, head and the water's velocity of a block, but for vertices that are far above the water.
HWY_INLINE void SampleBlock(const WaterSampler& sampler, const Cell* cells, const double* height_m,
                            std::size_t first, Samples& s, WetVertices& out,
                            double (*water)[kWetBlock]) {
  const WaterPatch& patch = *sampler.patch;
  const auto each = [&](auto stage) HWY_ATTR {
    for (std::size_t n = 0; n < kWetBlock; ++n) {
      if (!s.far_above[n]) stage(n);
    }
  };
  each([&](std::size_t n) HWY_ATTR { ReadRecord(patch, cells[n], s, n); });
  each([&](std::size_t n) HWY_ATTR {
    SumHeight(patch, s, n);
    out.depth[first + n] = double{s.height[n]} - (height_m[n] - patch.level_m);
  });
  each([&](std::size_t n) HWY_ATTR { Decay(sampler, out.depth[first + n], s, n); });
  each([&](std::size_t n) HWY_ATTR {
    HWY_ALIGN float sum[4];
    SumBands(sampler, s, n, sum);
    const double lost = double{s.height[n]} - double{sum[0]};
    const double depth = out.depth[first + n];
    out.head[first + n] = depth > 0.0 ? std::max(0.0, depth - lost) : 0.0;
    water[0][n] = patch.current_m_per_s.x + double{sum[1]};
    water[1][n] = patch.current_m_per_s.y + double{sum[2]};
    water[2][n] = patch.current_m_per_s.z + double{sum[3]};
  });
}

// World places of one block, and their cells in the patch.
HWY_INLINE void PlaceBlock(const WetMesh& mesh, const WetMotion& motion,
                           const WaterSampler& sampler, std::size_t first, Cell* cells,
                           double* height_m) {
  const D d;
  const WaterPatch& patch = *sampler.patch;
  const auto& m = motion.turn.m;
  HWY_ALIGN double us[kWetBlock], vs[kWetBlock];
  for (std::size_t n = 0; n < kWetBlock; n += hn::Lanes(d)) {
    const V x = hn::Load(d, mesh.x.get() + first + n), y = hn::Load(d, mesh.y.get() + first + n),
            z = hn::Load(d, mesh.z.get() + first + n);
    const auto row = [&](int r, double centre) HWY_ATTR {
      const V xy = hn::Add(hn::Mul(hn::Set(d, m[3 * r]), x), hn::Mul(hn::Set(d, m[3 * r + 1]), y));
      return hn::Add(hn::Set(d, centre), hn::Add(xy, hn::Mul(hn::Set(d, m[3 * r + 2]), z)));
    };
    const auto cell = [&](V at, double origin, int count) HWY_ATTR {
      const V u = hn::Mul(hn::Sub(at, hn::Set(d, origin)), hn::Set(d, sampler.cells_per_m));
      return hn::Min(hn::Max(u, hn::Zero(d)), hn::Set(d, static_cast<double>(count - 1)));
    };
    hn::Store(row(2, motion.centre_m.z), d, height_m + n);
    hn::Store(cell(row(0, motion.centre_m.x), patch.west_m, patch.columns), d, us + n);
    hn::Store(cell(row(1, motion.centre_m.y), patch.south_m, patch.rows), d, vs + n);
  }
  for (std::size_t n = 0; n < kWetBlock; ++n) {
    const int column = std::min(static_cast<int>(us[n]), patch.columns - 2);
    const int row = std::min(static_cast<int>(vs[n]), patch.rows - 2);
    cells[n] = {std::int64_t{4} * patch.bands * (std::int64_t{row} * patch.columns + column),
                static_cast<float>(us[n] - column), static_cast<float>(vs[n] - row)};
  }
}

void SampleVerticesOf(const WetMesh& mesh, const WetMotion& motion, const WaterSampler& sampler,
                      WetVertices& out) {
  const D d;
  const Vec3v velocity = SetAll(motion.velocity_m_per_s), spin = SetAll(motion.spin_rad_per_s);
  const auto& m = motion.turn.m;
  const WaterPatch& patch = *sampler.patch;
  HWY_ALIGN double height[kWetBlock], water[3][kWetBlock];
  Samples samples;
  for (std::size_t first = 0; first < mesh.vertices; first += kWetBlock) {
    Cell cells[kWetBlock];
    PlaceBlock(mesh, motion, sampler, first, cells, height);
    for (std::size_t n = 0; n < kWetBlock; ++n) {
      const std::size_t at = first + n;
      samples.far_above[n] = height[n] > motion.dry_above_m;
      out.depth[at] = samples.far_above[n] ? -1.0 : patch.level_m - height[n];
      out.head[at] = std::max(0.0, out.depth[at]);
      water[0][n] = patch.current_m_per_s.x;
      water[1][n] = patch.current_m_per_s.y;
      water[2][n] = patch.current_m_per_s.z;
    }
    if (patch.bands > 0) SampleBlock(sampler, cells, height, first, samples, out, water);
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
      const Vec3v turning = CrossOf(spin, place);
      hn::Store(hn::Sub(hn::Sub(column(0), velocity.x), turning.x), d, out.rx.get() + at);
      hn::Store(hn::Sub(hn::Sub(column(1), velocity.y), turning.y), d, out.ry.get() + at);
      hn::Store(hn::Sub(hn::Sub(column(2), velocity.z), turning.z), d, out.rz.get() + at);
    }
  }
}

using Indices = hn::Vec<hn::RebindToSigned<D>>;
HWY_INLINE V At(const sea::AlignedArray<double>& array, Indices index) {
  return hn::GatherIndex(D(), array.get(), index);
}

HWY_INLINE void Accumulate(double (*sums)[kWetBlock], int which, std::size_t lane, V value) {
  hn::Store(hn::Add(hn::Load(D(), sums[which] + lane), value), D(), sums[which] + lane);
}
HWY_INLINE void Accumulate3(double (*sums)[kWetBlock], int which, std::size_t lane, Vec3v value) {
  Accumulate(sums, which, lane, value.x);
  Accumulate(sums, which + 1, lane, value.y);
  Accumulate(sums, which + 2, lane, value.z);
}

// What is read of lanes of triangles.
struct Lanes3 {
  HWY_INLINE Lanes3() {}
  Vec3v normal;
  V area;  // 0 where a triangle is not wholly wet
  Vec3v place[3], relative[3];
  V depth[3], head[3];
};

HWY_INLINE void AddTriangles(const Lanes3& t, const WetCoefficients& coefficients, std::size_t lane,
                             double (*sums)[kWetBlock]) {
  const D d;
  const V area = t.area;
  const Vec3v normal = t.normal;
  V head = hn::Zero(d), depth = hn::Zero(d), squares = hn::Zero(d);
  Vec3v sum = SetAll({}), by_head = SetAll({}), by_depth = SetAll({}), relative = SetAll({});
  for (int k = 0; k < 3; ++k) {
    head = hn::Add(head, t.head[k]);
    depth = hn::Add(depth, t.depth[k]);
    squares = hn::Add(squares, hn::Mul(t.depth[k], t.depth[k]));
    sum = Sum(sum, t.place[k]);
    by_head = Sum(by_head, Scaled(t.head[k], t.place[k]));
    by_depth = Sum(by_depth, Scaled(t.depth[k], t.place[k]));
    relative = Sum(relative, t.relative[k]);
  }
  // ∫ p dS and ∫ x p dS of linear p: exact.
  const V twelfth = hn::Mul(area, hn::Set(d, 1.0 / 12.0));
  const V minus_third = hn::Mul(hn::Set(d, -4.0), twelfth);
  Accumulate3(sums, kPressureForce, lane, Scaled(hn::Mul(minus_third, head), normal));
  const Vec3v moment = Scaled(twelfth, Sum(Scaled(head, sum), by_head));
  Accumulate3(sums, kPressureTorque, lane, CrossOf(normal, moment));

  // The volume as columns from the hull up to the surface.
  const V upward = hn::Mul(Product(normal, SetAll(coefficients.up)), twelfth);
  const V minus = hn::Sub(hn::Zero(d), upward);
  Accumulate(sums, kVolume, lane, hn::Mul(hn::Mul(hn::Set(d, 4.0), minus), depth));
  Accumulate3(sums, kVolumeMoment, lane, Scaled(minus, Sum(Scaled(depth, sum), by_depth)));
  Accumulate(sums, kRaise, lane,
             hn::Mul(hn::Mul(hn::Set(d, 0.5), minus), hn::Add(hn::Mul(depth, depth), squares)));

  const V third = hn::Set(d, 1.0 / 3.0);
  const Vec3v flow = Scaled(third, relative), centre = Scaled(third, sum);
  Accumulate(sums, kArea, lane, area);
  Accumulate3(sums, kAreaMoment, lane, Scaled(area, centre));
  Accumulate3(sums, kAreaRelative, lane, Scaled(area, flow));
  // Speed at which the piece moves into the water.
  const V into = hn::Sub(hn::Zero(d), Product(flow, normal));
  const V speed = hn::Sqrt(Product(flow, flow));
  const V along = hn::Mul(hn::Set(d, coefficients.friction), speed);
  const V front = hn::Add(hn::Mul(hn::Set(d, coefficients.pressure), into),
                          hn::Mul(hn::Set(d, coefficients.planing), speed));
  const V back = hn::Sub(hn::Zero(d), hn::Mul(hn::Set(d, coefficients.suction), into));
  const V against = hn::IfThenElse(hn::Gt(into, hn::Zero(d)), front, back);
  const Vec3v force = Scaled(
      area, Sum(Scaled(along, flow), Scaled(hn::Mul(hn::Sub(along, against), into), normal)));
  Accumulate3(sums, kDragForce, lane, force);
  Accumulate3(sums, kDragTorque, lane, CrossOf(centre, force));
}

// Eight parts in one order, whatever the vectors.
HWY_INLINE double Joined(const double (&part)[kWetBlock]) {
  return ((part[0] + part[4]) + (part[2] + part[6])) + ((part[1] + part[5]) + (part[3] + part[7]));
}

int SumSubmergedOf(const WetMesh& mesh, const WetCoefficients& coefficients, WetVertices& w,
                   std::array<double, kWetSums>& out) {
  const D d;
  const hn::RebindToSigned<D> di;
  HWY_ALIGN double sums[kWetSums][kWetBlock] = {};
  HWY_ALIGN double least[kWetBlock], most[kWetBlock];
  int whole = 0;
  w.clipped.clear();
  for (std::size_t first = 0; first < mesh.triangles; first += kWetBlock) {
    for (std::size_t n = 0; n < kWetBlock; n += hn::Lanes(d)) {
      const std::size_t at = first + n;
      const Indices index[3] = {hn::Load(di, mesh.corner[0].get() + at),
                                hn::Load(di, mesh.corner[1].get() + at),
                                hn::Load(di, mesh.corner[2].get() + at)};
      const V depths[3] = {At(w.depth, index[0]), At(w.depth, index[1]), At(w.depth, index[2])};
      const V low = hn::Min(hn::Min(depths[0], depths[1]), depths[2]);
      const V high = hn::Max(hn::Max(depths[0], depths[1]), depths[2]);
      hn::Store(low, d, least + n);
      hn::Store(high, d, most + n);
      const auto wet = hn::Gt(low, hn::Zero(d));
      if (hn::AllFalse(d, wet)) continue;
      Lanes3 t;
      t.area = hn::IfThenElseZero(wet, hn::Load(d, mesh.area.get() + at));
      t.normal = Vec3v(hn::Load(d, mesh.normal_x.get() + at), hn::Load(d, mesh.normal_y.get() + at),
                       hn::Load(d, mesh.normal_z.get() + at));
      for (int k = 0; k < 3; ++k) {
        t.place[k] = Vec3v(hn::Load(d, mesh.corner_x[k].get() + at),
                           hn::Load(d, mesh.corner_y[k].get() + at),
                           hn::Load(d, mesh.corner_z[k].get() + at));
        t.relative[k] = Vec3v(At(w.rx, index[k]), At(w.ry, index[k]), At(w.rz, index[k]));
        t.depth[k] = depths[k];
        t.head[k] = At(w.head, index[k]);
      }
      AddTriangles(t, coefficients, n, sums);
    }
    for (std::size_t n = 0; n < kWetBlock; ++n) {
      if (mesh.area[first + n] == 0.0 || !(most[n] > 0.0)) continue;
      if (least[n] > 0.0) {
        ++whole;
      } else {
        w.clipped.push_back(static_cast<std::uint32_t>(first + n));
      }
    }
  }
  for (int s = 0; s < kWetSums; ++s) out[s] = Joined(sums[s]);
  return whole;
}

void SumPiecesOf(const WetPieces& pieces, const WetCoefficients& coefficients,
                 std::array<double, kWetSums>& out) {
  const D d;
  HWY_ALIGN double sums[kWetSums][kWetBlock] = {};
  for (std::size_t at = 0; at < pieces.count; at += hn::Lanes(d)) {
    const auto load = [&](const sea::AlignedArray<double>& array)
                          HWY_ATTR { return hn::Load(d, array.get() + at); };
    Lanes3 t;
    t.area = load(pieces.area);
    t.normal = Vec3v(load(pieces.normal_x), load(pieces.normal_y), load(pieces.normal_z));
    for (int k = 0; k < 3; ++k) {
      const WetPieces::Corner& c = pieces.corner[k];
      t.place[k] = Vec3v(load(c.x), load(c.y), load(c.z));
      t.relative[k] = Vec3v(load(c.rx), load(c.ry), load(c.rz));
      t.depth[k] = load(c.depth);
      t.head[k] = load(c.head);
    }
    AddTriangles(t, coefficients, at % kWetBlock, sums);
  }
  for (int s = 0; s < kWetSums; ++s) out[s] += Joined(sums[s]);
}

}  // namespace HWY_NAMESPACE
}  // namespace onesea::world
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace onesea::world {

HWY_EXPORT(SampleVerticesOf);
HWY_EXPORT(SumSubmergedOf);
HWY_EXPORT(SumPiecesOf);

void WetPieces::Reserve(std::size_t pieces) {
  const std::size_t padded = (pieces + kWetBlock - 1) / kWetBlock * kWetBlock;
  if (capacity >= padded) return;
  for (Corner& c : corner) {
    for (auto* array : {&c.x, &c.y, &c.z, &c.depth, &c.head, &c.rx, &c.ry, &c.rz}) {
      *array = sea::AllocateZeros<double>(padded);
    }
  }
  for (auto* array : {&normal_x, &normal_y, &normal_z, &area}) {
    *array = sea::AllocateZeros<double>(padded);
  }
  capacity = padded;
}

void WetVertices::Reserve(const WetMesh& mesh) {
  if (capacity < mesh.vertices) {
    for (auto* array : {&depth, &head, &rx, &ry, &rz}) {
      *array = sea::AllocateZeros<double>(mesh.vertices);
    }
    capacity = mesh.vertices;
  }
  clipped.reserve(mesh.triangles);
}

void SampleVertices(const WetMesh& mesh, const WetMotion& motion, const WaterSampler& water,
                    WetVertices& out) {
  HWY_DYNAMIC_DISPATCH(SampleVerticesOf)(mesh, motion, water, out);
}

int SumSubmerged(const WetMesh& mesh, const WetCoefficients& coefficients, WetVertices& vertices,
                 std::array<double, kWetSums>& sums) {
  return HWY_DYNAMIC_DISPATCH(SumSubmergedOf)(mesh, coefficients, vertices, sums);
}

void SumPieces(const WetPieces& pieces, const WetCoefficients& coefficients,
               std::array<double, kWetSums>& sums) {
  HWY_DYNAMIC_DISPATCH(SumPiecesOf)(pieces, coefficients, sums);
}

}  // namespace onesea::world
#endif  // HWY_ONCE
