// Reading the cubic B-spline of spline.h with vectors. Included once per SIMD target.
//
// Vectors are as wide as the target's; a row of four records (query_records.h) is kChunks of them.
// Additions across lanes have one order whatever the width, so the bits are the same.

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
using VU = hn::Vec<DU>;

constexpr int kLanes = static_cast<int>(hn::MaxLanes(D()));
// A row of four records, in vectors.
constexpr int kChunks = 16 / kLanes;

// Four floats, whatever the lanes.
#if HWY_TARGET == HWY_SCALAR
struct Record {
  float at[4] = {};
};
HWY_INLINE void Put(Record a, float* to) { std::memcpy(to, a.at, sizeof a.at); }
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
HWY_INLINE void Put(Record a, float* to) { hn::Store(a, D4(), to); }
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

// Of the four coefficients around a point along one axis: their weights, and the derivatives of
// these.
struct Weights {
  HWY_INLINE Weights() {}  // an implicit one would not get the target's attributes
  V w0, w1, w2, w3;
  V s0, s1, s2, s3;
};

// `a` is the place in the cell.
HWY_INLINE Weights WeighSpline(V a) {
  const D d;
  const V one = hn::Set(d, 1.0f), three = hn::Set(d, 3.0f), four = hn::Set(d, 4.0f);
  const V half = hn::Set(d, 0.5f), sixth = hn::Set(d, 1.0f / 6.0f);
  const V b = hn::Sub(one, a), a2 = hn::Mul(a, a), b2 = hn::Mul(b, b);
  const V a3 = hn::Mul(a2, a), b3 = hn::Mul(b2, b);
  Weights to;
  // The middle two mirror each other: 4 - 6 t² + 3 t³ at t = a and t = b.
  to.w0 = hn::Mul(sixth, b3);
  to.w1 = hn::Mul(sixth, hn::Add(four, hn::Mul(three, hn::Sub(a3, hn::Add(a2, a2)))));
  to.w2 = hn::Mul(sixth, hn::Add(four, hn::Mul(three, hn::Sub(b3, hn::Add(b2, b2)))));
  to.w3 = hn::Mul(sixth, a3);
  to.s0 = hn::Neg(hn::Mul(half, b2));
  to.s1 = hn::Mul(half, hn::Sub(hn::Mul(three, a2), hn::Mul(four, a)));
  to.s2 = hn::Mul(half, hn::Sub(hn::Mul(four, b), hn::Mul(three, b2)));
  to.s3 = hn::Mul(half, a2);
  return to;
}

// Multipliers of pairs of rows are whole numbers of 1/2^15.
constexpr float kPairOne = 32768.0f;

HWY_INLINE VI RoundWeight(V w) {
  const D d;
  return hn::ConvertTo(DI(),
                       hn::Floor(hn::Add(hn::Mul(w, hn::Set(d, kPairOne)), hn::Set(d, 0.5f))));
}
HWY_INLINE VU JoinPair(VI low, VI high) {
  const VU half = hn::And(hn::BitCast(DU(), low), hn::Set(DU(), 0xffffu));
  return hn::Or(half, hn::ShiftLeft<16>(hn::BitCast(DU(), high)));
}

// Low half times low half plus high half times high half of each word, exactly, plus `sum`.
HWY_INLINE VI MulAddPairs(VI words, VI weights, VI sum) {
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
  const hn::Repartition<std::int16_t, DI> d16;
  VI none = sum;  // x86 adds the pairs in place and has no use for it
  return hn::ReorderWidenMulAccumulate(DI(), hn::BitCast(d16, words), hn::BitCast(d16, weights),
                                       sum, none);
#else
  const auto low = [](VI word) HWY_ATTR { return hn::ShiftRight<16>(hn::ShiftLeft<16>(word)); };
  const auto high = [](VI word) HWY_ATTR { return hn::ShiftRight<16>(word); };
  return hn::Add(sum,
                 hn::Add(hn::Mul(low(words), low(weights)), hn::Mul(high(words), high(weights))));
#endif
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

}  // namespace HWY_NAMESPACE
}  // namespace onesea::sea
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
