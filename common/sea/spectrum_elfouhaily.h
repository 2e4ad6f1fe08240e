#pragma once

#include <memory>

#include "common/sea/wave_spectrum.h"

namespace onesea::sea {

/// The unified spectrum of Elfouhaily, Chapron, Katsaros, Vandemark 1997 (ECKV), in wavenumber:
///
///   F(k) = (B_l + B_h) / k³
///   B_l  = α_p/2 · c_p/c · L J exp(-Ω/√10 (√(k/k_p) - 1)),   α_p = 0.006 √Ω
///   B_h  = α_m/2 · c_m/c · L J exp(-(k/k_m - 1)²/4),   α_m = 0.01 (1 + {1 or 3} ln(u*/c_m))
///   L    = exp(-5/4 (k_p/k)²),   J = γ^exp(-(√(k/k_p) - 1)²/(2 s²))
///   Δ    = tanh(ln2/4 + 4 (c/c_p)^2.5 + 0.13 u*/c_m (c_m/c)^2.5)
///
///   symbol  unit   meaning
///   Ω       -      inverse wave age U10/c_p, [0.84, 5]
///   k_p     rad/m  g Ω²/U10²
///   c       m/s    √(g/k (1 + (k/k_m)²)), c_p at k_p, c_m = 0.23 at k_m = 370 rad/m
///   u*      m/s    friction velocity, U10 √0.00144
///   γ, s    -      1.7 (+ 6 log10 Ω above 1), 0.08 (1 + 4/Ω³)
///   3 ln    -      where u* > c_m
///
/// The paper's spectrum (1 + Δ cos 2Δθ)/2π is that of a still image, the same for k⃗ and -k⃗. Waves
/// that travel need one side: here it holds all of the energy, (1 + Δ cos 2Δθ)/π within 90° of the
/// wind, which gives the same image, the same Hs and the same slopes along and across.
///
/// Check: Ω 0.84, U10 10 m/s: Hs 2.633 m, mean square slope 0.0603 (up 0.0355, cross 0.0248).
std::unique_ptr<const WaveSpectrum> MakeElfouhailySpectrum(const ElfouhailySystem& system);

}  // namespace onesea::sea
