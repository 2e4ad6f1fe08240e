// Height above a point of the choppy sea: find p with p + D(p) = x, summed over all cascades.
//
// Idea: three cheap steps d <- D(x - d) on the coefficients read bilinearly, the last one a Newton
//   step, bring d within centimetres (query_start-inl.h). Then the cubic spline is read once: D, h
//   and their gradients come from the same 16 coefficients, and a Newton step carries both to the
//   solution (query_spline-inl.h). The few points where that step was long take a second one.
// Points go in blocks of 64. In the cheap steps lanes are points, whose corners are copied to a
//   small buffer and transposed in registers, since gathers are slow on half the machines. In the
//   spline lanes are columns of records: two 64-byte loads a point and cascade. Random points wait
//   for memory more than for arithmetic, hence records of 16 bits.
// Bits: rows are weighted in whole numbers; additions across lanes have one order, (0 + 2) +
//   (1 + 3), nothing is fused, and no point depends on the others of its block: the same on every
//   SIMD target.
// Limits: the steps converge where the displacement contracts; the others are marked suspicious for
//   sheet_search.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/sea/query_kernel.cc"
#include "hwy/foreach_target.h"
//
#include <cstddef>
#include <cstring>

#include "common/sea/query_block-inl.h"
#include "common/sea/query_kernel.h"
#include "common/sea/query_spline-inl.h"
#include "common/sea/query_start-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace onesea::sea {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Residual beyond which a second spline step follows, and then the careful path.
constexpr float kConvergedM = 5e-4f;
// Least eigenvalue of the Jacobian below which the surface may fold.
constexpr float kStretchMin = 0.7f;

// A Newton step by the spline. The residual after it is what a field of the greatest curvature
// would leave.
HWY_INLINE void SplineStep(const QueryGrids& grids, Block& block) {
  const D d;
  ReadSpline(grids, block);
  const V half_curvature = hn::Set(d, 0.5f * grids.curvature_per_m);
  for (std::size_t n = 0; n < block.padded; n += hn::Lanes(d)) {
    const V dx = hn::Load(d, block.d_x + n), dy = hn::Load(d, block.d_y + n);
    V step_x, step_y, stretch;
    SolveJacobian(block, n, hn::Sub(hn::Load(d, block.sum[kDx] + n), dx),
                  hn::Sub(hn::Load(d, block.sum[kDy] + n), dy), step_x, step_y, stretch);
    // d grows by the step, so the undisplaced point x - d moves back by it.
    const V lift = hn::Add(hn::Mul(hn::Load(d, block.sum[kSlopeX] + n), step_x),
                           hn::Mul(hn::Load(d, block.sum[kSlopeY] + n), step_y));
    hn::Store(hn::Sub(hn::Load(d, block.sum[kHeight] + n), lift), d, block.height + n);
    hn::Store(hn::Add(dx, step_x), d, block.d_x + n);
    hn::Store(hn::Add(dy, step_y), d, block.d_y + n);
    const V step2 = hn::Add(hn::Mul(step_x, step_x), hn::Mul(step_y, step_y));
    hn::Store(hn::Mul(half_curvature, step2), d, block.residual_m + n);
    hn::Store(hn::Min(stretch, hn::Load(d, block.stretch + n)), d, block.stretch + n);
  }
}

// Where a point stands in the iteration.
HWY_INLINE void CopyPoint(const QueryGrids& grids, const Block& from, std::size_t n, Block& to,
                          std::size_t at) {
  for (std::size_t c = 0; c < grids.cascades.size(); ++c) {
    const CascadeBlock& source = from.cascades[c];
    CascadeBlock& target = to.cascades[c];
    target.frac_u[at] = source.frac_u[n];
    target.frac_v[at] = source.frac_v[n];
    target.cell_u[at] = source.cell_u[n];
    target.cell_v[at] = source.cell_v[n];
  }
  for (std::size_t r = 0; r < grids.regular.size(); ++r) to.turns[r][at] = from.turns[r][n];
  if (from.attenuated) {
    for (std::size_t p = 0; p <= grids.cascades.size(); ++p) to.factor[p][at] = from.factor[p][n];
  }
  to.d_x[at] = from.d_x[n];
  to.d_y[at] = from.d_y[n];
  to.stretch[at] = from.stretch[n];
}

// A second spline step for the points whose residual is large, closed up in a block of their own.
HWY_INLINE void SolveRest(const QueryGrids& grids, Block& block) {
  std::uint8_t which[kB];
  std::size_t count = 0;
  for (std::size_t n = 0; n < block.count; ++n) {
    which[count] = static_cast<std::uint8_t>(n);
    count += !(block.residual_m[n] <= kConvergedM);
  }
  if (count == 0) return;
  Block rest;
  SetCount(count, rest);
  rest.attenuated = block.attenuated;
  for (std::size_t at = 0; at < rest.padded; ++at) {
    CopyPoint(grids, block, which[HWY_MIN(at, count - 1)], rest, at);
  }
  SplineStep(grids, rest);
  for (std::size_t at = 0; at < count; ++at) {
    const std::size_t n = which[at];
    block.d_x[n] = rest.d_x[at];
    block.d_y[n] = rest.d_y[at];
    block.height[n] = rest.height[at];
    block.residual_m[n] = rest.residual_m[at];
    block.stretch[n] = rest.stretch[at];
  }
}

// The cheap steps.
HWY_INLINE void Approach(const QueryGrids& grids, std::span<const Vec2d> points, Block& block) {
  LoadPoints(grids, points, block);
  std::memset(block.d_x, 0, sizeof block.d_x);
  std::memset(block.d_y, 0, sizeof block.d_y);
  // The short waves of the last cascades say nothing while d is off by more than their length.
  const std::size_t cascades = grids.cascades.size();
  FixedPointStep(grids, (cascades + 1) / 2, block);
  FixedPointStep(grids, cascades - cascades / 4, block);
  NewtonStep(grids, block);
}

void ApproachBlockTarget(const QueryGrids& grids, std::span<const Vec2d> points,
                         std::span<SurfaceSample> out) {
  Block block;
  Approach(grids, points, block);
  for (std::size_t n = 0; n < points.size(); ++n) {
    out[n].displacement_x_m = block.d_x[n];
    out[n].displacement_y_m = block.d_y[n];
  }
}

void SolveBlock(const QueryGrids& grids, std::span<const Vec2d> points,
                std::span<SurfaceSample> out, std::span<bool> suspicious) {
  Block block;
  Approach(grids, points, block);
  SplineStep(grids, block);
  SolveRest(grids, block);
  for (std::size_t n = 0; n < points.size(); ++n) {
    // One by one: the assignment of a whole sample costs a quarter of the query.
    SurfaceSample& sample = out[n];
    sample.height_m = block.height[n];
    sample.displacement_x_m = block.d_x[n];
    sample.displacement_y_m = block.d_y[n];
    sample.residual_m = block.residual_m[n];
    sample.normal_x = sample.normal_y = 0.0f;
    sample.normal_z = 1.0f;
    sample.velocity_x_m_per_s = sample.velocity_y_m_per_s = sample.velocity_z_m_per_s = 0.0f;
    sample.folded = false;
    suspicious[n] = !(block.residual_m[n] <= kConvergedM && block.stretch[n] >= kStretchMin);
  }
}

void FinishBlockTarget(const QueryGrids& grids, std::span<const Vec2d> points,
                       std::span<SurfaceSample> out) {
  Block block;
  LoadSolved(grids, points, out, block);
  ReadSpline(grids, block);
  const bool velocity = grids.detail == QueryDetail::kVelocity;
  if (velocity) ReadVelocity(grids, block);
  const D d;
  const V one = hn::Set(d, 1.0f);
  for (std::size_t n = 0; n < block.padded; n += hn::Lanes(d)) {
    const auto load = [&](Sum sum) HWY_ATTR { return hn::Load(d, block.sum[sum] + n); };
    const V xx = hn::Add(one, load(kJxx)), yy = hn::Add(one, load(kJyy));
    const V xy = load(kJxy), yx = load(kJyx), sx = load(kSlopeX), sy = load(kSlopeY);
    // The surface's tangents (xx, yx, sx) x (xy, yy, sy)
    const V nx = hn::Sub(hn::Mul(yx, sy), hn::Mul(sx, yy));
    const V ny = hn::Sub(hn::Mul(sx, xy), hn::Mul(xx, sy));
    const V nz = hn::Sub(hn::Mul(xx, yy), hn::Mul(xy, yx));
    const V length = hn::Sqrt(hn::Add(hn::Add(hn::Mul(nx, nx), hn::Mul(ny, ny)), hn::Mul(nz, nz)));
    const V scale = hn::Div(one, hn::Max(length, hn::Set(d, 1e-20f)));
    hn::Store(hn::Mul(nx, scale), d, block.sum[0] + n);
    hn::Store(hn::Mul(ny, scale), d, block.sum[1] + n);
    hn::Store(hn::Mul(nz, scale), d, block.sum[2] + n);
  }
  for (std::size_t n = 0; n < points.size(); ++n) {
    SurfaceSample& sample = out[n];
    sample.normal_x = block.sum[0][n];
    sample.normal_y = block.sum[1][n];
    sample.normal_z = block.sum[2][n];
    if (!velocity) continue;
    sample.velocity_x_m_per_s = block.velocity[0][n] + static_cast<float>(grids.current_m_per_s.x);
    sample.velocity_y_m_per_s = block.velocity[1][n] + static_cast<float>(grids.current_m_per_s.y);
    sample.velocity_z_m_per_s = block.velocity[2][n];
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace onesea::sea
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "common/base/check.h"

namespace onesea::sea {

HWY_EXPORT(SolveBlock);
HWY_EXPORT(ApproachBlockTarget);
HWY_EXPORT(FinishBlockTarget);

void SampleBlock(const QueryGrids& grids, std::span<const Vec2d> points,
                 std::span<SurfaceSample> out, std::span<bool> suspicious) {
  ONESEA_CHECK(!points.empty() && points.size() <= kQueryBlock && out.size() == points.size() &&
               suspicious.size() == points.size());
  HWY_DYNAMIC_DISPATCH(SolveBlock)(grids, points, out, suspicious);
}

void ApproachBlock(const QueryGrids& grids, std::span<const Vec2d> points,
                   std::span<SurfaceSample> out) {
  ONESEA_CHECK(!points.empty() && points.size() <= kQueryBlock && out.size() == points.size());
  HWY_DYNAMIC_DISPATCH(ApproachBlockTarget)(grids, points, out);
}

void FinishBlock(const QueryGrids& grids, std::span<const Vec2d> points,
                 std::span<SurfaceSample> out) {
  ONESEA_CHECK(!points.empty() && points.size() <= kQueryBlock && out.size() == points.size());
  HWY_DYNAMIC_DISPATCH(FinishBlockTarget)(grids, points, out);
}

}  // namespace onesea::sea
#endif  // HWY_ONCE
