// The cheap steps of the inversion: coefficients read bilinearly. Included once per SIMD target.

#if defined(ONESEA_SEA_QUERY_START_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ONESEA_SEA_QUERY_START_INL_H_
#undef ONESEA_SEA_QUERY_START_INL_H_
#else
#define ONESEA_SEA_QUERY_START_INL_H_
#endif

#include <cstddef>
#include <cstring>

#include "common/sea/query_block-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace onesea::sea {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Displacement at the corners of each point's cell.
HWY_INLINE void FetchCorners(const QueryCascade& cascade, std::size_t count, CascadeBlock& to) {
  const std::uint32_t* inner = cascade.waves.words + RecordPitchWords(cascade.grid_size) + 4;
  for (std::size_t n = 0; n < count; ++n) {
    const std::uint32_t* from = inner + 4 * to.record[n];
    std::memcpy(to.corners + 4 * n, from, 8);
    std::memcpy(to.corners + 4 * n + 2, from + 4, 8);
  }
}

// Multipliers of the corners' pairs: whole numbers of 1/2^14, since one is among them.
constexpr float kCornerOne = 16384.0f;

struct Bilinear {
  V value, along_u, along_v;  // in records' units; the latter per cell
};
// Of one displacement whose left and right pairs of corners are given.
HWY_INLINE Bilinear Interpolate(VU left, VU right, V wu, VI weights) {
  const D d;
  const DI di;
  const VI rise = hn::BitCast(di, hn::Set(DU(), 0x4000c000u));  // -1 and 1
  const V scale = hn::Set(d, 1.0f / kCornerOne);
  const auto combine = [&](VU corners, VI by) HWY_ATTR {
    return hn::Mul(scale,
                   hn::ConvertTo(d, MulAddPairs(hn::BitCast(di, corners), by, hn::Zero(di))));
  };
  const V a = combine(left, weights), along_u = hn::Sub(combine(right, weights), a);
  const V low = combine(left, rise);
  return {hn::Add(a, hn::Mul(wu, along_u)), along_u,
          hn::Add(low, hn::Mul(wu, hn::Sub(combine(right, rise), low)))};
}

HWY_INLINE VI CornerWeights(V wv) {
  const VI one = hn::Set(DI(), static_cast<std::int32_t>(kCornerOne));
  const VI high = hn::ConvertTo(DI(), hn::Mul(wv, hn::Set(D(), kCornerOne)));
  return hn::BitCast(DI(), JoinPair(hn::Sub(one, high), high));
}

template <bool kGradient>
HWY_INLINE void InterpolateDisplacement(const QueryGrids& grids, std::size_t cascades,
                                        Block& block) {
  const D d;
  for (std::size_t n = 0; n < block.padded; n += hn::Lanes(d)) {
    V sum_x = hn::Zero(d), sum_y = hn::Zero(d);
    V xx = hn::Zero(d), xy = hn::Zero(d), yx = hn::Zero(d), yy = hn::Zero(d);
    for (std::size_t c = 0; c < cascades; ++c) {
      const QueryCascade& cascade = grids.cascades[c];
      const CascadeBlock& at = block.cascades[c];
      VU left_x, left_y, right_x, right_y;
      hn::LoadInterleaved4(DU(), at.corners + 4 * n, left_x, left_y, right_x, right_y);
      const V wu = hn::Load(d, at.wu + n);
      const VI wv = CornerWeights(hn::Load(d, at.wv + n));
      const V unit = Attenuate(hn::Set(d, cascade.waves.unit), FactorsOf(block, c), n);
      const Bilinear dx = Interpolate(left_x, right_x, wu, wv);
      const Bilinear dy = Interpolate(left_y, right_y, wu, wv);
      sum_x = hn::Add(sum_x, hn::Mul(unit, dx.value));
      sum_y = hn::Add(sum_y, hn::Mul(unit, dy.value));
      if constexpr (kGradient) {
        const V cosine = hn::Mul(unit, hn::Set(d, cascade.cosine_cells_per_m));
        const V sine = hn::Mul(unit, hn::Set(d, cascade.sine_cells_per_m));
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

// Displacement at x - d of the first cascades, with its gradient if asked for, to the accuracy of a
// start.
template <bool kGradient>
HWY_INLINE void ReadBilinear(const QueryGrids& grids, std::size_t cascades, Block& block) {
  for (std::size_t c = 0; c < cascades; ++c) {
    PlaceInCells(grids.cascades[c], block, block.cascades[c]);
    FetchCorners(grids.cascades[c], block.padded, block.cascades[c]);
  }
  InterpolateDisplacement<kGradient>(grids, cascades, block);
  AddRegular<kGradient, false>(grids, block);
}

HWY_INLINE void FixedPointStep(const QueryGrids& grids, std::size_t cascades, Block& block) {
  const D d;
  ReadBilinear<false>(grids, cascades, block);
  for (std::size_t n = 0; n < block.padded; n += hn::Lanes(d)) {
    const V dx = hn::Load(d, block.sum[kDx] + n), dy = hn::Load(d, block.sum[kDy] + n);
    hn::Store(dx, d, block.d_x + n);
    hn::Store(dy, d, block.d_y + n);
  }
}

HWY_INLINE void NewtonStep(const QueryGrids& grids, Block& block) {
  const D d;
  ReadBilinear<true>(grids, grids.cascades.size(), block);
  for (std::size_t n = 0; n < block.padded; n += hn::Lanes(d)) {
    const V dx = hn::Load(d, block.d_x + n), dy = hn::Load(d, block.d_y + n);
    V step_x, step_y, stretch;
    SolveJacobian(block, n, hn::Sub(hn::Load(d, block.sum[kDx] + n), dx),
                  hn::Sub(hn::Load(d, block.sum[kDy] + n), dy), step_x, step_y, stretch);
    hn::Store(hn::Add(dx, step_x), d, block.d_x + n);
    hn::Store(hn::Add(dy, step_y), d, block.d_y + n);
    hn::Store(stretch, d, block.stretch + n);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace onesea::sea
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
