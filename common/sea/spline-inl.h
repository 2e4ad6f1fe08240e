// Reading the cubic B-spline of spline.h with vectors. Included once per SIMD target.
//
// Vectors are as wide as the target's; a row of four records is kChunks of them. Additions across
// lanes have one order whatever the width, so the bits are the same.

#if defined(ONESEA_SEA_SPLINE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ONESEA_SEA_SPLINE_INL_H_
#undef ONESEA_SEA_SPLINE_INL_H_
#else
#define ONESEA_SEA_SPLINE_INL_H_
#endif

#include <cstddef>
#include <cstdint>
#include <cstring>

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

constexpr int kLanes = static_cast<int>(hn::MaxLanes(D()));
// A row of four records, in vectors.
constexpr int kChunks = 16 / kLanes;

// Four floats, whatever the lanes.
#if HWY_TARGET == HWY_SCALAR
struct Record {
  float at[4] = {};
};
HWY_INLINE Record Zero() { return {}; }
HWY_INLINE Record Add(Record a, Record b) {
  for (int f = 0; f < 4; ++f) a.at[f] += b.at[f];
  return a;
}
HWY_INLINE Record Scale(float factor, Record a) {
  for (float& f : a.at) f *= factor;
  return a;
}
HWY_INLINE void Put(Record a, float* to) { std::memcpy(to, a.at, sizeof a.at); }
HWY_INLINE void CopyFirstTwo(const float* a, const float* b, float* to) {
  std::memcpy(to, a, 2 * sizeof(float));
  std::memcpy(to + 2, b, 2 * sizeof(float));
}
HWY_INLINE Record SumRecords(const V* row) {
  Record sum;
  float at[16];
  for (int n = 0; n < 16; ++n) hn::Store(row[n], D(), at + n);
  for (int f = 0; f < 4; ++f) sum.at[f] = (at[f] + at[f + 8]) + (at[f + 4] + at[f + 12]);
  return sum;
}
#else
using D4 = hn::FixedTag<float, 4>;
using Record = hn::Vec<D4>;
HWY_INLINE Record Zero() { return hn::Zero(D4()); }
HWY_INLINE Record Add(Record a, Record b) { return hn::Add(a, b); }
HWY_INLINE Record Scale(float factor, Record a) { return hn::Mul(hn::Set(D4(), factor), a); }
HWY_INLINE void Put(Record a, float* to) { hn::Store(a, D4(), to); }
HWY_INLINE void CopyFirstTwo(const float* a, const float* b, float* to) {
  hn::Store(hn::ConcatLowerLower(D4(), hn::Load(D4(), b), hn::Load(D4(), a)), D4(), to);
}
// (0 + 2) + (1 + 3) of the four records of a row.
HWY_INLINE Record SumHalves(Record a) { return a; }
template <class Wide>
HWY_INLINE Record SumHalves(Wide a) {
  const hn::Half<hn::DFromV<Wide> > half;
  return SumHalves(hn::Add(hn::LowerHalf(a), hn::UpperHalf(half, a)));
}
template <class Chunk>
HWY_INLINE Record SumRecords(const Chunk* row) {
  if constexpr (kChunks == 4) {
    return hn::Add(hn::Add(row[0], row[2]), hn::Add(row[1], row[3]));
  } else if constexpr (kChunks == 2) {
    return SumHalves(hn::Add(row[0], row[1]));
  } else {
    return SumHalves(row[0]);
  }
}
#endif

// The four weights and their derivatives at each of `count` points, from its place `t` in its cell.
HWY_INLINE void WeighSpline(const float* t, std::size_t count, float* weights, float* slopes) {
  const D d;
  const V one = hn::Set(d, 1.0f), three = hn::Set(d, 3.0f), four = hn::Set(d, 4.0f);
  const V half = hn::Set(d, 0.5f), sixth = hn::Set(d, 1.0f / 6.0f);
  for (std::size_t n = 0; n < count; n += hn::Lanes(d)) {
    const V a = hn::Load(d, t + n), b = hn::Sub(one, a);
    const V a2 = hn::Mul(a, a), b2 = hn::Mul(b, b);
    const V a3 = hn::Mul(a2, a), b3 = hn::Mul(b2, b);
    // Of one point the middle two mirror each other: 4 - 6 t² + 3 t³ at t = a and t = b.
    const V w1 = hn::Add(four, hn::Mul(three, hn::Sub(a3, hn::Add(a2, a2))));
    const V w2 = hn::Add(four, hn::Mul(three, hn::Sub(b3, hn::Add(b2, b2))));
    hn::StoreInterleaved4(hn::Mul(sixth, b3), hn::Mul(sixth, w1), hn::Mul(sixth, w2),
                          hn::Mul(sixth, a3), d, weights + 4 * n);
    const V s1 = hn::Mul(half, hn::Sub(hn::Mul(three, a2), hn::Mul(four, a)));
    const V s2 = hn::Mul(half, hn::Sub(hn::Mul(four, b), hn::Mul(three, b2)));
    hn::StoreInterleaved4(hn::Neg(hn::Mul(half, b2)), s1, s2, hn::Mul(half, a2), d, slopes + 4 * n);
  }
}

// Weight t for every float of record t, of the records in chunk `chunk` of a row.
template <int kWidth = kLanes>
HWY_INLINE V ExpandWeights(const float* weights, int chunk) {
  const D d;
  if constexpr (kWidth <= 4) {
    return hn::Set(d, weights[chunk * kWidth / 4]);
  } else {
    alignas(64) constexpr std::int32_t kRecord[16] = {0, 0, 0, 0, 1, 1, 1, 1,
                                                      2, 2, 2, 2, 3, 3, 3, 3};
    return hn::TableLookupLanes(hn::LoadDup128(d, weights),
                                hn::SetTableIndices(d, kRecord + chunk * kWidth));
  }
}

// One row vector of the four rows at `from`, weighted.
HWY_INLINE V CombineRows(const V (&rows)[4], const float* w) {
  const D d;
  return hn::Add(hn::Add(hn::Mul(hn::Set(d, w[0]), rows[0]), hn::Mul(hn::Set(d, w[1]), rows[1])),
                 hn::Add(hn::Mul(hn::Set(d, w[2]), rows[2]), hn::Mul(hn::Set(d, w[3]), rows[3])));
}

}  // namespace HWY_NAMESPACE
}  // namespace onesea::sea
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
