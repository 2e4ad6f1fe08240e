#pragma once

#include <memory>

#include "common/sea/spreading.h"
#include "common/sea/wave_spectrum.h"

namespace onesea::sea {

/// JONSWAP variance density over frequency:
///
///   S(ω) = α g² ω⁻⁵ exp(-5/4 (ω_p/ω)⁴) γ^r φ,   r = exp(-(ω - ω_p)² / (2 s² ω_p²))
///
///   symbol  unit      meaning                       range
///   ω       rad/s     intrinsic angular frequency   > 0; S(0) = 0 by limit
///   ω_p     rad/s     peak frequency                > 0
///   α       -         energy scale                  > 0 (0.0081: Pierson–Moskowitz)
///   γ       -         peak enhancement              [1, 20] (mean 3.3; 1: Pierson–Moskowitz)
///   s       -         peak width                    0.07 if ω <= ω_p, else 0.09
///   φ       -         TmaDepthFactor(), if asked    (0, 1]
///   S       m²·s/rad  one-sided: m0 = ∫ S dω, Hs = 4 √m0
///
/// Exact: γ = 1 gives m0 = α g² / (5 ω_p⁴); γ = 3.3 gives 1.525 times that.
/// Source: Hasselmann et al. 1973; Bouws et al. 1985 for φ.
struct JonswapShape {
  double alpha = 0.0081;
  double omega_p_rad_per_s = 1.0;
  double gamma = 1.0;
  double tma_depth_m = 0.0;  ///< depth of the TMA factor; 0: none

  /// `k_rad_per_m` is the wavenumber of ω, used by φ alone.
  double Density(double omega_rad_per_s, double k_rad_per_m) const;
  /// ∫ S dω [m²], relative error 1e-6.
  double Variance() const;
};

/// A JONSWAP spectrum with a direction and a spreading. Takes part in MakeWaveSpectrum().
std::unique_ptr<const WaveSpectrum> MakeSpectrum(const JonswapShape& shape,
                                                 const SpreadingModel& spreading,
                                                 double wave_to_rad, double depth_m);

std::unique_ptr<const WaveSpectrum> MakeJonswapSpectrum(const JonswapSystem& system,
                                                        double depth_m);
std::unique_ptr<const WaveSpectrum> MakeFetchJonswapSpectrum(const FetchJonswapSystem& system,
                                                             double depth_m);

/// α and ω_p of JONSWAP's fetch laws; χ = g F/U².
JonswapShape FetchJonswapShape(const FetchJonswapSystem& system);
/// The shape scaled so that 4 √m0 = hs_m.
JonswapShape JonswapShapeOf(const JonswapSystem& system, double depth_m);

/// U10/c_p that JONSWAP's own fetch laws give a sea of this steepness, in [0.84, 5]: eliminating χ
/// from α = 0.076 χ^-0.22 and U10 ω_p/g = 7π χ^-0.33 leaves 7π (α/0.076)^1.5.
double InverseWaveAgeOfAlpha(double alpha);

}  // namespace onesea::sea
