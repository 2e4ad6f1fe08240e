#pragma once

#include <span>

namespace onesea::sea {

/// The directional distribution of greatest entropy with given first two Fourier coefficients:
///
///   D(θ) = (1 - φ1 c1* - φ2 c2*) / (2π |1 - φ1 e^-iθ - φ2 e^-2iθ|²)
///   φ1   = (c1 - c2 c1*) / (1 - |c1|²),   φ2 = c2 - c1 φ1
///   c1   = r1 e^iα1 = ∫ D e^iθ dθ,   c2 = r2 e^2iα2 = ∫ D e^2iθ dθ
///
/// It is never negative, unlike the truncated Fourier sum. It exists where |c1| < 1 and
/// |c2 - c1²| < 1 - |c1|²; measured coefficients miss that by noise, so c1 is shortened to 0.995
/// and c2 drawn towards c1² until the second ratio is 0.98.
/// Exact: its own c1, c2 are the given ones (tests/sea/max_entropy_test.cc).
/// Source: Lygre & Krogstad 1986, eq. 13. Bits: the same on every machine.
struct DirectionalCoefficients {
  double mean_wave_to_rad = 0.0;       ///< α1
  double principal_wave_to_rad = 0.0;  ///< α2, modulo π
  double r1 = 0.0;                     ///< [-] in [0, 1]
  double r2 = 0.0;                     ///< [-] in [0, 1]
};

/// D [1/rad] at θ = 2π n / out.size(); then scaled so that the sum times 2π / out.size() is 1.
void MaxEntropyDistribution(const DirectionalCoefficients& coefficients, std::span<double> out);

}  // namespace onesea::sea
