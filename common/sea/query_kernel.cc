// Height above a point of the choppy sea: find p with p + D(p) = x, summed over all cascades.
//
// Idea: three cheap steps d <- D(x - d) on the coefficients read bilinearly, the last one a Newton
//   step, bring d within centimetres. Then the cubic spline is read once: D, h and their gradients
//   come from the same 16 records, and a Newton step carries both to the solution. The few points
//   where that step was long take a second one.
// Points go in blocks of 64. In the cheap steps lanes are points, whose corners are copied to a
//   small buffer and transposed in registers, since gathers are slow on half the machines. In the
//   spline lanes are the records of a row: four 64-byte loads a point and cascade.
// Bits: additions across lanes have one order, (0 + 2) + (1 + 3), nothing is fused, and no point
//   depends on the others of its block: the same on every SIMD target.
// Limits: the steps converge where the displacement contracts; the others are marked suspicious for
//   sheet_search.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/sea/query_kernel.cc"
#include "hwy/foreach_target.h"
//
#include <cstddef>
#include <cstring>

#include "common/sea/query_kernel.h"
#include "common/sea/sincos-inl.h"
#include "common/sea/spline-inl.h"
#include "common/sea/spline.h"
#include "hwy/cache_control.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace onesea::sea {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kB = kQueryBlock;
// Residual beyond which a second spline step follows, and then the careful path.
constexpr float kConvergedM = 5e-4f;
// Least eigenvalue of the Jacobian below which the surface may fold.
constexpr float kStretchMin = 0.7f;

// A point's place in one cascade and the values around it. All cascades are fetched before any is
// interpolated: wide loads must not run into the narrow stores just before them.
struct alignas(64) CascadeBlock {
  float frac_u[kB], frac_v[kB];  // of the displaced point
  std::int32_t cell_u[kB], cell_v[kB];
  std::int32_t offset[kB];  // of the undisplaced point's cell in the records, in floats
  float wu[kB], wv[kB];     // its place in the cell
  union {
    struct {
      float corners[4 * kB], high_corners[4 * kB];
    };
    struct {  // four a point
      float weight_u[4 * kB], weight_v[4 * kB], slope_u[4 * kB], slope_v[4 * kB];
    };
  };
};

struct alignas(64) Block {
  CascadeBlock cascades[kCascadesMax];
  std::uint32_t turns[kRegularWavesMax][kB];  // of the regular waves at the displaced point
  float d_x[kB], d_y[kB];                     // displacement so far
  float height[kB], residual_m[kB];           // after the spline step
  float stretch[kB];                          // least one met
  float active[kB];                           // > 0: takes the next spline step
  int order[kB];                              // the points of the next spline step
  float value[4 * kB], along_x[4 * kB], along_y[4 * kB];  // records summed over cascades
  float sum[9][kB];
  float velocity[3][kB];
  int count = 0;  // of order
};

// Sums over cascades at x - d.
enum Sum { kDx, kDy, kHeight, kJxx, kJyx, kSlopeX, kJxy, kJyy, kSlopeY };

HWY_INLINE void Reduce(const QueryGrids& grids, const double* x, const double* y, Block& block) {
  const hn::CappedTag<double, 8> d;
  const hn::Rebind<float, decltype(d)> df;
  const hn::Rebind<std::int32_t, decltype(d)> di;
  for (std::size_t c = 0; c < grids.cascades.size(); ++c) {
    const QueryCascade& cascade = grids.cascades[c];
    CascadeBlock& to = block.cascades[c];
    const auto cosine = hn::Set(d, cascade.cosine), sine = hn::Set(d, cascade.sine);
    const auto scale = hn::Set(d, cascade.cells_per_m);
    const auto size = hn::Set(d, static_cast<double>(cascade.grid_size));
    const auto inverse_size = hn::Set(d, 1.0 / cascade.grid_size);
    const auto place = [&](auto along, float* frac, std::int32_t* cell) HWY_ATTR {
      const auto u = hn::Mul(scale, along);
      const auto whole = hn::Floor(u);
      const auto wrapped = hn::Sub(whole, hn::Mul(size, hn::Floor(hn::Mul(whole, inverse_size))));
      hn::Store(hn::DemoteTo(df, hn::Sub(u, whole)), df, frac);
      hn::Store(hn::DemoteTo(di, wrapped), di, cell);
    };
    for (std::size_t n = 0; n < kB; n += hn::Lanes(d)) {
      const auto px = hn::Load(d, x + n), py = hn::Load(d, y + n);
      place(hn::Add(hn::Mul(cosine, px), hn::Mul(sine, py)), to.frac_u + n, to.cell_u + n);
      place(hn::Sub(hn::Mul(cosine, py), hn::Mul(sine, px)), to.frac_v + n, to.cell_v + n);
    }
  }
}

// Cell and weights of x - d in one cascade.
HWY_INLINE void PlaceInCells(const QueryCascade& cascade, const Block& block, CascadeBlock& to) {
  const D d;
  const DI di;
  const V cosine = hn::Set(d, static_cast<float>(cascade.cosine * cascade.cells_per_m));
  const V sine = hn::Set(d, static_cast<float>(cascade.sine * cascade.cells_per_m));
  const VI mask = hn::Set(di, cascade.grid_size - 1);
  const VI pitch = hn::Set(di, cascade.grid_size + 4);
  for (std::size_t n = 0; n < kB; n += hn::Lanes(d)) {
    const V dx = hn::Load(d, block.d_x + n), dy = hn::Load(d, block.d_y + n);
    const V u =
        hn::Sub(hn::Load(d, to.frac_u + n), hn::Add(hn::Mul(cosine, dx), hn::Mul(sine, dy)));
    const V v =
        hn::Sub(hn::Load(d, to.frac_v + n), hn::Sub(hn::Mul(cosine, dy), hn::Mul(sine, dx)));
    const V whole_u = hn::Floor(u), whole_v = hn::Floor(v);
    hn::Store(hn::Sub(u, whole_u), d, to.wu + n);
    hn::Store(hn::Sub(v, whole_v), d, to.wv + n);
    const VI iu = hn::Add(hn::Load(di, to.cell_u + n), hn::ConvertTo(di, whole_u));
    const VI iv = hn::Add(hn::Load(di, to.cell_v + n), hn::ConvertTo(di, whole_v));
    const VI at = hn::Add(hn::Mul(hn::And(iv, mask), pitch), hn::And(iu, mask));
    hn::Store(hn::ShiftLeft<2>(at), di, to.offset + n);
  }
}

struct Corners {
  HWY_INLINE Corners() {}  // an implicit one would not get the target's attributes
  V c00, c10, c01, c11;
};
struct Bilinear {
  V value, along_u, along_v;  // the latter per cell
};
HWY_INLINE Bilinear Interpolate(const Corners& c, V wu, V wv) {
  const V low = hn::Sub(c.c10, c.c00), high = hn::Sub(c.c11, c.c01);
  const V a = hn::Add(c.c00, hn::Mul(wu, low));
  const V b = hn::Add(c.c01, hn::Mul(wu, high));
  const V along_v = hn::Sub(b, a);
  return {hn::Add(a, hn::Mul(wv, along_v)), hn::Add(low, hn::Mul(wv, hn::Sub(high, low))), along_v};
}

HWY_INLINE void AddTo(float* sum, V value) {
  hn::Store(hn::Add(hn::Load(D(), sum), value), D(), sum);
}

// Displacement at the corners of each point's cell.
HWY_INLINE void FetchCorners(const QueryCascade& cascade, CascadeBlock& to) {
  const std::size_t pitch = RecordPitchFloats(cascade.grid_size);
  for (int n = 0; n < kB; ++n) {
    const float* low = cascade.waves + to.offset[n] + pitch + 4;
    const float* high = low + pitch;
    CopyFirstTwo(low, low + 4, to.corners + 4 * n);
    CopyFirstTwo(high, high + 4, to.high_corners + 4 * n);
  }
}

template <bool kGradient>
HWY_INLINE void InterpolateDisplacement(const QueryGrids& grids, std::size_t cascades,
                                        Block& block) {
  const D d;
  for (std::size_t n = 0; n < kB; n += hn::Lanes(d)) {
    V sum_x = hn::Zero(d), sum_y = hn::Zero(d);
    V xx = hn::Zero(d), xy = hn::Zero(d), yx = hn::Zero(d), yy = hn::Zero(d);
    for (std::size_t c = 0; c < cascades; ++c) {
      const QueryCascade& cascade = grids.cascades[c];
      const CascadeBlock& at = block.cascades[c];
      Corners x, y;
      hn::LoadInterleaved4(d, at.corners + 4 * n, x.c00, y.c00, x.c10, y.c10);
      hn::LoadInterleaved4(d, at.high_corners + 4 * n, x.c01, y.c01, x.c11, y.c11);
      const V wu = hn::Load(d, at.wu + n), wv = hn::Load(d, at.wv + n);
      const Bilinear dx = Interpolate(x, wu, wv), dy = Interpolate(y, wu, wv);
      sum_x = hn::Add(sum_x, dx.value);
      sum_y = hn::Add(sum_y, dy.value);
      if constexpr (kGradient) {
        const V cosine = hn::Set(d, static_cast<float>(cascade.cosine * cascade.cells_per_m));
        const V sine = hn::Set(d, static_cast<float>(cascade.sine * cascade.cells_per_m));
        xx = hn::Add(xx, hn::Sub(hn::Mul(cosine, dx.along_u), hn::Mul(sine, dx.along_v)));
        xy = hn::Add(xy, hn::Add(hn::Mul(sine, dx.along_u), hn::Mul(cosine, dx.along_v)));
        yx = hn::Add(yx, hn::Sub(hn::Mul(cosine, dy.along_u), hn::Mul(sine, dy.along_v)));
        yy = hn::Add(yy, hn::Add(hn::Mul(sine, dy.along_u), hn::Mul(cosine, dy.along_v)));
      }
    }
    hn::Store(sum_x, d, block.sum[kDx] + n);
    hn::Store(sum_y, d, block.sum[kDy] + n);
    if constexpr (kGradient) {
      hn::Store(xx, d, block.sum[kJxx] + n);
      hn::Store(xy, d, block.sum[kJxy] + n);
      hn::Store(yx, d, block.sum[kJyx] + n);
      hn::Store(yy, d, block.sum[kJyy] + n);
    }
  }
}

// sin and cos of a regular wave's phase at x - d.
HWY_INLINE void RegularPhase(const QueryRegular& wave, const std::uint32_t* turns,
                             const Block& block, std::size_t n, V& sine, V& cosine) {
  const D d;
  const DI di;
  const V shift = hn::Add(hn::Mul(hn::Set(d, wave.kx_turns_per_m), hn::Load(d, block.d_x + n)),
                          hn::Mul(hn::Set(d, wave.ky_turns_per_m), hn::Load(d, block.d_y + n)));
  const V rest = hn::Sub(shift, hn::Round(shift));
  const VI fraction = hn::ShiftLeft<1>(hn::ConvertTo(di, hn::Mul(rest, hn::Set(d, 0x1p31f))));
  SinCosTurns(d, hn::Sub(hn::Load(DU(), turns + n), hn::BitCast(DU(), fraction)), sine, cosine);
}

HWY_INLINE V FactorOf(const QueryRegular& wave, Field field) {
  return hn::Set(D(), wave.factors[static_cast<int>(field)]);
}

// Adds the regular waves at x - d: displacement, its gradient, height and its gradient.
template <bool kGradient, bool kWithHeight>
HWY_INLINE void AddRegular(const QueryGrids& grids, Block& block) {
  const D d;
  for (std::size_t r = 0; r < grids.regular.size(); ++r) {
    const QueryRegular& wave = grids.regular[r];
    for (std::size_t n = 0; n < kB; n += hn::Lanes(d)) {
      V sine, cosine;
      RegularPhase(wave, block.turns[r], block, n, sine, cosine);
      AddTo(block.sum[kDx] + n, hn::Neg(hn::Mul(FactorOf(wave, Field::kDisplacementX), sine)));
      AddTo(block.sum[kDy] + n, hn::Neg(hn::Mul(FactorOf(wave, Field::kDisplacementY), sine)));
      if constexpr (kGradient) {
        AddTo(block.sum[kJxx] + n, hn::Mul(FactorOf(wave, Field::kJacobianXX), cosine));
        AddTo(block.sum[kJxy] + n, hn::Mul(FactorOf(wave, Field::kJacobianXY), cosine));
        AddTo(block.sum[kJyx] + n, hn::Mul(FactorOf(wave, Field::kJacobianXY), cosine));
        AddTo(block.sum[kJyy] + n, hn::Mul(FactorOf(wave, Field::kJacobianYY), cosine));
      }
      if constexpr (kWithHeight) {
        AddTo(block.sum[kHeight] + n, hn::Mul(FactorOf(wave, Field::kHeight), cosine));
        AddTo(block.sum[kSlopeX] + n, hn::Neg(hn::Mul(FactorOf(wave, Field::kSlopeX), sine)));
        AddTo(block.sum[kSlopeY] + n, hn::Neg(hn::Mul(FactorOf(wave, Field::kSlopeY), sine)));
      }
    }
  }
}

// Displacement at x - d of the first cascades, with its gradient if asked for, to the accuracy of a
// start.
template <bool kGradient>
HWY_INLINE void ReadBilinear(const QueryGrids& grids, std::size_t cascades, Block& block) {
  for (std::size_t c = 0; c < cascades; ++c) {
    PlaceInCells(grids.cascades[c], block, block.cascades[c]);
    FetchCorners(grids.cascades[c], block.cascades[c]);
  }
  InterpolateDisplacement<kGradient>(grids, cascades, block);
  AddRegular<kGradient, false>(grids, block);
}

// Reads the spline of one cascade at point n; adds the record there to `value` and, if they are
// wanted, its derivatives to `along_x` and `along_y`.
template <bool kGradient>
HWY_INLINE void AddSpline(const QueryCascade& cascade, const float* records, const CascadeBlock& at,
                          int n, Record& value, Record& along_x, Record& along_y) {
  const D d;
  const std::size_t pitch = RecordPitchFloats(cascade.grid_size);
  V values[kChunks], along_us[kChunks], along_vs[kChunks];
  for (int chunk = 0; chunk < kChunks; ++chunk) {
    const float* from = records + at.offset[n] + chunk * kLanes;
    const V rows[4] = {hn::LoadU(d, from), hn::LoadU(d, from + pitch),
                       hn::LoadU(d, from + 2 * pitch), hn::LoadU(d, from + 3 * pitch)};
    const V column = CombineRows(rows, at.weight_v + 4 * n);
    const V weight_u = ExpandWeights(at.weight_u + 4 * n, chunk);
    values[chunk] = hn::Mul(weight_u, column);
    if constexpr (kGradient) {
      along_us[chunk] = hn::Mul(ExpandWeights(at.slope_u + 4 * n, chunk), column);
      along_vs[chunk] = hn::Mul(weight_u, CombineRows(rows, at.slope_v + 4 * n));
    }
  }
  value = Add(value, SumRecords(values));
  if constexpr (kGradient) {
    const Record along_u = SumRecords(along_us), along_v = SumRecords(along_vs);
    const auto cosine = static_cast<float>(cascade.cosine * cascade.cells_per_m);
    const auto sine = static_cast<float>(cascade.sine * cascade.cells_per_m);
    along_x = Add(along_x, Add(Scale(cosine, along_u), Scale(-sine, along_v)));
    along_y = Add(along_y, Add(Scale(sine, along_u), Scale(cosine, along_v)));
  }
}

// Points ahead of the one at work whose rows are asked for.
constexpr int kAhead = 3;

HWY_INLINE void PrefetchRows(const QueryCascade& cascade, std::int32_t offset) {
  const std::size_t pitch = RecordPitchFloats(cascade.grid_size);
  const float* row = cascade.waves + offset;
  for (int r = 0; r < 4; ++r, row += pitch) {
    hwy::Prefetch(row);
    hwy::Prefetch(row + 15);
  }
}

HWY_INLINE void PlaceInSpline(const QueryGrids& grids, Block& block) {
  for (std::size_t c = 0; c < grids.cascades.size(); ++c) {
    CascadeBlock& at = block.cascades[c];
    PlaceInCells(grids.cascades[c], block, at);
    WeighSpline(at.wu, kB, at.weight_u, at.slope_u);
    WeighSpline(at.wv, kB, at.weight_v, at.slope_v);
  }
}

// Displacement and height at x - d with their gradients, of the points in block.order alone. The
// others' sums are left without meaning.
HWY_INLINE void ReadSpline(const QueryGrids& grids, Block& block) {
  const D d;
  PlaceInSpline(grids, block);
  for (int at = 0; at < block.count; ++at) {
    const int n = block.order[at];
    if (at + kAhead < block.count) {
      for (std::size_t c = 0; c < grids.cascades.size(); ++c) {
        PrefetchRows(grids.cascades[c], block.cascades[c].offset[block.order[at + kAhead]]);
      }
    }
    Record value = Zero(), along_x = Zero(), along_y = Zero();
    for (std::size_t c = 0; c < grids.cascades.size(); ++c) {
      AddSpline<true>(grids.cascades[c], grids.cascades[c].waves, block.cascades[c], n, value,
                      along_x, along_y);
    }
    Put(value, block.value + 4 * n);
    Put(along_x, block.along_x + 4 * n);
    Put(along_y, block.along_y + 4 * n);
  }
  const auto unpack = [&](const float* records, int first) HWY_ATTR {
    for (std::size_t n = 0; n < kB; n += hn::Lanes(d)) {
      V x, y, z, none;
      hn::LoadInterleaved4(d, records + 4 * n, x, y, z, none);
      hn::Store(x, d, block.sum[first] + n);
      hn::Store(y, d, block.sum[first + 1] + n);
      hn::Store(z, d, block.sum[first + 2] + n);
    }
  };
  unpack(block.value, kDx);
  unpack(block.along_x, kJxx);
  unpack(block.along_y, kJxy);
  AddRegular<true, true>(grids, block);
}

HWY_INLINE V Length(V x, V y) { return hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(y, y))); }

HWY_INLINE void FixedPointStep(const QueryGrids& grids, std::size_t cascades, Block& block) {
  const D d;
  ReadBilinear<false>(grids, cascades, block);
  for (std::size_t n = 0; n < kB; n += hn::Lanes(d)) {
    const V dx = hn::Load(d, block.sum[kDx] + n), dy = hn::Load(d, block.sum[kDy] + n);
    hn::Store(dx, d, block.d_x + n);
    hn::Store(dy, d, block.d_y + n);
  }
}

// (I + ∇D) step = (r_x, r_y); a determinant near zero is held off it: such points are suspicious
// anyway.
HWY_INLINE void SolveJacobian(const Block& block, std::size_t n, V r_x, V r_y, V& step_x, V& step_y,
                              V& stretch) {
  const D d;
  const V one = hn::Set(d, 1.0f), half = hn::Set(d, 0.5f);
  const V xx = hn::Add(one, hn::Load(d, block.sum[kJxx] + n)),
          yy = hn::Add(one, hn::Load(d, block.sum[kJyy] + n));
  const V xy = hn::Load(d, block.sum[kJxy] + n), yx = hn::Load(d, block.sum[kJyx] + n);
  const V determinant = hn::Sub(hn::Mul(xx, yy), hn::Mul(xy, yx));
  const V safe = hn::Max(determinant, hn::Set(d, 0.1f));
  step_x = hn::Div(hn::Sub(hn::Mul(yy, r_x), hn::Mul(xy, r_y)), safe);
  step_y = hn::Div(hn::Sub(hn::Mul(xx, r_y), hn::Mul(yx, r_x)), safe);
  // Least eigenvalue of the symmetric part.
  const V mean = hn::Mul(half, hn::Add(xx, yy));
  stretch = hn::Sub(mean, Length(hn::Mul(half, hn::Sub(xx, yy)), hn::Mul(half, hn::Add(xy, yx))));
}

HWY_INLINE void NewtonStep(const QueryGrids& grids, Block& block) {
  const D d;
  ReadBilinear<true>(grids, grids.cascades.size(), block);
  for (std::size_t n = 0; n < kB; n += hn::Lanes(d)) {
    const V dx = hn::Load(d, block.d_x + n), dy = hn::Load(d, block.d_y + n);
    V step_x, step_y, stretch;
    SolveJacobian(block, n, hn::Sub(hn::Load(d, block.sum[kDx] + n), dx),
                  hn::Sub(hn::Load(d, block.sum[kDy] + n), dy), step_x, step_y, stretch);
    hn::Store(hn::Add(dx, step_x), d, block.d_x + n);
    hn::Store(hn::Add(dy, step_y), d, block.d_y + n);
    hn::Store(stretch, d, block.stretch + n);
  }
}

// A Newton step of the active points by the spline. The residual after it is what a field of the
// greatest curvature would leave.
HWY_INLINE void SplineStep(const QueryGrids& grids, Block& block) {
  const D d;
  ReadSpline(grids, block);
  const V half_curvature = hn::Set(d, 0.5f * grids.curvature_per_m);
  for (std::size_t n = 0; n < kB; n += hn::Lanes(d)) {
    const auto active = hn::Gt(hn::Load(d, block.active + n), hn::Zero(d));
    const V dx = hn::Load(d, block.d_x + n), dy = hn::Load(d, block.d_y + n);
    V step_x, step_y, stretch;
    SolveJacobian(block, n, hn::Sub(hn::Load(d, block.sum[kDx] + n), dx),
                  hn::Sub(hn::Load(d, block.sum[kDy] + n), dy), step_x, step_y, stretch);
    const auto put = [&](V value, float* to) HWY_ATTR {
      hn::Store(hn::IfThenElse(active, value, hn::Load(d, to + n)), d, to + n);
    };
    // d grows by the step, so the undisplaced point x - d moves back by it.
    const V lift = hn::Add(hn::Mul(hn::Load(d, block.sum[kSlopeX] + n), step_x),
                           hn::Mul(hn::Load(d, block.sum[kSlopeY] + n), step_y));
    put(hn::Sub(hn::Load(d, block.sum[kHeight] + n), lift), block.height);
    put(hn::Add(dx, step_x), block.d_x);
    put(hn::Add(dy, step_y), block.d_y);
    put(hn::Mul(half_curvature, hn::Add(hn::Mul(step_x, step_x), hn::Mul(step_y, step_y))),
        block.residual_m);
    put(hn::Min(stretch, hn::Load(d, block.stretch + n)), block.stretch);
  }
}

// Only points whose residual is large stay active.
HWY_INLINE void KeepUnsolved(Block& block) {
  int kept = 0;
  for (int at = 0; at < block.count; ++at) {
    const int n = block.order[at];
    const bool unsolved = !(block.residual_m[n] <= kConvergedM);
    block.active[n] = unsolved ? 1.0f : 0.0f;
    block.order[kept] = n;
    kept += unsolved;
  }
  block.count = kept;
}

HWY_INLINE void LoadPoints(const QueryGrids& grids, std::span<const Vec2d> points, Block& block) {
  alignas(64) double x[kB];
  alignas(64) double y[kB];
  for (std::size_t n = 0; n < kB; ++n) {
    const Vec2d point = points[HWY_MIN(n, points.size() - 1)];
    x[n] = point.x;
    y[n] = point.y;
  }
  Reduce(grids, x, y, block);
  for (std::size_t r = 0; r < grids.regular.size(); ++r) {
    for (std::size_t n = 0; n < kB; ++n) {
      const double turns = grids.regular[r].wave.TurnsAt({x[n], y[n]});
      block.turns[r][n] = static_cast<std::uint32_t>(static_cast<std::int64_t>(turns * 0x1p32));
    }
  }
}

HWY_INLINE void SelectAll(std::size_t points, Block& block) {
  block.count = static_cast<int>(points);
  for (int n = 0; n < kB; ++n) {
    block.order[n] = n;
    block.active[n] = 1.0f;
  }
}

void SolveBlock(const QueryGrids& grids, std::span<const Vec2d> points,
                std::span<SurfaceSample> out, std::span<bool> suspicious) {
  Block block;
  LoadPoints(grids, points, block);
  std::memset(block.d_x, 0, sizeof block.d_x);
  std::memset(block.d_y, 0, sizeof block.d_y);
  SelectAll(points.size(), block);
  // The short waves of the last cascades say nothing while d is off by more than their length.
  const std::size_t cascades = grids.cascades.size();
  FixedPointStep(grids, (cascades + 1) / 2, block);
  FixedPointStep(grids, cascades - cascades / 4, block);
  NewtonStep(grids, block);
  SplineStep(grids, block);
  KeepUnsolved(block);
  if (block.count > 0) SplineStep(grids, block);
  for (std::size_t n = 0; n < points.size(); ++n) {
    SurfaceSample& sample = out[n];
    sample = SurfaceSample{};
    sample.height_m = block.height[n];
    sample.displacement_x_m = block.d_x[n];
    sample.displacement_y_m = block.d_y[n];
    sample.residual_m = block.residual_m[n];
    suspicious[n] = !(block.residual_m[n] <= kConvergedM && block.stretch[n] >= kStretchMin);
  }
}

// Velocity at x - d, after ReadSpline() has placed the points.
HWY_INLINE void ReadVelocity(const QueryGrids& grids, Block& block) {
  const D d;
  for (int n = 0; n < block.count; ++n) {
    Record value = Zero(), none = Zero();
    for (std::size_t c = 0; c < grids.cascades.size(); ++c) {
      AddSpline<false>(grids.cascades[c], grids.cascades[c].velocities, block.cascades[c], n, value,
                       none, none);
    }
    Put(value, block.value + 4 * n);
  }
  for (std::size_t n = 0; n < kB; n += hn::Lanes(d)) {
    V x, y, z, none;
    hn::LoadInterleaved4(d, block.value + 4 * n, x, y, z, none);
    for (std::size_t r = 0; r < grids.regular.size(); ++r) {
      const QueryRegular& wave = grids.regular[r];
      V sine, cosine;
      RegularPhase(wave, block.turns[r], block, n, sine, cosine);
      x = hn::Add(x, hn::Mul(FactorOf(wave, Field::kVelocityX), cosine));
      y = hn::Add(y, hn::Mul(FactorOf(wave, Field::kVelocityY), cosine));
      z = hn::Sub(z, hn::Mul(FactorOf(wave, Field::kVelocityZ), sine));
    }
    hn::Store(x, d, block.velocity[0] + n);
    hn::Store(y, d, block.velocity[1] + n);
    hn::Store(z, d, block.velocity[2] + n);
  }
}

void FinishBlockTarget(const QueryGrids& grids, std::span<const Vec2d> points,
                       std::span<SurfaceSample> out) {
  Block block;
  LoadPoints(grids, points, block);
  for (std::size_t n = 0; n < kB; ++n) {
    const SurfaceSample& sample = out[HWY_MIN(n, points.size() - 1)];
    block.d_x[n] = sample.displacement_x_m;
    block.d_y[n] = sample.displacement_y_m;
  }
  SelectAll(points.size(), block);
  ReadSpline(grids, block);
  const bool velocity = grids.detail == QueryDetail::kVelocity;
  if (velocity) ReadVelocity(grids, block);
  const D d;
  const V one = hn::Set(d, 1.0f);
  for (std::size_t n = 0; n < kB; n += hn::Lanes(d)) {
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

void WriteRecordsTarget(const float* x, const float* y, const float* z, std::size_t size,
                        float* records) {
  const D d;
  const std::size_t pitch = 4 * (size + 4);
  for (std::size_t v = 0; v < size; ++v) {
    float* row = records + (v + 1) * pitch;
    for (std::size_t u = 0; u < size; u += hn::Lanes(d)) {
      const std::size_t at = v * size + u;
      hn::StoreInterleaved4(hn::Load(d, x + at), hn::Load(d, y + at), hn::Load(d, z + at),
                            hn::Zero(d), d, row + 4 * (u + 1));
    }
    std::memcpy(row, row + 4 * size, 4 * sizeof(float));
    std::memcpy(row + 4 * (size + 1), row + 4, 2 * 4 * sizeof(float));
  }
  std::memcpy(records, records + size * pitch, pitch * sizeof(float));
  std::memcpy(records + (size + 1) * pitch, records + pitch, 2 * pitch * sizeof(float));
}

}  // namespace HWY_NAMESPACE
}  // namespace onesea::sea
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <cmath>

#include "common/base/check.h"
#include "common/sea/constants.h"

namespace onesea::sea {

HWY_EXPORT(SolveBlock);
HWY_EXPORT(FinishBlockTarget);
HWY_EXPORT(WriteRecordsTarget);

void WriteRecords(const CascadeFields& fields, const Field (&planes)[3], float* records) {
  HWY_DYNAMIC_DISPATCH(WriteRecordsTarget)
  (fields.Plane(planes[0]).data(), fields.Plane(planes[1]).data(), fields.Plane(planes[2]).data(),
   static_cast<std::size_t>(fields.grid_size()), records);
}

void SampleBlock(const QueryGrids& grids, std::span<const Vec2d> points,
                 std::span<SurfaceSample> out, std::span<bool> suspicious) {
  ONESEA_CHECK(!points.empty() && points.size() <= kQueryBlock && out.size() == points.size() &&
               suspicious.size() == points.size());
  HWY_DYNAMIC_DISPATCH(SolveBlock)(grids, points, out, suspicious);
}

void FinishBlock(const QueryGrids& grids, std::span<const Vec2d> points,
                 std::span<SurfaceSample> out) {
  ONESEA_CHECK(!points.empty() && points.size() <= kQueryBlock && out.size() == points.size());
  HWY_DYNAMIC_DISPATCH(FinishBlockTarget)(grids, points, out);
}

}  // namespace onesea::sea
#endif  // HWY_ONCE
