#pragma once

#include <cstdint>

/// The dispersion relation of water waves and the exact phase arithmetic built on it.
///
///   σ² = (g k + (γ/ρ) k³) tanh(k h),   ω = σ + k·U
///
///   symbol  unit    meaning
///   σ       rad/s   intrinsic frequency, seen by an observer who drifts with the current
///   ω       rad/s   frequency at a fixed place, negative if the current carries the wave backwards
///   k       rad/m   wavenumber, >= 0
///   h       m       depth; 0 means infinitely deep
///   γ/ρ     m³/s²   kSurfaceTensionOverDensity
///   U       m/s     uniform current
///
/// Bits: the same on every machine (base/real_math.h).
namespace onesea::sea {

/// σ [rad/s] of wavenumber k >= 0.
double IntrinsicFrequency(double k_rad_per_m, double depth_m);

/// dσ/dk [m/s], the speed of energy. Pre: k > 0.
double GroupVelocity(double k_rad_per_m, double depth_m);

/// The wavenumber [rad/m] whose intrinsic frequency is `sigma_rad_per_s` > 0; relative error 1e-14.
/// Newton from the left of the root, at most 60 steps.
double WavenumberOf(double sigma_rad_per_s, double depth_m);

/// `omega_rad_per_s` rounded to the nearest multiple of 2π/loop_period_s; unchanged for 0.
double RoundToLoop(double omega_rad_per_s, double loop_period_s);

/// round(ω/2π · 2⁶⁴ / 705 600 000) in two's complement: 2⁻⁶⁴ turn per flick. The quotient is a
/// double with a relative error below 3·2⁻⁵³, and the rounding to an integer is at most half a
/// unit, 1.9e-11 Hz: this, not ω, is then the wave's frequency, everywhere and for ever.
std::uint64_t TurnsPerFlick(double omega_rad_per_s);

/// The angle as a fraction of a turn in units of 2⁻⁶⁴, wrapped. Pre: |angle| < 1e6.
std::uint64_t TurnsOfAngle(double angle_rad);

}  // namespace onesea::sea
