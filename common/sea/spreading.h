#pragma once

#include "common/sea/sea_state.h"

/// How the energy at one frequency spreads over direction: D(Δ) [1/rad], ∫D dΔ = 1 over a turn.
///
///   cos2s            D = Q cos^2s(Δ/2),   Q = Γ(s+1) / (2 √π Γ(s+1/2))
///     Mitsuyasu      s = 11.5 a^-2.5 x^5 (x <= 1), 11.5 a^-2.5 x^-2.5 above
///     Hasselmann     s = 6.97 x^4.06 (x <= 1.05), 9.77 x^(-2.33 - 1.45 (a - 1.17)) above
///   Donelan–Banner   D = β sech²(βΔ) / (2 tanh βπ), β = 2.61 x^1.3 (x < 0.95), 2.28 x^-1.3 (x <
///   1.6),
///                    10^(-0.4 + 0.8393 exp(-0.567 ln x²)) above; x below 0.56 as at 0.56
///   swell            cos^2s(Δ/2) with s_ξ = 16 tanh(1/x) ξ² multiplies D; for cos2s that adds to s
///
///   symbol  unit  meaning
///   x       -     ω/ω_p
///   a       -     inverse wave age U10/c_p = U10 ω_p/g
///   ξ       -     Spreading::swell
///
/// Source: Longuet-Higgins et al. 1963; Mitsuyasu et al. 1975; Hasselmann et al. 1980; Donelan et
/// al. 1985 with Banner 1990; Horvath 2015. Bits: the same on every machine.
namespace onesea::sea {

/// Γ(s+1)/Γ(s+1/2) for s >= 0, relative error below 1e-13: upward recurrence, then the asymptotic
/// series of the ratio (no gamma function).
double GammaHalfRatio(double s);

/// The spreading model with what it needs to know of the spectrum.
struct SpreadingModel {
  Spreading spreading;
  double omega_p_rad_per_s = 1.0;  ///< > 0
  double inverse_wave_age = 0.84;  ///< a, > 0

  /// The distribution at one frequency, ready for interpolation between frequencies.
  struct Shape {
    double width = 0.0;       ///< s, or β for Donelan–Banner
    double swell = 0.0;       ///< s_ξ, Donelan–Banner only
    double normaliser = 0.0;  ///< D at Δ = 0
  };
  /// Cost: about 200 ns; Donelan–Banner with swell 5 µs (its normaliser is a quadrature). Pre: ω >
  /// 0.
  Shape At(double omega_rad_per_s) const;

  /// D [1/rad]; `cos_delta` in [-1, 1] up to rounding.
  double Density(const Shape& shape, double cos_delta) const;
};

/// s(x) without swell. Pre: kind is kMitsuyasu or kHasselmann, x > 0.
double SpreadingExponent(SpreadingKind kind, double x, double inverse_wave_age);
/// β(x). Pre: x > 0.
double DonelanBannerBeta(double x);

}  // namespace onesea::sea
