// Height and velocity of each cascade by itself, at points whose displacement is known: for whoever
// needs to know how deep a wave reaches.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/sea/query_bands.cc"
#include "hwy/foreach_target.h"
//
#include <cstddef>

#include "common/sea/query_block-inl.h"
#include "common/sea/query_kernel.h"
#include "common/sea/query_spline-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace onesea::sea {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// What one cascade's records say at the points, into block.sum[0..2].
HWY_INLINE void ReadCascade(const QueryCascade& cascade, const QueryRecords& records,
                            const float* factors, CascadeBlock& at, Block& block) {
  StoreWeights(records.unit, factors, block.padded, at);
  for (std::size_t n = 0; n < block.count; ++n) {
    Row value, none;
    AddSpline<false>(cascade, records, at, n, value, none, none);
    Put(SumRecords(value.chunks), block.value + 4 * n);
  }
  Unpack(block.value, block.padded, block.sum);
}

HWY_INLINE void ReadRegular(const QueryGrids& grids, Block& block) {
  const D d;
  for (std::size_t n = 0; n < block.padded; n += hn::Lanes(d)) {
    V sums[4] = {hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    for (std::size_t r = 0; r < grids.regular.size(); ++r) {
      const QueryRegular& wave = grids.regular[r];
      V sine, cosine;
      RegularPhase(grids, r, block, n, sine, cosine);
      sums[0] = hn::Add(sums[0], hn::Mul(FactorOf(wave, Field::kHeight), cosine));
      sums[1] = hn::Add(sums[1], hn::Mul(FactorOf(wave, Field::kVelocityX), cosine));
      sums[2] = hn::Add(sums[2], hn::Mul(FactorOf(wave, Field::kVelocityY), cosine));
      sums[3] = hn::Sub(sums[3], hn::Mul(FactorOf(wave, Field::kVelocityZ), sine));
    }
    for (int k = 0; k < 4; ++k) hn::Store(sums[k], d, block.sum[k] + n);
  }
}

void BandBlockTarget(const QueryGrids& grids, std::span<const Vec2d> points,
                     std::span<const SurfaceSample> samples, float* out) {
  Block block;
  LoadSolved(grids, points, samples, block);
  const std::size_t stride = 4 * static_cast<std::size_t>(BandCount(grids));
  const auto put = [&](std::size_t band, std::size_t element, const float* values) {
    for (std::size_t n = 0; n < block.count; ++n) out[n * stride + 4 * band + element] = values[n];
  };
  for (std::size_t c = 0; c < grids.cascades.size(); ++c) {
    const QueryCascade& cascade = grids.cascades[c];
    PlaceInCells(cascade, block, block.cascades[c]);
    ReadCascade(cascade, cascade.waves, FactorsOf(block, c), block.cascades[c], block);
    put(c, 0, block.sum[2]);
    ReadCascade(cascade, cascade.velocities, FactorsOf(block, c), block.cascades[c], block);
    for (std::size_t axis = 0; axis < 3; ++axis) put(c, 1 + axis, block.sum[axis]);
  }
  if (grids.regular.empty()) return;
  ReadRegular(grids, block);
  for (std::size_t k = 0; k < 4; ++k) put(grids.cascades.size(), k, block.sum[k]);
}

}  // namespace HWY_NAMESPACE
}  // namespace onesea::sea
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "common/base/check.h"

namespace onesea::sea {

HWY_EXPORT(BandBlockTarget);

void BandBlock(const QueryGrids& grids, std::span<const Vec2d> points,
               std::span<const SurfaceSample> samples, std::span<float> out) {
  ONESEA_CHECK(!points.empty() && points.size() <= kQueryBlock && samples.size() == points.size() &&
               out.size() == 4 * points.size() * static_cast<std::size_t>(BandCount(grids)));
  HWY_DYNAMIC_DISPATCH(BandBlockTarget)(grids, points, samples, out.data());
}

}  // namespace onesea::sea
#endif  // HWY_ONCE
