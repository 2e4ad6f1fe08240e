#pragma once

#include <memory>

#include "common/sea/wave_spectrum.h"

namespace onesea::sea {

/// Tessendorf's form of Phillips' spectrum:
///
///   P(k⃗) = A exp(-1/(kL)²) / k⁴ · |k̂·ŵ|^p · exp(-(k l)²),   L = V²/g,   A = α/2π
///
///   symbol  unit      meaning
///   V       m/s       wind speed, ŵ where the wind blows to
///   l       m         waves much shorter are suppressed
///   p       -         directional exponent (2 in the paper)
///   α       -         0.0081 gives the tail α g²/ω⁵ for p = 2
///
/// A is a density scale: a wave's variance is the integral of P over its cell (the paper leaves the
/// cell out). One-sided, nothing travels against the wind, and half of the energy is left out.
/// Exact: l = 0, p = 2, two-sided: ∫ P d²k = π A L²/2; V = 10 m/s gives Hs 1.835 m.
/// Source: Tessendorf 2001, eq. 40 and 41.
std::unique_ptr<const WaveSpectrum> MakePhillipsSpectrum(const PhillipsSystem& system);

}  // namespace onesea::sea
