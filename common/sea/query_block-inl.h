// Points in flight, and what every step of their inversion does. Included once per SIMD target.

#if defined(ONESEA_SEA_QUERY_BLOCK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ONESEA_SEA_QUERY_BLOCK_INL_H_
#undef ONESEA_SEA_QUERY_BLOCK_INL_H_
#else
#define ONESEA_SEA_QUERY_BLOCK_INL_H_
#endif

#include <cstddef>
#include <cstdint>
#include <span>

#include "common/sea/grid_cell-inl.h"
#include "common/sea/query_kernel.h"
#include "common/sea/sincos-inl.h"
#include "common/sea/spline-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace onesea::sea {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kB = kQueryBlock;

// The points' places in one cascade and what is read around them. All cascades are fetched before
// any is interpolated: wide loads must not run into the narrow stores just before them.
struct alignas(64) CascadeBlock {
  float frac_u[kB], frac_v[kB];  // of the displaced point
  std::int32_t cell_u[kB], cell_v[kB];
  std::int32_t record[kB];  // the first of the 16 around the undisplaced point
  float wu[kB], wv[kB];     // its place in the cell
  union {
    std::uint32_t corners[4 * kB];  // two displacements at the left corners, then at the right
    struct {  // four a point: of columns, in records' units, and pairs of rows
      float weight_u[4 * kB], slope_u[4 * kB];
      std::uint32_t rows[4 * kB];  // two pairs of weights and two of their derivatives
    };
  };
};

struct alignas(64) Block {
  CascadeBlock cascades[kCascadesMax];
  std::uint32_t turns[kRegularWavesMax][kB];  // of the regular waves at the displaced point
  float d_x[kB], d_y[kB];                     // displacement so far
  float height[kB], residual_m[kB];           // after the spline step
  float stretch[kB];                          // least one met
  float value[4 * kB], along_x[4 * kB], along_y[4 * kB];  // records summed over cascades
  float sum[9][kB];
  float velocity[3][kB];
  float factor[kCascadesMax + 1][kB];  // of each cascade, then of the regular waves; if attenuated
  bool attenuated = false;
  std::size_t count = 0;   // of points
  std::size_t padded = 0;  // the same in whole vectors; the lanes beyond hold any point
};

// Sums over cascades at x - d.
enum Sum { kDx, kDy, kHeight, kJxx, kJyx, kSlopeX, kJxy, kJyy, kSlopeY };

HWY_INLINE void SetCount(std::size_t count, Block& block) {
  constexpr std::size_t kWidest = 16;  // on any target, so that their code differs little
  block.count = count;
  block.padded = (count + kWidest - 1) / kWidest * kWidest;
}

HWY_INLINE void LoadPoints(const QueryGrids& grids, std::span<const Vec2d> points, Block& block) {
  alignas(64) double x[kB];
  alignas(64) double y[kB];
  SetCount(points.size(), block);
  for (std::size_t n = 0; n < block.padded; ++n) {
    const Vec2d point = points[HWY_MIN(n, points.size() - 1)];
    x[n] = point.x;
    y[n] = point.y;
  }
  const GridCells::DD d;
  for (std::size_t c = 0; c < grids.cascades.size(); ++c) {
    const QueryCascade& cascade = grids.cascades[c];
    const GridCells cells(cascade.cosine, cascade.sine, cascade.cells_per_m, cascade.grid_size);
    CascadeBlock& to = block.cascades[c];
    for (std::size_t n = 0; n < block.padded; n += hn::Lanes(d)) {
      cells.Place(hn::Load(d, x + n), hn::Load(d, y + n), to.frac_u + n, to.cell_u + n,
                  to.frac_v + n, to.cell_v + n);
    }
  }
  block.attenuated = grids.attenuation != nullptr;
  if (block.attenuated) {
    for (std::size_t n = 0; n < block.padded; ++n) {
      grids.attenuation->AllAt({x[n], y[n]}, &block.factor[0][n], kB);
    }
  }
  for (std::size_t r = 0; r < grids.regular.size(); ++r) {
    for (std::size_t n = 0; n < block.padded; ++n) {
      const double turns = grids.regular[r].wave.TurnsAt({x[n], y[n]});
      block.turns[r][n] = static_cast<std::uint32_t>(static_cast<std::int64_t>(turns * 0x1p32));
    }
  }
}

// The points, with the displacements that were found for them.
HWY_INLINE void LoadSolved(const QueryGrids& grids, std::span<const Vec2d> points,
                           std::span<const SurfaceSample> samples, Block& block) {
  LoadPoints(grids, points, block);
  for (std::size_t n = 0; n < block.padded; ++n) {
    const SurfaceSample& sample = samples[HWY_MIN(n, points.size() - 1)];
    block.d_x[n] = sample.displacement_x_m;
    block.d_y[n] = sample.displacement_y_m;
  }
}

// Cell of x - d in one cascade and the place in it.
HWY_INLINE void PlaceInCells(const QueryCascade& cascade, const Block& block, CascadeBlock& to) {
  const D d;
  const DI di;
  const V cosine = hn::Set(d, cascade.cosine_cells_per_m);
  const V sine = hn::Set(d, cascade.sine_cells_per_m);
  const VI mask = hn::Set(di, cascade.grid_size - 1);
  const VI pitch = hn::Set(di, cascade.grid_size + 4);
  for (std::size_t n = 0; n < block.padded; n += hn::Lanes(d)) {
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
    hn::Store(at, di, to.record + n);
  }
}

// The factors of a cascade, or of the regular waves behind the last one; null in the open sea.
HWY_INLINE const float* FactorsOf(const Block& block, std::size_t plane) {
  return block.attenuated ? block.factor[plane] : nullptr;
}

// `value` times the factors of the points from n on.
HWY_INLINE V Attenuate(V value, const float* factors, std::size_t n) {
  if (factors == nullptr) return value;
  return hn::Mul(value, hn::Load(D(), factors + n));
}

HWY_INLINE void AddTo(float* sum, V value) {
  hn::Store(hn::Add(hn::Load(D(), sum), value), D(), sum);
}

// sin and cos of a regular wave's phase at x - d, attenuated.
HWY_INLINE void RegularPhase(const QueryGrids& grids, std::size_t r, const Block& block,
                             std::size_t n, V& sine, V& cosine) {
  const QueryRegular& wave = grids.regular[r];
  const D d;
  const DI di;
  const V shift = hn::Add(hn::Mul(hn::Set(d, wave.kx_turns_per_m), hn::Load(d, block.d_x + n)),
                          hn::Mul(hn::Set(d, wave.ky_turns_per_m), hn::Load(d, block.d_y + n)));
  const V rest = hn::Sub(shift, hn::Round(shift));
  const VI fraction = hn::ShiftLeft<1>(hn::ConvertTo(di, hn::Mul(rest, hn::Set(d, 0x1p31f))));
  const VU turns = hn::Load(DU(), block.turns[r] + n);
  SinCosTurns(d, hn::Sub(turns, hn::BitCast(DU(), fraction)), sine, cosine);
  const float* factors = FactorsOf(block, grids.cascades.size());
  sine = Attenuate(sine, factors, n);
  cosine = Attenuate(cosine, factors, n);
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
    for (std::size_t n = 0; n < block.padded; n += hn::Lanes(d)) {
      V sine, cosine;
      RegularPhase(grids, r, block, n, sine, cosine);
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

}  // namespace HWY_NAMESPACE
}  // namespace onesea::sea
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
