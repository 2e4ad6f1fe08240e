// Forces on hulls, many triangles at once: lanes are triangles, what is known of their corners is
// gathered. Sums are kept in eight parts and joined in one order, nothing is fused: the same bits
// on every SIMD target.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/world/wet_sums.cc"
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

// A corner of what is wet of a triangle.
struct Corner {
  HWY_INLINE Corner() {}
  Vec3v place, relative;
  V depth, head;
};

// Lanes of triangles, or of wetted pieces of such.
struct Lanes3 {
  HWY_INLINE Lanes3() {}
  Vec3v normal;
  V area;  // 0: nothing is added
  Corner corner[3];
};

HWY_INLINE void AddTriangles(const Lanes3& t, const WetCoefficients& coefficients, std::size_t lane,
                             double (*sums)[kWetBlock]) {
  const D d;
  const V area = t.area;
  const Vec3v normal = t.normal;
  V head = hn::Zero(d), depth = hn::Zero(d), squares = hn::Zero(d);
  Vec3v sum = SetAll({}), by_head = SetAll({}), by_depth = SetAll({}), relative = SetAll({});
  for (int k = 0; k < 3; ++k) {
    const Corner& c = t.corner[k];
    head = hn::Add(head, c.head);
    depth = hn::Add(depth, c.depth);
    squares = hn::Add(squares, hn::Mul(c.depth, c.depth));
    sum = Sum(sum, c.place);
    by_head = Sum(by_head, Scaled(c.head, c.place));
    by_depth = Sum(by_depth, Scaled(c.depth, c.place));
    relative = Sum(relative, c.relative);
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

// Triangles that are wholly under water; lists those that cross the surface. Returns how many.
std::size_t SumSubmerged(const WetMesh& mesh, const WetCoefficients& coefficients, WetVertices& w,
                         double (*sums)[kWetBlock]) {
  const D d;
  const hn::RebindToSigned<D> di;
  std::size_t whole = 0;
  w.crossings = 0;
  for (std::size_t at = 0; at < mesh.triangles; at += hn::Lanes(d)) {
    const Indices index[3] = {hn::Load(di, mesh.corner[0].get() + at),
                              hn::Load(di, mesh.corner[1].get() + at),
                              hn::Load(di, mesh.corner[2].get() + at)};
    const V depths[3] = {At(w.depth, index[0]), At(w.depth, index[1]), At(w.depth, index[2])};
    const V high = hn::Max(hn::Max(depths[0], depths[1]), depths[2]);
    const V area = hn::Load(d, mesh.area.get() + at);
    const auto touched = hn::And(hn::Gt(high, hn::Zero(d)), hn::Gt(area, hn::Zero(d)));
    if (hn::AllFalse(d, touched)) continue;
    const V low = hn::Min(hn::Min(depths[0], depths[1]), depths[2]);
    const auto wet = hn::And(touched, hn::Gt(low, hn::Zero(d)));
    w.crossings += hn::CompressStore(hn::Iota(di, static_cast<std::int64_t>(at)),
                                     hn::RebindMask(di, hn::AndNot(wet, touched)), di,
                                     w.crossing.get() + w.crossings);
    if (hn::AllFalse(d, wet)) continue;
    whole += hn::CountTrue(d, wet);
    Lanes3 t;
    t.area = hn::IfThenElseZero(wet, area);
    t.normal = Vec3v(hn::Load(d, mesh.normal_x.get() + at), hn::Load(d, mesh.normal_y.get() + at),
                     hn::Load(d, mesh.normal_z.get() + at));
    for (int k = 0; k < 3; ++k) {
      Corner& c = t.corner[k];
      c.place =
          Vec3v(hn::Load(d, mesh.corner_x[k].get() + at), hn::Load(d, mesh.corner_y[k].get() + at),
                hn::Load(d, mesh.corner_z[k].get() + at));
      c.relative = Vec3v(At(w.rx, index[k]), At(w.ry, index[k]), At(w.rz, index[k]));
      c.depth = depths[k];
      c.head = At(w.head, index[k]);
    }
    AddTriangles(t, coefficients, at % kWetBlock, sums);
  }
  return whole;
}

HWY_INLINE Corner CornerOf(const WetMesh& mesh, const WetVertices& w, Indices vertex) {
  Corner c;
  c.place = Vec3v(At(mesh.x, vertex), At(mesh.y, vertex), At(mesh.z, vertex));
  c.relative = Vec3v(At(w.rx, vertex), At(w.ry, vertex), At(w.rz, vertex));
  c.depth = At(w.depth, vertex);
  c.head = At(w.head, vertex);
  return c;
}

// Where the edge from `a` to `b` meets the surface, `share` of the way.
HWY_INLINE Corner OnSurface(const Corner& a, const Corner& b, V share) {
  Corner c;
  c.place = Sum(a.place, Scaled(share, Difference(b.place, a.place)));
  c.relative = Sum(a.relative, Scaled(share, Difference(b.relative, a.relative)));
  c.depth = c.head = hn::Zero(D());
  return c;
}

using Mask = hn::Mask<D>;
HWY_INLINE Vec3v Select(Mask mask, Vec3v a, Vec3v b) {
  return {hn::IfThenElse(mask, a.x, b.x), hn::IfThenElse(mask, a.y, b.y),
          hn::IfThenElse(mask, a.z, b.z)};
}
HWY_INLINE Corner Select(Mask mask, const Corner& a, const Corner& b) {
  Corner c;
  c.place = Select(mask, a.place, b.place);
  c.relative = Select(mask, a.relative, b.relative);
  c.depth = hn::IfThenElse(mask, a.depth, b.depth);
  c.head = hn::IfThenElse(mask, a.head, b.head);
  return c;
}

// The vertices of triangles that cross the surface, in their sense of turning: the first is alone
// on its side. Returns where that one is wet.
HWY_INLINE Mask OddFirst(const WetMesh& mesh, const WetVertices& w, Indices triangle,
                         Indices (&vertex)[3]) {
  const D d;
  const hn::RebindToSigned<D> di;
  Indices v[3];
  Mask wet[3];
  for (int k = 0; k < 3; ++k) {
    v[k] = hn::GatherIndex(di, mesh.corner[k].get(), triangle);
    wet[k] = hn::Gt(At(w.depth, v[k]), hn::Zero(d));
  }
  const auto two_wet =
      hn::Or(hn::Or(hn::And(wet[0], wet[1]), hn::And(wet[1], wet[2])), hn::And(wet[2], wet[0]));
  const auto first_odd = hn::RebindMask(di, hn::Xor(wet[0], two_wet));
  const auto second_odd = hn::RebindMask(di, hn::Xor(wet[1], two_wet));
  for (int k = 0; k < 3; ++k) {
    vertex[k] =
        hn::IfThenElse(first_odd, v[k], hn::IfThenElse(second_odd, v[(k + 1) % 3], v[(k + 2) % 3]));
  }
  return hn::Not(two_wet);
}

// The wetted parts of triangles that cross the surface. With o the corner alone on its side, P and
// Q on the surface at shares s and r of the edges from o to the others p and q: of a wet o the
// triangle oPQ, of a dry one the rest, in two pieces Ppq and PqQ.
//   areas  s r,  1 - s  and  s (1 - r)  of the whole
void SumCrossing(const WetMesh& mesh, const WetCoefficients& coefficients, WetVertices& w,
                 double (*sums)[kWetBlock]) {
  const D d;
  const hn::RebindToSigned<D> di;
  const std::size_t count = w.crossings;
  if (count == 0) return;
  // The last block is filled up with its last triangle, without area.
  std::fill(w.crossing.get() + count, w.crossing.get() + WholeBlocks(count), w.crossing[count - 1]);
  for (std::size_t at = 0; at < count; at += hn::Lanes(d)) {
    const Indices triangle = hn::Load(di, w.crossing.get() + at);
    const auto there = hn::RebindMask(d, hn::Lt(hn::Iota(di, static_cast<std::int64_t>(at)),
                                                hn::Set(di, static_cast<std::int64_t>(count))));
    const V area = hn::IfThenElseZero(there, At(mesh.area, triangle));
    Indices vertex[3];
    const Mask tip = OddFirst(mesh, w, triangle, vertex);
    const Corner o = CornerOf(mesh, w, vertex[0]), p = CornerOf(mesh, w, vertex[1]),
                 q = CornerOf(mesh, w, vertex[2]);
    const V s = hn::Div(o.depth, hn::Sub(o.depth, p.depth));
    const V r = hn::Div(o.depth, hn::Sub(o.depth, q.depth));
    const Corner on_p = OnSurface(o, p, s), on_q = OnSurface(o, q, r);
    const V one = hn::Set(d, 1.0);
    Lanes3 t;
    t.normal = Vec3v(At(mesh.normal_x, triangle), At(mesh.normal_y, triangle),
                     At(mesh.normal_z, triangle));
    t.area = hn::Mul(area, hn::IfThenElse(tip, hn::Mul(s, r), hn::Sub(one, s)));
    t.corner[0] = Select(tip, o, on_p);
    t.corner[1] = Select(tip, on_p, p);
    t.corner[2] = Select(tip, on_q, q);
    AddTriangles(t, coefficients, at % kWetBlock, sums);
    t.area = hn::IfThenZeroElse(tip, hn::Mul(area, hn::Mul(s, hn::Sub(one, r))));
    t.corner[0] = on_p;
    t.corner[1] = q;
    t.corner[2] = on_q;
    AddTriangles(t, coefficients, at % kWetBlock, sums);
  }
}

// Eight parts in one order, whatever the vectors.
HWY_INLINE double Joined(const double (&part)[kWetBlock]) {
  return ((part[0] + part[4]) + (part[2] + part[6])) + ((part[1] + part[5]) + (part[3] + part[7]));
}

int SumWettedOf(const WetMesh& mesh, const WetCoefficients& coefficients, WetVertices& vertices,
                std::array<double, kWetSums>& out) {
  HWY_ALIGN double sums[kWetSums][kWetBlock] = {};
  const std::size_t whole = SumSubmerged(mesh, coefficients, vertices, sums);
  SumCrossing(mesh, coefficients, vertices, sums);
  for (int s = 0; s < kWetSums; ++s) out[s] = Joined(sums[s]);
  return static_cast<int>(whole + vertices.crossings);
}

}  // namespace HWY_NAMESPACE
}  // namespace onesea::world
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace onesea::world {

HWY_EXPORT(SumWettedOf);

int SumWetted(const WetMesh& mesh, const WetCoefficients& coefficients, WetVertices& vertices,
              std::array<double, kWetSums>& sums) {
  return HWY_DYNAMIC_DISPATCH(SumWettedOf)(mesh, coefficients, vertices, sums);
}

}  // namespace onesea::world
#endif  // HWY_ONCE
