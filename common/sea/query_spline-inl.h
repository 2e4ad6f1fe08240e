// Reading the spline at points in flight. Included once per SIMD target.

#if defined(ONESEA_SEA_QUERY_SPLINE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ONESEA_SEA_QUERY_SPLINE_INL_H_
#undef ONESEA_SEA_QUERY_SPLINE_INL_H_
#else
#define ONESEA_SEA_QUERY_SPLINE_INL_H_
#endif

#include <cstddef>

#include "common/sea/query_block-inl.h"
#include "hwy/cache_control.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace onesea::sea {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A row of four records, weighted but not yet added up; summed over cascades in this form.
struct Row {
  HWY_INLINE Row() {
    for (V& chunk : chunks) chunk = hn::Zero(D());
  }
  HWY_INLINE void Add(int chunk, V value) { chunks[chunk] = hn::Add(chunks[chunk], value); }
  V chunks[kChunks];
};

// Adds what the spline of one cascade says at point n to `value` and, if they are wanted, its
// derivatives to `along_x` and `along_y`.
template <bool kGradient>
HWY_INLINE void AddSpline(const QueryCascade& cascade, const QueryRecords& records,
                          const CascadeBlock& at, std::size_t n, Row& value, Row& along_x,
                          Row& along_y) {
  const D d;
  const DI di;
  const std::size_t two_rows = 2 * RecordPitchWords(cascade.grid_size);
  const auto pair = [&](std::size_t which)
                        HWY_ATTR { return hn::BitCast(di, hn::Set(DU(), at.rows[4 * n + which])); };
  const V cosine = hn::Set(d, cascade.cosine_cells_per_m);
  const V sine = hn::Set(d, cascade.sine_cells_per_m);
  for (int chunk = 0; chunk < kChunks; ++chunk) {
    const std::uint32_t* from = records.words + 4 * at.record[n] + chunk * kLanes;
    const VI low = hn::BitCast(di, hn::LoadU(DU(), from));
    const VI high = hn::BitCast(di, hn::LoadU(DU(), from + two_rows));
    const auto combine = [&](VI low_weights, VI high_weights) HWY_ATTR {
      const VI sum = MulAddPairs(low, low_weights, hn::Zero(di));
      return hn::ConvertTo(d, MulAddPairs(high, high_weights, sum));
    };
    const V column = combine(pair(0), pair(1));
    const V weight_u = ExpandWeights(at.weight_u + 4 * n, chunk);
    value.Add(chunk, hn::Mul(weight_u, column));
    if constexpr (kGradient) {
      const V along_u = hn::Mul(ExpandWeights(at.slope_u + 4 * n, chunk), column);
      const V along_v = hn::Mul(weight_u, combine(pair(2), pair(3)));
      along_x.Add(chunk, hn::Sub(hn::Mul(cosine, along_u), hn::Mul(sine, along_v)));
      along_y.Add(chunk, hn::Add(hn::Mul(sine, along_u), hn::Mul(cosine, along_v)));
    }
  }
}

// Points ahead of the one at work whose records are asked for.
constexpr std::size_t kAhead = 3;

HWY_INLINE void Prefetch(const QueryGrids& grids, const Block& block, std::size_t n) {
  for (std::size_t c = 0; c < grids.cascades.size(); ++c) {
    const QueryCascade& cascade = grids.cascades[c];
    const std::uint32_t* row = cascade.waves.words + 4 * block.cascades[c].record[n];
    hwy::Prefetch(row);
    hwy::Prefetch(row + 15);
    row += 2 * RecordPitchWords(cascade.grid_size);
    hwy::Prefetch(row);
    hwy::Prefetch(row + 15);
  }
}

// Weights of columns carry the unit of the records, that of the pairs and what the terrain leaves
// of the cascade.
HWY_INLINE void StoreWeights(float unit, const float* factors, std::size_t count,
                             CascadeBlock& to) {
  const D d;
  const V whole = hn::Set(d, unit / kPairOne);
  const VI one = hn::Set(DI(), static_cast<std::int32_t>(kPairOne));
  for (std::size_t n = 0; n < count; n += hn::Lanes(d)) {
    const V scale = Attenuate(whole, factors, n);
    const Weights u = WeighSpline(hn::Load(d, to.wu + n));
    hn::StoreInterleaved4(hn::Mul(scale, u.w0), hn::Mul(scale, u.w1), hn::Mul(scale, u.w2),
                          hn::Mul(scale, u.w3), d, to.weight_u + 4 * n);
    hn::StoreInterleaved4(hn::Mul(scale, u.s0), hn::Mul(scale, u.s1), hn::Mul(scale, u.s2),
                          hn::Mul(scale, u.s3), d, to.slope_u + 4 * n);
    // Rounded, they must still add up to one and to nothing.
    const Weights v = WeighSpline(hn::Load(d, to.wv + n));
    const VI w0 = RoundWeight(v.w0), w2 = RoundWeight(v.w2), w3 = RoundWeight(v.w3);
    const VI s0 = RoundWeight(v.s0), s2 = RoundWeight(v.s2), s3 = RoundWeight(v.s3);
    const VI w1 = hn::Sub(hn::Sub(one, w0), hn::Add(w2, w3));
    const VI s1 = hn::Neg(hn::Add(s0, hn::Add(s2, s3)));
    hn::StoreInterleaved4(JoinPair(w0, w1), JoinPair(w2, w3), JoinPair(s0, s1), JoinPair(s2, s3),
                          DU(), to.rows + 4 * n);
  }
}

// A record of each point to three sums, one after another.
HWY_INLINE void Unpack(const float* records, std::size_t count, float (*sums)[kB]) {
  const D d;
  for (std::size_t n = 0; n < count; n += hn::Lanes(d)) {
    V x, y, z, none;
    hn::LoadInterleaved4(d, records + 4 * n, x, y, z, none);
    hn::Store(x, d, sums[0] + n);
    hn::Store(y, d, sums[1] + n);
    hn::Store(z, d, sums[2] + n);
  }
}

// Displacement and height at x - d with their gradients.
HWY_INLINE void ReadSpline(const QueryGrids& grids, Block& block) {
  const std::size_t cascades = grids.cascades.size();
  for (std::size_t c = 0; c < cascades; ++c) {
    PlaceInCells(grids.cascades[c], block, block.cascades[c]);
    StoreWeights(grids.cascades[c].waves.unit, FactorsOf(block, c), block.padded,
                 block.cascades[c]);
  }
  for (std::size_t n = 0; n < block.count; ++n) {
    if (n + kAhead < block.count) Prefetch(grids, block, n + kAhead);
    Row value, along_x, along_y;
    for (std::size_t c = 0; c < cascades; ++c) {
      AddSpline<true>(grids.cascades[c], grids.cascades[c].waves, block.cascades[c], n, value,
                      along_x, along_y);
    }
    Put(SumRecords(value.chunks), block.value + 4 * n);
    Put(SumRecords(along_x.chunks), block.along_x + 4 * n);
    Put(SumRecords(along_y.chunks), block.along_y + 4 * n);
  }
  Unpack(block.value, block.padded, block.sum + kDx);
  Unpack(block.along_x, block.padded, block.sum + kJxx);
  Unpack(block.along_y, block.padded, block.sum + kJxy);
  AddRegular<true, true>(grids, block);
}

// Velocity at x - d, after ReadSpline() has placed the points.
HWY_INLINE void ReadVelocity(const QueryGrids& grids, Block& block) {
  const D d;
  for (std::size_t c = 0; c < grids.cascades.size(); ++c) {
    StoreWeights(grids.cascades[c].velocities.unit, FactorsOf(block, c), block.padded,
                 block.cascades[c]);
  }
  for (std::size_t n = 0; n < block.count; ++n) {
    Row value, none;
    for (std::size_t c = 0; c < grids.cascades.size(); ++c) {
      AddSpline<false>(grids.cascades[c], grids.cascades[c].velocities, block.cascades[c], n, value,
                       none, none);
    }
    Put(SumRecords(value.chunks), block.value + 4 * n);
  }
  Unpack(block.value, block.padded, block.velocity);
  for (std::size_t r = 0; r < grids.regular.size(); ++r) {
    const QueryRegular& wave = grids.regular[r];
    for (std::size_t n = 0; n < block.padded; n += hn::Lanes(d)) {
      V sine, cosine;
      RegularPhase(grids, r, block, n, sine, cosine);
      AddTo(block.velocity[0] + n, hn::Mul(FactorOf(wave, Field::kVelocityX), cosine));
      AddTo(block.velocity[1] + n, hn::Mul(FactorOf(wave, Field::kVelocityY), cosine));
      AddTo(block.velocity[2] + n, hn::Neg(hn::Mul(FactorOf(wave, Field::kVelocityZ), sine)));
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace onesea::sea
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
