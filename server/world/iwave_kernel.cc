// Convolution with a kernel of eightfold symmetry, decimation and interpolation.
//
// Idea: a strip of one vector's width marches through the rows. From each input row the cells at
//   ±i are added once, then multiplied by the taps of the five row distances; each product goes
//   into the running sums of the two output rows at that distance, which stay in registers. 33
//   additions and 25 multiplications a vector for 81 taps, and nine loads.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/world/iwave_kernel.cc"
#include "hwy/foreach_target.h"
//
#include <algorithm>
#include <cstddef>

#include "hwy/highway.h"
#include "server/world/iwave_kernel.h"
#include "server/world/potential_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace onesea::world {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;

constexpr int kR = kIwaveRadius;

// Stores what lies before `columns`; the margin keeps its zeros.
HWY_INLINE void StoreWithin(V value, float* row, int x, int columns) {
  const D d;
  const int left = columns - x;
  if (left < static_cast<int>(hn::Lanes(d))) {
    value = hn::IfThenElseZero(hn::FirstN(d, static_cast<std::size_t>(std::max(left, 0))), value);
  }
  hn::Store(value, d, row + x);
}

// Taps of row distance j times the folded cells of one row.
HWY_INLINE V RowSum(const V* folded, const float* taps, int j) {
  const D d;
  V sum = hn::Mul(hn::Set(d, taps[j]), folded[0]);
  for (int i = 1; i <= kR; ++i) {
    sum = hn::Add(sum, hn::Mul(hn::Set(d, taps[i * (kR + 1) + j]), folded[i]));
  }
  return sum;
}

HWY_INLINE void ConvolveStrip(const WavePlane& in, const float* taps, const ConvolveRange& range,
                              int x, WavePlane& out) {
  const D d;
  V sums[2 * kR + 1];
  for (V& sum : sums) sum = hn::Zero(d);
  const int first = std::max(range.first_row - kR, 0);
  const int last = std::min(range.last_row + kR, in.rows);
  const float* cells = in.Row(first) + x;
  int done = first - kR;
  const auto shift = [&]() HWY_ATTR {
    if (done >= range.first_row && done < range.last_row) {
      StoreWithin(sums[0], out.Row(done), x, range.last_column);
    }
    for (int k = 0; k < 2 * kR; ++k) sums[k] = sums[k + 1];
    sums[2 * kR] = hn::Zero(d);
    ++done;
  };
  for (int y = first; y < last; ++y, cells += in.pitch) {
    V folded[kR + 1];
    folded[0] = hn::LoadU(d, cells);
    for (int i = 1; i <= kR; ++i) {
      folded[i] = hn::Add(hn::LoadU(d, cells - i), hn::LoadU(d, cells + i));
    }
    sums[kR] = hn::Add(sums[kR], RowSum(folded, taps, 0));
    for (int j = 1; j <= kR; ++j) {
      const V sum = RowSum(folded, taps, j);
      sums[kR - j] = hn::Add(sums[kR - j], sum);
      sums[kR + j] = hn::Add(sums[kR + j], sum);
    }
    shift();
  }
  while (done < range.last_row) shift();
}

void ConvolveStrips(const WavePlane& in, const IwaveTaps& taps, const ConvolveRange& range,
                    WavePlane& out) {
  float square[(kR + 1) * (kR + 1)];
  for (int i = 0; i <= kR; ++i) {
    for (int j = 0; j <= kR; ++j) {
      const int high = std::max(i, j), low = std::min(i, j);
      square[i * (kR + 1) + j] = taps[static_cast<std::size_t>(high * (high + 1) / 2 + low)];
    }
  }
  const D d;
  for (int x = range.first_column; x < range.last_column; x += static_cast<int>(hn::Lanes(d))) {
    ConvolveStrip(in, square, range, x, out);
  }
}

// out = in times weight, or that added to it.
template <bool kAdd>
HWY_INLINE void WeighInto(const WavePlane& in, const float* weight, const ConvolveRange& range,
                          WavePlane& out) {
  const D d;
  const std::size_t pitch = PackedCells(range) / (range.last_row - range.first_row);
  for (int y = range.first_row; y < range.last_row; ++y, weight += pitch) {
    for (int x = range.first_column; x < range.last_column; x += static_cast<int>(hn::Lanes(d))) {
      V value = hn::Mul(hn::Load(d, in.Row(y) + x), hn::Load(d, weight + x - range.first_column));
      if constexpr (kAdd) value = hn::Add(hn::Load(d, out.Row(y) + x), value);
      hn::Store(value, d, out.Row(y) + x);
    }
  }
}

void WeighRange(const WavePlane& in, const float* weight, const ConvolveRange& range,
                WavePlane& out) {
  WeighInto<false>(in, weight, range, out);
}

void AddWeighedRange(const WavePlane& in, const float* weight, const ConvolveRange& range,
                     WavePlane& sum) {
  WeighInto<true>(in, weight, range, sum);
}

void DifferenceRows(const WavePlane& phi, const FacePlanes& open, FacePlanes& difference) {
  const D d;
  for (int y = 0; y < phi.rows; ++y) {
    const float *here = phi.Row(y), *north = phi.Row(y + 1);
    for (int x = 0; x < phi.columns; x += static_cast<int>(hn::Lanes(d))) {
      const V centre = hn::Load(d, here + x);
      const V east = hn::Sub(hn::LoadU(d, here + x + 1), centre);
      hn::Store(hn::Mul(hn::Load(d, open.x.Row(y) + x), east), d, difference.x.Row(y) + x);
      const V up = hn::Sub(hn::Load(d, north + x), centre);
      hn::Store(hn::Mul(hn::Load(d, open.y.Row(y) + x), up), d, difference.y.Row(y) + x);
    }
  }
}

// The margins of `open` are zero: nothing crosses the rim.
void FlowRows(const GridPass& grid, const FacePlanes& flow, const FacePlanes& open, float scale) {
  const D d;
  const V by = hn::Set(d, scale), calm = hn::Set(d, kCalm);
  for (int y = 0; y < grid.rows; ++y) {
    float* height = grid.height + static_cast<std::size_t>(y) * grid.columns;
    const V keep_y = hn::Set(d, grid.keep_y[y]);
    for (int x = 0; x < grid.columns; x += static_cast<int>(hn::Lanes(d))) {
      const auto through = [&](const WavePlane& q, const WavePlane& o, int column,
                               int row) HWY_ATTR {
        return hn::Mul(hn::LoadU(d, q.Row(row) + column), hn::LoadU(d, o.Row(row) + column));
      };
      const V across = hn::Sub(through(flow.x, open.x, x, y), through(flow.x, open.x, x - 1, y));
      const V along = hn::Sub(through(flow.y, open.y, x, y), through(flow.y, open.y, x, y - 1));
      const V moved = hn::Sub(hn::Load(d, height + x), hn::Mul(by, hn::Add(across, along)));
      const V kept = hn::Mul(moved, hn::Mul(hn::Load(d, grid.keep_x + x), keep_y));
      hn::Store(hn::IfThenZeroElse(hn::Lt(hn::Abs(kept), calm), kept), d, height + x);
    }
  }
}

// (1 6 15 20 15 6 1) / 64 of seven values around the fourth.
HWY_INLINE V Binomial(V a, V b, V c, V centre, V e, V f, V g) {
  const D d;
  const V near = hn::Mul(hn::Set(d, 15.0f / 64.0f), hn::Add(c, e));
  const V far = hn::Mul(hn::Set(d, 6.0f / 64.0f), hn::Add(b, f));
  const V edge = hn::Mul(hn::Set(d, 1.0f / 64.0f), hn::Add(a, g));
  return hn::Add(hn::Add(hn::Mul(hn::Set(d, 20.0f / 64.0f), centre), near), hn::Add(far, edge));
}

void RestrictRows(const WavePlane& fine, WavePlane& coarse) {
  const D d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  HWY_ALIGN float filtered[WavePlane::kColumnsMax + 4 * WavePlane::kMarginColumns];
  float* const line = filtered + WavePlane::kMarginColumns;
  for (int y = 0; y < coarse.rows; ++y) {
    const float* row = fine.Row(2 * y);
    const auto pitch = static_cast<std::ptrdiff_t>(fine.pitch);
    // The margin's columns too: they are zero, and the sums below read them.
    for (int x = -16; x < fine.columns + 16; x += lanes) {
      const float* at = row + x;
      // The fourth row below and above are in the margin at worst.
      hn::Store(Binomial(hn::Load(d, at - 3 * pitch), hn::Load(d, at - 2 * pitch),
                         hn::Load(d, at - pitch), hn::Load(d, at), hn::Load(d, at + pitch),
                         hn::Load(d, at + 2 * pitch), hn::Load(d, at + 3 * pitch)),
                d, line + x);
    }
    for (int x = 0; x < coarse.columns; x += lanes) {
      V even[4], odd[4];  // even[n] holds the cells 2 x - 4 + 2 n
      for (int n = 0; n < 4; ++n)
        hn::LoadInterleaved2(d, line + 2 * x - 4 + 2 * n, even[n], odd[n]);
      StoreWithin(Binomial(odd[0], even[1], odd[1], even[2], odd[2], even[3], odd[3]),
                  coarse.Row(y), x, coarse.columns);
    }
  }
}

// The columns of one coarse row, interpolated: twice as many.
HWY_INLINE void ProlongLine(const float* coarse, int columns, float* line) {
  const D d;
  const V six = hn::Set(d, 6.0f / 32.0f), twenty = hn::Set(d, 20.0f / 32.0f);
  const V one = hn::Set(d, 1.0f / 32.0f), fifteen = hn::Set(d, 15.0f / 32.0f);
  for (int x = 0; x < columns; x += static_cast<int>(hn::Lanes(d))) {
    const V before = hn::LoadU(d, coarse + x - 1), here = hn::Load(d, coarse + x);
    const V after = hn::LoadU(d, coarse + x + 1), next = hn::LoadU(d, coarse + x + 2);
    const V even = hn::Add(hn::Mul(twenty, here), hn::Mul(six, hn::Add(before, after)));
    const V odd =
        hn::Add(hn::Mul(fifteen, hn::Add(here, after)), hn::Mul(one, hn::Add(before, next)));
    hn::StoreInterleaved2(even, odd, d, line + 2 * x);
  }
}

void ProlongRows(const WavePlane& coarse, WavePlane& fine) {
  const D d;
  constexpr int kLine = WavePlane::kColumnsMax + 2 * WavePlane::kMarginColumns;
  HWY_ALIGN float lines[4][kLine];  // of the coarse rows y - 1 .. y + 2
  for (int n = 0; n < 3; ++n) ProlongLine(coarse.Row(n - 1), coarse.columns, lines[(n + 3) & 3]);
  const V six = hn::Set(d, 6.0f / 32.0f), twenty = hn::Set(d, 20.0f / 32.0f);
  const V one = hn::Set(d, 1.0f / 32.0f), fifteen = hn::Set(d, 15.0f / 32.0f);
  for (int y = 0; y < coarse.rows; ++y) {
    ProlongLine(coarse.Row(y + 2), coarse.columns, lines[(y + 2) & 3]);
    const float *before = lines[(y + 3) & 3], *here = lines[y & 3];
    const float *after = lines[(y + 1) & 3], *next = lines[(y + 2) & 3];
    float *even = fine.Row(2 * y), *odd = fine.Row(2 * y + 1);
    for (int x = 0; x < fine.columns; x += static_cast<int>(hn::Lanes(d))) {
      const V b = hn::Load(d, before + x), h = hn::Load(d, here + x);
      const V a = hn::Load(d, after + x), n = hn::Load(d, next + x);
      const V to_even = hn::Add(hn::Mul(twenty, h), hn::Mul(six, hn::Add(b, a)));
      const V to_odd = hn::Add(hn::Mul(fifteen, hn::Add(h, a)), hn::Mul(one, hn::Add(b, n)));
      StoreWithin(hn::Add(hn::Load(d, even + x), to_even), even, x, fine.columns);
      StoreWithin(hn::Add(hn::Load(d, odd + x), to_odd), odd, x, fine.columns);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace onesea::world
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace onesea::world {
HWY_EXPORT(ConvolveStrips);
HWY_EXPORT(WeighRange);
HWY_EXPORT(AddWeighedRange);
HWY_EXPORT(DifferenceRows);
HWY_EXPORT(FlowRows);
HWY_EXPORT(RestrictRows);
HWY_EXPORT(ProlongRows);

void Convolve(const WavePlane& in, const IwaveTaps& taps, const ConvolveRange& range,
              WavePlane& out) {
  HWY_DYNAMIC_DISPATCH(ConvolveStrips)(in, taps, range, out);
}
void Weigh(const WavePlane& in, const float* weight, const ConvolveRange& range, WavePlane& out) {
  HWY_DYNAMIC_DISPATCH(WeighRange)(in, weight, range, out);
}
void AddWeighed(const WavePlane& in, const float* weight, const ConvolveRange& range,
                WavePlane& sum) {
  HWY_DYNAMIC_DISPATCH(AddWeighedRange)(in, weight, range, sum);
}
void FaceDifferences(const WavePlane& phi, const FacePlanes& open, FacePlanes& difference) {
  HWY_DYNAMIC_DISPATCH(DifferenceRows)(phi, open, difference);
}
void AdvanceHeightByFlow(const GridPass& grid, const FacePlanes& flow, const FacePlanes& open,
                         float scale) {
  HWY_DYNAMIC_DISPATCH(FlowRows)(grid, flow, open, scale);
}
void Restrict(const WavePlane& fine, WavePlane& coarse) {
  HWY_DYNAMIC_DISPATCH(RestrictRows)(fine, coarse);
}
void ProlongAdd(const WavePlane& coarse, WavePlane& fine) {
  HWY_DYNAMIC_DISPATCH(ProlongRows)(coarse, fine);
}

}  // namespace onesea::world
#endif  // HWY_ONCE
