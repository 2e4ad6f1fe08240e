// Included once per SIMD target; see Highway's foreach_target.h.
#if defined(ONESEA_WORLD_TILE_TRANSPOSE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ONESEA_WORLD_TILE_TRANSPOSE_INL_H_
#undef ONESEA_WORLD_TILE_TRANSPOSE_INL_H_
#else
#define ONESEA_WORLD_TILE_TRANSPOSE_INL_H_
#endif

#include <cstddef>

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace onesea::world {
namespace HWY_NAMESPACE {
namespace tile {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;

#if HWY_TARGET != HWY_SCALAR
using V = hn::Vec<D>;

// In every 128-bit block, a[i] becomes column i of the 4 x 4 numbers.
HWY_INLINE void TransposeBlocks(V (&a)[4]) {
  const D d;
  const hn::Repartition<double, D> wide;
  const V ab_low = hn::InterleaveLower(d, a[0], a[1]), ab_high = hn::InterleaveUpper(d, a[0], a[1]);
  const V ce_low = hn::InterleaveLower(d, a[2], a[3]), ce_high = hn::InterleaveUpper(d, a[2], a[3]);
  const auto join = [&](V left, V right, bool upper) HWY_ATTR {
    const auto l = hn::BitCast(wide, left), r = hn::BitCast(wide, right);
    return hn::BitCast(d,
                       upper ? hn::InterleaveUpper(wide, l, r) : hn::InterleaveLower(wide, l, r));
  };
  a[0] = join(ab_low, ce_low, false);
  a[1] = join(ab_low, ce_low, true);
  a[2] = join(ab_high, ce_high, false);
  a[3] = join(ab_high, ce_high, true);
}
#endif

#if HWY_TARGET != HWY_SCALAR
// One square of 4 kGroups rows and columns.
template <std::size_t kGroups>
HWY_INLINE void TransposeSquare(const float* from, std::size_t from_pitch, float* to,
                                std::size_t to_pitch) {
  const D d;
  V a[kGroups][4];
  for (std::size_t g = 0; g < kGroups; ++g) {
    for (std::size_t i = 0; i < 4; ++i) a[g][i] = hn::LoadU(d, from + (4 * g + i) * from_pitch);
    TransposeBlocks(a[g]);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const auto store = [&](std::size_t column, V v)
                           HWY_ATTR { hn::StoreU(v, d, to + (column + i) * to_pitch); };
    if constexpr (kGroups == 1) {
      store(0, a[0][i]);
    } else if constexpr (kGroups == 2) {
      store(0, hn::ConcatLowerLower(d, a[1][i], a[0][i]));
      store(4, hn::ConcatUpperUpper(d, a[1][i], a[0][i]));
    } else {
      const auto even = [](V x, V y)
                            HWY_ATTR { return hn::OddEvenBlocks(hn::SwapAdjacentBlocks(y), x); };
      const auto odd = [](V x, V y)
                           HWY_ATTR { return hn::OddEvenBlocks(y, hn::SwapAdjacentBlocks(x)); };
      const V low_even = even(a[0][i], a[1][i]), high_even = even(a[2][i], a[3][i]);
      const V low_odd = odd(a[0][i], a[1][i]), high_odd = odd(a[2][i], a[3][i]);
      store(0, hn::ConcatLowerLower(d, high_even, low_even));
      store(4, hn::ConcatLowerLower(d, high_odd, low_odd));
      store(8, hn::ConcatUpperUpper(d, high_even, low_even));
      store(12, hn::ConcatUpperUpper(d, high_odd, low_odd));
    }
  }
}
#endif

// to[c * to_pitch + r] = from[r * from_pitch + c] for r < rows, c < columns, both multiples of 16.
// Pitches may be anything; pointers needn't be aligned.
HWY_INLINE void Transpose(const float* from, std::size_t from_pitch, std::size_t rows,
                          std::size_t columns, float* to, std::size_t to_pitch) {
#if HWY_TARGET == HWY_SCALAR
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t c = 0; c < columns; ++c) to[c * to_pitch + r] = from[r * from_pitch + c];
  }
#else
  constexpr std::size_t kLanes = hn::MaxLanes(D());
  for (std::size_t r = 0; r < rows; r += kLanes) {
    for (std::size_t c = 0; c < columns; c += kLanes) {
      TransposeSquare<kLanes / 4>(from + r * from_pitch + c, from_pitch, to + c * to_pitch + r,
                                  to_pitch);
    }
  }
#endif
}

}  // namespace tile
}  // namespace HWY_NAMESPACE
}  // namespace onesea::world
HWY_AFTER_NAMESPACE();

#endif
