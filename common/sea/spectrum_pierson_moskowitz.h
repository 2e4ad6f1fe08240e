#pragma once

#include <memory>

#include "common/sea/spectrum_jonswap.h"

namespace onesea::sea {

/// Pierson & Moskowitz 1964, the fully developed sea:
///
///   S(ω) = α g² ω⁻⁵ exp(-β (g/(U ω))⁴),   α = 0.0081, β = 0.74, U [m/s] at 19.5 m
///
/// It is JONSWAP's shape with γ = 1 and ω_p = (4β/5)^(1/4) g/U.
/// Exact: Hs = 2 √(α/β) U²/g; U = 15 m/s gives 4.799 m and Tp 10.953 s.
JonswapShape PiersonMoskowitzShape(const PiersonMoskowitzSystem& system);

std::unique_ptr<const WaveSpectrum> MakePiersonMoskowitzSpectrum(
    const PiersonMoskowitzSystem& system, double depth_m);

}  // namespace onesea::sea
