// Included once per SIMD target, see hwy/foreach_target.h; hence no ordinary include guard.
#if defined(ONESEA_SEA_SINCOS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ONESEA_SEA_SINCOS_INL_H_
#undef ONESEA_SEA_SINCOS_INL_H_
#else
#define ONESEA_SEA_SINCOS_INL_H_
#endif

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace onesea::sea {
namespace HWY_NAMESPACE {

/// sin and cos of 2π turns / 2³² with the same bits on every target.
///
/// The quadrant is taken off exactly in integers; on the remaining eighth of a turn either way odd
/// and even polynomials in the fraction f of a turn interpolate sin(2πf)/f and (cos(2πf) - 1)/f² at
/// Chebyshev nodes in f² (approximation error 2.4e-8 and 0.9e-8). Error with rounding: at most
/// 1.5e-7 (tests/sea/evolve_test.cc).
template <class DF, class VU, class VF>
HWY_INLINE void SinCosTurns(DF df, VU turns, VF& sine, VF& cosine) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::RebindToUnsigned<DF> du;
  const hn::RebindToSigned<DF> di;
  const auto quadrant = hn::ShiftRight<30>(hn::Add(turns, hn::Set(du, 0x20000000u)));
  const auto rest = hn::BitCast(di, hn::Sub(turns, hn::ShiftLeft<30>(quadrant)));
  const auto f = hn::Mul(hn::ConvertTo(df, rest), hn::Set(df, 0x1p-32f));
  const auto g = hn::Mul(f, f);
  auto s = hn::Add(hn::Mul(g, hn::Set(df, -75.4016113281f)), hn::Set(df, 81.5925445557f));
  s = hn::Add(hn::Mul(g, s), hn::Set(df, -41.3416633606f));
  s = hn::Add(hn::Mul(g, s), hn::Set(df, 6.283185482f));
  s = hn::Mul(f, s);
  auto c = hn::Add(hn::Mul(g, hn::Set(df, 59.4241065979f)), hn::Set(df, -85.4488220215f));
  c = hn::Add(hn::Mul(g, c), hn::Set(df, 64.9393692017f));
  c = hn::Add(hn::Mul(g, c), hn::Set(df, -19.7392082214f));
  c = hn::Add(hn::Mul(g, c), hn::Set(df, 1.0f));
  // Quadrants 1 and 3 swap the two; the sine is negative in 2 and 3, the cosine in 1 and 2.
  const auto one = hn::Set(du, 1u);
  const auto swap =
      hn::MaskFromVec(hn::BitCast(df, hn::Neg(hn::BitCast(di, hn::And(quadrant, one)))));
  const auto sine_sign = hn::ShiftLeft<30>(hn::And(quadrant, hn::Set(du, 2u)));
  const auto cosine_sign = hn::ShiftLeft<30>(hn::And(hn::Add(quadrant, one), hn::Set(du, 2u)));
  sine = hn::Xor(hn::IfThenElse(swap, c, s), hn::BitCast(df, sine_sign));
  cosine = hn::Xor(hn::IfThenElse(swap, s, c), hn::BitCast(df, cosine_sign));
}

}  // namespace HWY_NAMESPACE
}  // namespace onesea::sea
HWY_AFTER_NAMESPACE();

#endif
