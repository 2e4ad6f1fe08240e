// Height above a point of the choppy sea: find p with p + D(p) = x, summed over all cascades.
//
// Idea: three fixed-point steps d <- D(x - d), one Newton step with the gradient of the
// interpolated field, then the
//   height with a first-order correction for what is left. Points go in blocks of 64; lanes are
//   points; each point's four corners are copied to a small buffer and transposed in registers,
//   since gathers are slow on half the machines.
// Bits: lanes never meet, nothing is fused: the same on every SIMD target.
// Limits: the four steps converge where the displacement contracts; the others are marked
// suspicious for sheet_search.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/sea/query_kernel.cc"
#include "hwy/foreach_target.h"
//
#include <cstddef>
#include <cstring>

#include "common/sea/query_kernel.h"
#include "common/sea/sincos-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace onesea::sea {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using DI = hn::RebindToSigned<D>;
using DU = hn::RebindToUnsigned<D>;
using V = hn::Vec<D>;
using VI = hn::Vec<DI>;

constexpr int kB = kQueryBlock;
// Residual beyond which the careful path answers.
constexpr float kConvergedM = 1e-3f;
// Ratio of successive steps beyond which the surface may fold; steps below the noise say nothing.
constexpr float kContractionMax = 0.45f;
constexpr float kStepNoiseM = 0.01f;
// Least eigenvalue of the Jacobian below which the surface may fold.
constexpr float kStretchMin = 0.6f;

// A point's place in one cascade and the values at its cell's corners. All cascades are fetched
// before any is interpolated: wide loads must not run into the narrow stores just before them.
struct alignas(64) CascadeBlock {
  float frac_u[kB], frac_v[kB];  // of the displaced point
  std::int32_t cell_u[kB], cell_v[kB];
  std::int32_t iu[kB], iv[kB];  // of the undisplaced point
  std::int32_t offset[kB];      // of its cell in QueryCascade::displacement, in floats
  float wu[kB], wv[kB];
  float corners[4 * kB], high_corners[4 * kB];
};

struct alignas(64) Block {
  CascadeBlock cascades[kCascadesMax];
  std::uint32_t turns[kRegularWavesMax][kB];  // of the regular waves at the displaced point
  float d_x[kB], d_y[kB];                     // displacement so far
  float step_m[kB];
  float doubt[kB];  // > 0: suspicious
  float plane_corners[4 * kB];
  float sum[9][kB];
};

// Sums over cascades at x - d.
enum Sum { kDx, kDy, kJxx, kJxy, kJyx, kJyy, kHeight, kSlopeX, kSlopeY };

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
  const VI pitch = hn::Set(di, cascade.grid_size + 1);
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
    const VI u_wrapped = hn::And(iu, mask), v_wrapped = hn::And(iv, mask);
    hn::Store(u_wrapped, di, to.iu + n);
    hn::Store(v_wrapped, di, to.iv + n);
    const VI at = hn::Add(hn::Mul(v_wrapped, pitch), u_wrapped);
    hn::Store(hn::ShiftLeft<1>(at), di, to.offset + n);
  }
}

// Corner values of each point's cell in a plain plane, 00, 10, 01, 11 (u first).
HWY_INLINE void FetchCorners(const float* plane, int grid_size, const CascadeBlock& at,
                             float* corners) {
  const int mask = grid_size - 1;
  for (int n = 0; n < kB; ++n) {
    const int iu = at.iu[n], iv = at.iv[n];
    const float* low = plane + static_cast<std::size_t>(iv) * grid_size;
    const float* high = plane + static_cast<std::size_t>((iv + 1) & mask) * grid_size;
    float* to = corners + 4 * n;
    if (HWY_LIKELY(iu != mask)) {
      std::memcpy(to, low + iu, 8);
      std::memcpy(to + 2, high + iu, 8);
    } else {
      to[0] = low[iu], to[1] = low[0], to[2] = high[iu], to[3] = high[0];
    }
  }
}

struct Corners {
  HWY_INLINE Corners() {}  // an implicit one would not get the target's attributes
  V c00, c10, c01, c11;
};
HWY_INLINE Corners LoadCorners(const float* corners, std::size_t n) {
  Corners c;
  hn::LoadInterleaved4(D(), corners + 4 * n, c.c00, c.c10, c.c01, c.c11);
  return c;
}
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

// Adds one plain field of one cascade to a sum, and its world gradient to two more if they are
// asked for.
HWY_INLINE void AddField(const QueryCascade& cascade, Field field, const CascadeBlock& at,
                         Block& block, int to, int to_x = -1, int to_y = -1) {
  const D d;
  FetchCorners(cascade.planes[static_cast<int>(field)], cascade.grid_size, at, block.plane_corners);
  const V cosine = hn::Set(d, static_cast<float>(cascade.cosine * cascade.cells_per_m));
  const V sine = hn::Set(d, static_cast<float>(cascade.sine * cascade.cells_per_m));
  for (std::size_t n = 0; n < kB; n += hn::Lanes(d)) {
    const Bilinear f = Interpolate(LoadCorners(block.plane_corners, n), hn::Load(d, at.wu + n),
                                   hn::Load(d, at.wv + n));
    AddTo(block.sum[to] + n, f.value);
    if (to_x < 0) continue;
    AddTo(block.sum[to_x] + n, hn::Sub(hn::Mul(cosine, f.along_u), hn::Mul(sine, f.along_v)));
    AddTo(block.sum[to_y] + n, hn::Add(hn::Mul(sine, f.along_u), hn::Mul(cosine, f.along_v)));
  }
}

HWY_INLINE void FetchDisplacement(const QueryCascade& cascade, CascadeBlock& to) {
  const std::size_t up = 2 * static_cast<std::size_t>(cascade.grid_size + 1);
  for (int n = 0; n < kB; ++n) {
    const float* at = cascade.displacement + to.offset[n];
    std::memcpy(to.corners + 4 * n, at, 16);
    std::memcpy(to.high_corners + 4 * n, at + up, 16);
  }
}

template <bool kGradient>
HWY_INLINE void InterpolateDisplacement(const QueryGrids& grids, Block& block) {
  const D d;
  for (std::size_t n = 0; n < kB; n += hn::Lanes(d)) {
    V sum_x = hn::Zero(d), sum_y = hn::Zero(d);
    V xx = hn::Zero(d), xy = hn::Zero(d), yx = hn::Zero(d), yy = hn::Zero(d);
    for (std::size_t c = 0; c < grids.cascades.size(); ++c) {
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

HWY_INLINE void ZeroSums(Block& block, int count) {
  for (int s = 0; s < count; ++s) std::memset(block.sum[s], 0, sizeof block.sum[s]);
}

HWY_INLINE V FactorOf(const QueryRegular& wave, Field field) {
  return hn::Set(D(), wave.factors[static_cast<int>(field)]);
}

// Sums over cascades and regular waves at x - d: displacement, its gradient, height and its
// gradient.
template <bool kGradient, bool kWithHeight = false>
HWY_INLINE void SumDisplacement(const QueryGrids& grids, Block& block) {
  const D d;
  for (std::size_t c = 0; c < grids.cascades.size(); ++c) {
    PlaceInCells(grids.cascades[c], block, block.cascades[c]);
    FetchDisplacement(grids.cascades[c], block.cascades[c]);
  }
  InterpolateDisplacement<kGradient>(grids, block);
  if constexpr (kWithHeight) {
    for (int sum : {kHeight, kSlopeX, kSlopeY})
      std::memset(block.sum[sum], 0, sizeof block.sum[sum]);
    for (std::size_t c = 0; c < grids.cascades.size(); ++c) {
      AddField(grids.cascades[c], Field::kHeight, block.cascades[c], block, kHeight, kSlopeX,
               kSlopeY);
    }
  }
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

HWY_INLINE V Length(V x, V y) { return hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(y, y))); }

// Notes the length of this step and whether the last one contracted.
HWY_INLINE void WatchStep(Block& block, std::size_t n, V step) {
  const D d;
  const V before = hn::Load(d, block.step_m + n);
  const auto grows = hn::And(hn::Gt(step, hn::Mul(hn::Set(d, kContractionMax), before)),
                             hn::Gt(step, hn::Set(d, kStepNoiseM)));
  hn::Store(hn::IfThenElse(grows, hn::Set(d, 1.0f), hn::Load(d, block.doubt + n)), d,
            block.doubt + n);
  hn::Store(step, d, block.step_m + n);
}

HWY_INLINE void FixedPointStep(const QueryGrids& grids, Block& block) {
  const D d;
  SumDisplacement<false>(grids, block);
  for (std::size_t n = 0; n < kB; n += hn::Lanes(d)) {
    const V dx = hn::Load(d, block.sum[kDx] + n), dy = hn::Load(d, block.sum[kDy] + n);
    WatchStep(
        block, n,
        Length(hn::Sub(dx, hn::Load(d, block.d_x + n)), hn::Sub(dy, hn::Load(d, block.d_y + n))));
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
  SumDisplacement<true>(grids, block);
  for (std::size_t n = 0; n < kB; n += hn::Lanes(d)) {
    const V dx = hn::Load(d, block.d_x + n), dy = hn::Load(d, block.d_y + n);
    V step_x, step_y, stretch;
    SolveJacobian(block, n, hn::Sub(hn::Load(d, block.sum[kDx] + n), dx),
                  hn::Sub(hn::Load(d, block.sum[kDy] + n), dy), step_x, step_y, stretch);
    hn::Store(hn::Add(dx, step_x), d, block.d_x + n);
    hn::Store(hn::Add(dy, step_y), d, block.d_y + n);
  }
}

// Height and residual at the last point; height and displacement are corrected to first order for
// the residual.
HWY_INLINE void FinalStep(const QueryGrids& grids, Block& block) {
  const D d;
  SumDisplacement<true, true>(grids, block);
  for (std::size_t n = 0; n < kB; n += hn::Lanes(d)) {
    const V dx = hn::Load(d, block.d_x + n), dy = hn::Load(d, block.d_y + n);
    const V r_x = hn::Sub(hn::Load(d, block.sum[kDx] + n), dx);
    const V r_y = hn::Sub(hn::Load(d, block.sum[kDy] + n), dy);
    V step_x, step_y, stretch;
    SolveJacobian(block, n, r_x, r_y, step_x, step_y, stretch);
    const V residual = Length(r_x, r_y);
    const auto bad =
        hn::Or(hn::Gt(residual, hn::Set(d, kConvergedM)), hn::Lt(stretch, hn::Set(d, kStretchMin)));
    hn::Store(hn::IfThenElse(bad, hn::Set(d, 1.0f), hn::Load(d, block.doubt + n)), d,
              block.doubt + n);
    hn::Store(residual, d, block.step_m + n);
    // d grows by the step, so the undisplaced point x - d moves back by it.
    const V lift = hn::Add(hn::Mul(hn::Load(d, block.sum[kSlopeX] + n), step_x),
                           hn::Mul(hn::Load(d, block.sum[kSlopeY] + n), step_y));
    hn::Store(hn::Sub(hn::Load(d, block.sum[kHeight] + n), lift), d, block.sum[kHeight] + n);
    hn::Store(hn::Add(dx, step_x), d, block.d_x + n);
    hn::Store(hn::Add(dy, step_y), d, block.d_y + n);
  }
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

void SolveBlock(const QueryGrids& grids, std::span<const Vec2d> points,
                std::span<SurfaceSample> out, std::span<bool> suspicious) {
  Block block;
  LoadPoints(grids, points, block);
  std::memset(block.d_x, 0, sizeof block.d_x);
  std::memset(block.d_y, 0, sizeof block.d_y);
  std::memset(block.doubt, 0, sizeof block.doubt);
  for (float& step : block.step_m) step = 1e30f;
  for (int step = 0; step < 3; ++step) FixedPointStep(grids, block);
  NewtonStep(grids, block);
  FinalStep(grids, block);
  for (std::size_t n = 0; n < points.size(); ++n) {
    SurfaceSample& sample = out[n];
    sample = SurfaceSample{};
    sample.height_m = block.sum[kHeight][n];
    sample.displacement_x_m = block.d_x[n];
    sample.displacement_y_m = block.d_y[n];
    sample.residual_m = block.step_m[n];
    suspicious[n] = block.doubt[n] > 0.0f;
  }
}

// One plain field summed over cascades into block.sum[at].
HWY_INLINE void SumNormalFields(const QueryGrids& grids, Block& block) {
  constexpr Field kFields[5] = {Field::kSlopeX, Field::kSlopeY, Field::kJacobianXX,
                                Field::kJacobianYY, Field::kJacobianXY};
  constexpr Field kVelocities[3] = {Field::kVelocityX, Field::kVelocityY, Field::kVelocityZ};
  const D d;
  ZeroSums(block, 8);
  const bool velocity = grids.detail == QueryDetail::kVelocity;
  for (std::size_t c = 0; c < grids.cascades.size(); ++c) {
    const CascadeBlock& at = block.cascades[c];
    PlaceInCells(grids.cascades[c], block, block.cascades[c]);
    for (int f = 0; f < 5; ++f) AddField(grids.cascades[c], kFields[f], at, block, f);
    for (int f = 0; velocity && f < 3; ++f) {
      AddField(grids.cascades[c], kVelocities[f], at, block, 5 + f);
    }
  }
  for (std::size_t r = 0; r < grids.regular.size(); ++r) {
    const QueryRegular& wave = grids.regular[r];
    for (std::size_t n = 0; n < kB; n += hn::Lanes(d)) {
      V sine, cosine;
      RegularPhase(wave, block.turns[r], block, n, sine, cosine);
      for (int f = 0; f < 5; ++f) {
        const V wave_part = f < 2 ? hn::Neg(sine) : cosine;
        AddTo(block.sum[f] + n, hn::Mul(FactorOf(wave, kFields[f]), wave_part));
      }
      AddTo(block.sum[5] + n, hn::Mul(FactorOf(wave, Field::kVelocityX), cosine));
      AddTo(block.sum[6] + n, hn::Mul(FactorOf(wave, Field::kVelocityY), cosine));
      AddTo(block.sum[7] + n, hn::Neg(hn::Mul(FactorOf(wave, Field::kVelocityZ), sine)));
    }
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
  SumNormalFields(grids, block);
  const D d;
  const V one = hn::Set(d, 1.0f);
  for (std::size_t n = 0; n < kB; n += hn::Lanes(d)) {
    const V sx = hn::Load(d, block.sum[0] + n), sy = hn::Load(d, block.sum[1] + n);
    const V xx = hn::Add(one, hn::Load(d, block.sum[2] + n)),
            yy = hn::Add(one, hn::Load(d, block.sum[3] + n));
    const V xy = hn::Load(d, block.sum[4] + n);
    // (xx, xy, sx) x (xy, yy, sy)
    const V nx = hn::Sub(hn::Mul(xy, sy), hn::Mul(sx, yy));
    const V ny = hn::Sub(hn::Mul(sx, xy), hn::Mul(xx, sy));
    const V nz = hn::Sub(hn::Mul(xx, yy), hn::Mul(xy, xy));
    const V length = hn::Sqrt(hn::Add(hn::Add(hn::Mul(nx, nx), hn::Mul(ny, ny)), hn::Mul(nz, nz)));
    const V scale = hn::Div(one, hn::Max(length, hn::Set(d, 1e-20f)));
    hn::Store(hn::Mul(nx, scale), d, block.sum[0] + n);
    hn::Store(hn::Mul(ny, scale), d, block.sum[1] + n);
    hn::Store(hn::Mul(nz, scale), d, block.sum[2] + n);
  }
  const bool velocity = grids.detail == QueryDetail::kVelocity;
  for (std::size_t n = 0; n < points.size(); ++n) {
    SurfaceSample& sample = out[n];
    sample.normal_x = block.sum[0][n];
    sample.normal_y = block.sum[1][n];
    sample.normal_z = block.sum[2][n];
    if (!velocity) continue;
    sample.velocity_x_m_per_s = block.sum[5][n] + static_cast<float>(grids.current_m_per_s.x);
    sample.velocity_y_m_per_s = block.sum[6][n] + static_cast<float>(grids.current_m_per_s.y);
    sample.velocity_z_m_per_s = block.sum[7][n];
  }
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

void InterleaveDisplacement(const CascadeFields& fields, float* displacement) {
  const std::size_t size = static_cast<std::size_t>(fields.grid_size()), pitch = size + 1;
  const float* dx = fields.Plane(Field::kDisplacementX).data();
  const float* dy = fields.Plane(Field::kDisplacementY).data();
  for (std::size_t y = 0; y < size; ++y) {
    float* row = displacement + 2 * y * pitch;
    for (std::size_t x = 0; x < size; ++x) {
      row[2 * x] = dx[y * size + x];
      row[2 * x + 1] = dy[y * size + x];
    }
    row[2 * size] = row[0];
    row[2 * size + 1] = row[1];
  }
  std::memcpy(displacement + 2 * size * pitch, displacement, 2 * pitch * sizeof(float));
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
