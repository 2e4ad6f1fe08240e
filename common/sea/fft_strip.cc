// The own transform.
//
// Problem: a cascade's spectrum fills |index| <= N/8 of N; a general FFT spends most of its time on
// zeros, and its
//   order of operations depends on the machine.
// Idea: lanes are independent columns. The first pass transforms along x for strips of 16 rows of
// the spectrum
//   (few rows are non-zero), a small block is transposed, the second pass transforms along y for
//   strips of 16 x and writes whole cache lines of the two output planes, which fall out
//   de-interleaved.
// Limits: vectors of at most 16 floats; radix 8 at most, since gcc spills larger butterflies.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/sea/fft_strip.cc"
#include "hwy/foreach_target.h"
//
#include <cstddef>

#include "common/sea/fft_strip.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace onesea::sea {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, kStripLanes>;
using V = hn::Vec<D>;

// An implicit constructor would not get the target's attributes, and NEON's could not be inlined.
struct Complex {
  HWY_INLINE Complex() {}
  HWY_INLINE Complex(V real, V imaginary) : re(real), im(imaginary) {}
  V re, im;
};

HWY_INLINE Complex Plus(Complex a, Complex b) { return {hn::Add(a.re, b.re), hn::Add(a.im, b.im)}; }
HWY_INLINE Complex Minus(Complex a, Complex b) {
  return {hn::Sub(a.re, b.re), hn::Sub(a.im, b.im)};
}
HWY_INLINE Complex PlusI(Complex a, Complex b) {  // a + i b
  return {hn::Sub(a.re, b.im), hn::Add(a.im, b.re)};
}
HWY_INLINE Complex MinusI(Complex a, Complex b) {  // a - i b
  return {hn::Add(a.re, b.im), hn::Sub(a.im, b.re)};
}
HWY_INLINE Complex Times(Complex a, const float* twiddle) {
  const D d;
  const V c = hn::Set(d, twiddle[0]);
  const V s = hn::Set(d, twiddle[1]);
  return {hn::Sub(hn::Mul(a.re, c), hn::Mul(a.im, s)), hn::Add(hn::Mul(a.re, s), hn::Mul(a.im, c))};
}

// a[k] <- Σ_m a[m] e^{2πi m k / 4}
HWY_INLINE void Butterfly4(Complex& a0, Complex& a1, Complex& a2, Complex& a3) {
  const Complex t0 = Plus(a0, a2), t1 = Minus(a0, a2);
  const Complex t2 = Plus(a1, a3), t3 = Minus(a1, a3);
  a0 = Plus(t0, t2);
  a1 = PlusI(t1, t3);
  a2 = Minus(t0, t2);
  a3 = MinusI(t1, t3);
}

template <int kRadix>
HWY_INLINE void Butterfly(Complex (&a)[kRadix]) {
  if constexpr (kRadix == 4) {
    Butterfly4(a[0], a[1], a[2], a[3]);
  } else {
    static_assert(kRadix == 8);
    Butterfly4(a[0], a[2], a[4], a[6]);
    Butterfly4(a[1], a[3], a[5], a[7]);
    const D d;
    const V h = hn::Set(d, 0.70710678f);
    const Complex o1 = {hn::Mul(hn::Sub(a[3].re, a[3].im), h),
                        hn::Mul(hn::Add(a[3].re, a[3].im), h)};
    // e^{3πi/4} o = i (o e^{πi/4}); the factor i goes into PlusI below.
    const Complex o3 = {hn::Mul(hn::Sub(a[7].re, a[7].im), h),
                        hn::Mul(hn::Add(a[7].re, a[7].im), h)};
    const Complex e0 = a[0], e1 = a[2], e2 = a[4], e3 = a[6], o0 = a[1], o2 = a[5];
    a[0] = Plus(e0, o0);
    a[1] = Plus(e1, o1);
    a[2] = PlusI(e2, o2);
    a[3] = PlusI(e3, o3);
    a[4] = Minus(e0, o0);
    a[5] = Minus(e1, o1);
    a[6] = MinusI(e2, o2);
    a[7] = MinusI(e3, o3);
  }
}

struct Source {
  const float* re;
  const float* im;
  std::size_t pitch;
};
struct Sink {
  float* re;
  float* im;
  std::size_t pitch;
};

HWY_INLINE Complex LoadRow(const Source& in, std::size_t row) {
  const D d;
  return {hn::LoadU(d, in.re + row * in.pitch), hn::LoadU(d, in.im + row * in.pitch)};
}

template <bool kTwiddled>
HWY_INLINE Complex LoadInput(const StripAxis& axis, const Source& in, const float* twiddles,
                             int n) {
  const D d;
  const int row = axis.source_row[n];
  if (row < 0) return {hn::Zero(d), hn::Zero(d)};
  Complex x = LoadRow(in, row);
  if constexpr (kTwiddled) x = Times(x, twiddles + 2 * row);
  if (axis.folds && n == axis.sub / 2) {
    const int last = 2 * axis.index_max;
    Complex other = LoadRow(in, last);
    if constexpr (kTwiddled) other = Times(other, twiddles + 2 * last);
    x = Plus(x, other);
  }
  return x;
}

// Scratch holds re and im of an element side by side: element n at n * 2 * kStripLanes.
HWY_INLINE float* Slot(float* scratch, int n) { return scratch + n * 2 * kStripLanes; }

HWY_INLINE Complex LoadSlot(const float* slot) {
  const D d;
  return {hn::Load(d, slot), hn::Load(d, slot + kStripLanes)};
}
HWY_INLINE void StoreSlot(Complex a, float* slot) {
  const D d;
  hn::Store(a.re, d, slot);
  hn::Store(a.im, d, slot + kStripLanes);
}

template <int kRadix>
HWY_INLINE void StoreTwiddled(Complex (&a)[kRadix], const float* twiddles, int n, int stride,
                              float* block) {
  StoreSlot(a[0], Slot(block, n));
  for (int k = 1; k < kRadix; ++k) {
    if (n != 0) a[k] = Times(a[k], twiddles + 2 * ((kRadix - 1) * n + k - 1));
    StoreSlot(a[k], Slot(block, n + k * stride));
  }
}

template <int kRadix, bool kTwiddled>
HWY_INLINE void FirstStage(const StripAxis& axis, const Source& in, const float* load_twiddles,
                           float* scratch) {
  const int stride = axis.sub / kRadix;
  const float* twiddles = axis.stage_twiddles[0].data();
  for (int n = 0; n < stride; ++n) {
    Complex a[kRadix];
    for (int m = 0; m < kRadix; ++m) {
      a[m] = LoadInput<kTwiddled>(axis, in, load_twiddles, n + m * stride);
    }
    Butterfly<kRadix>(a);
    StoreTwiddled<kRadix>(a, twiddles, n, stride, scratch);
  }
}

template <int kRadix>
HWY_INLINE void MiddleStage(const StripAxis& axis, int length, const float* twiddles,
                            float* scratch) {
  const int stride = length / kRadix;
  for (int start = 0; start < axis.sub; start += length) {
    float* block = Slot(scratch, start);
    for (int n = 0; n < stride; ++n) {
      Complex a[kRadix];
      for (int m = 0; m < kRadix; ++m) a[m] = LoadSlot(Slot(block, n + m * stride));
      Butterfly<kRadix>(a);
      StoreTwiddled<kRadix>(a, twiddles, n, stride, block);
    }
  }
}

template <int kRadix>
HWY_INLINE void LastStage(const StripAxis& axis, int q, const float* scratch, const Sink& out) {
  const D d;
  const int blocks = axis.sub / kRadix;
  const std::size_t step = out.pitch * static_cast<std::size_t>(axis.size / kRadix);
  for (int b = 0; b < blocks; ++b) {
    Complex a[kRadix];
    for (int m = 0; m < kRadix; ++m) {
      a[m] = LoadSlot(scratch + (b * kRadix + m) * 2 * kStripLanes);
    }
    Butterfly<kRadix>(a);
    const std::size_t row =
        axis.output_index[b] * static_cast<std::size_t>(axis.size / axis.sub) + q;
    for (int k = 0; k < kRadix; ++k) {
      hn::StoreU(a[k].re, d, out.re + row * out.pitch + k * step);
      hn::StoreU(a[k].im, d, out.im + row * out.pitch + k * step);
    }
  }
}

HWY_INLINE void SubTransform(const StripAxis& axis, int q, const Source& in, float* scratch,
                             const Sink& out) {
  const float* load_twiddles = axis.load_twiddles.data() + q * 2 * (2 * axis.index_max + 1);
  const int first = axis.radices.front();
  if (first == 8) {
    q == 0 ? FirstStage<8, false>(axis, in, load_twiddles, scratch)
           : FirstStage<8, true>(axis, in, load_twiddles, scratch);
  } else {
    q == 0 ? FirstStage<4, false>(axis, in, load_twiddles, scratch)
           : FirstStage<4, true>(axis, in, load_twiddles, scratch);
  }
  int length = axis.sub / first;
  for (std::size_t stage = 1; stage + 1 < axis.radices.size(); ++stage) {
    const float* twiddles = axis.stage_twiddles[stage].data();
    axis.radices[stage] == 8 ? MiddleStage<8>(axis, length, twiddles, scratch)
                             : MiddleStage<4>(axis, length, twiddles, scratch);
    length /= axis.radices[stage];
  }
  axis.radices.back() == 8 ? LastStage<8>(axis, q, scratch, out)
                           : LastStage<4>(axis, q, scratch, out);
}

// One strip of kStripLanes columns; narrower vectors go through it in steps.
HWY_INLINE void TransformStrip(const StripAxis& axis, const Source& in, float* scratch,
                               const Sink& out) {
  const std::size_t lanes = hn::Lanes(D());
  for (int q = 0; q < axis.size / axis.sub; ++q) {
    for (std::size_t l = 0; l < kStripLanes; l += lanes) {
      SubTransform(axis, q, {in.re + l, in.im + l, in.pitch}, scratch + l,
                   {out.re + l, out.im + l, out.pitch});
    }
  }
}

// columns (size x kStripLanes) -> rows[lane * pitch + x], for the first `lanes_used` lanes.
HWY_INLINE void TransposeStrip(const float* columns, int size, int lanes_used, float* rows,
                               std::size_t pitch) {
  const hn::CappedTag<float, 4> d4;
  int lane = 0;
  if (hn::Lanes(d4) == 4) {
    for (; lane + 4 <= lanes_used; lane += 4) {
      for (int x = 0; x < size; x += 4) {
        const float* from = columns + x * kStripLanes + lane;
#if HWY_TARGET != HWY_SCALAR
        const auto a = hn::Load(d4, from), b = hn::Load(d4, from + kStripLanes);
        const auto c = hn::Load(d4, from + 2 * kStripLanes),
                   e = hn::Load(d4, from + 3 * kStripLanes);
        const auto ab_low = hn::InterleaveLower(d4, a, b), ab_high = hn::InterleaveUpper(d4, a, b);
        const auto ce_low = hn::InterleaveLower(d4, c, e), ce_high = hn::InterleaveUpper(d4, c, e);
        float* to = rows + lane * pitch + x;
        hn::Store(hn::ConcatLowerLower(d4, ce_low, ab_low), d4, to);
        hn::Store(hn::ConcatUpperUpper(d4, ce_low, ab_low), d4, to + pitch);
        hn::Store(hn::ConcatLowerLower(d4, ce_high, ab_high), d4, to + 2 * pitch);
        hn::Store(hn::ConcatUpperUpper(d4, ce_high, ab_high), d4, to + 3 * pitch);
#else
        (void)from;
#endif
      }
    }
  }
  for (; lane < lanes_used; ++lane) {
    for (int x = 0; x < size; ++x) rows[lane * pitch + x] = columns[x * kStripLanes + lane];
  }
}

void Inverse2d(const StripAxis& axis, const float* in_re, const float* in_im, std::size_t in_pitch,
               StripTransform::Scratch& scratch, float* out_re, float* out_im) {
  const std::size_t size = axis.size;
  const std::size_t rows = 2 * axis.index_max + 1;
  float* columns_re = scratch.columns.get();
  float* columns_im = columns_re + size * kStripLanes;
  float* rows_re = scratch.rows.get();
  float* rows_im = rows_re + rows * scratch.row_pitch;
  for (std::size_t j = 0; j < rows; j += kStripLanes) {
    TransformStrip(axis, {in_re + j, in_im + j, in_pitch}, scratch.butterflies.get(),
                   {columns_re, columns_im, kStripLanes});
    const int used = static_cast<int>(HWY_MIN(rows - j, std::size_t{kStripLanes}));
    TransposeStrip(columns_re, axis.size, used, rows_re + j * scratch.row_pitch, scratch.row_pitch);
    TransposeStrip(columns_im, axis.size, used, rows_im + j * scratch.row_pitch, scratch.row_pitch);
  }
  for (std::size_t x = 0; x < size; x += kStripLanes) {
    const Source in = {rows_re + x, rows_im + x, static_cast<std::size_t>(scratch.row_pitch)};
    TransformStrip(axis, in, scratch.butterflies.get(), {out_re + x, out_im + x, size});
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace onesea::sea
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/base/real_math.h"
#include "common/sea/constants.h"

namespace onesea::sea {
HWY_EXPORT(Inverse2d);

namespace {

void AppendRoot(std::int64_t numerator, std::int64_t denominator, std::vector<float>& out) {
  // The remainder keeps the argument small, and equal roots get equal bits.
  const std::int64_t rest = ((numerator % denominator) + denominator) % denominator;
  const double angle_rad = 2.0 * kPi * static_cast<double>(rest) / static_cast<double>(denominator);
  out.push_back(static_cast<float>(real::Cos(angle_rad)));
  out.push_back(static_cast<float>(real::Sin(angle_rad)));
}

std::vector<int> RadicesOf(int sub) {
  switch (sub) {
    case 16:
      return {4, 4};
    case 32:
      return {8, 4};
    case 64:
      return {8, 8};
    case 128:
      return {8, 4, 4};
    case 256:
      return {8, 8, 4};
    case 512:
      return {8, 8, 8};
    default:
      return {8, 8, 4, 4};
  }
}

}  // namespace

StripAxis::StripAxis(int size_in, int index_max_in) : size(size_in), index_max(index_max_in) {
  ONESEA_CHECK(size >= kGridSizeMin && size <= kGridSizeMax && (size & (size - 1)) == 0)
      << "grid size " << size;
  ONESEA_CHECK(index_max >= 1 && index_max < size / 2)
      << "index " << index_max << " on a grid of " << size;
  sub = 16;
  while (sub < 2 * index_max) sub *= 2;
  folds = sub == 2 * index_max;
  radices = RadicesOf(sub);

  for (int n = 0; n < sub; ++n) {
    const int index = n < sub / 2 ? n : n - sub;
    source_row.push_back(index >= -index_max && index <= index_max ? index + index_max : -1);
  }
  for (int q = 0; q < size / sub; ++q) {
    for (int n = -index_max; n <= index_max; ++n)
      AppendRoot(std::int64_t{n} * q, size, load_twiddles);
  }
  int length = sub;
  for (std::size_t stage = 0; stage + 1 < radices.size(); ++stage) {
    std::vector<float>& twiddles = stage_twiddles.emplace_back();
    const int radix = radices[stage];
    for (int n = 0; n < length / radix; ++n) {
      for (int k = 1; k < radix; ++k) AppendRoot(std::int64_t{n} * k, length, twiddles);
    }
    length /= radix;
  }
  // Block b of the last stage has the digits of its outputs in the order of the stages, most
  // significant first in b, least significant first in the output.
  const int blocks = sub / radices.back();
  for (int b = 0; b < blocks; ++b) {
    int p = 0, rest = b, block_span = blocks, weight = 1;
    for (std::size_t stage = 0; stage + 1 < radices.size(); ++stage) {
      block_span /= radices[stage];
      p += weight * (rest / block_span);
      rest %= block_span;
      weight *= radices[stage];
    }
    output_index.push_back(p);
  }
}

StripTransform::StripTransform(int grid_size, int index_max) : axis_(grid_size, index_max) {
  const std::size_t size = grid_size;
  const std::size_t rows = 2 * index_max + 1;
  scratch_.row_pitch = grid_size + kStripLanes;
  scratch_.butterflies = AllocateZeros<float>(2 * axis_.sub * kStripLanes);
  scratch_.columns = AllocateZeros<float>(2 * size * kStripLanes);
  scratch_.rows = AllocateZeros<float>(2 * rows * scratch_.row_pitch);
}

void StripTransform::Inverse(const float* spectrum_re, const float* spectrum_im, float* out_re,
                             float* out_im) {
  HWY_DYNAMIC_DISPATCH(Inverse2d)
  (axis_, spectrum_re, spectrum_im, Pitch(), scratch_, out_re, out_im);
}

}  // namespace onesea::sea
#endif  // HWY_ONCE
