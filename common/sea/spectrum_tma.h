#pragma once

namespace onesea::sea {

/// Kitaigorodskii's depth factor of the TMA spectrum (Bouws et al. 1985), exact form:
///
///   φ = tanh²(kh) / (1 + 2kh / sinh 2kh)   [-] in (0, 1]
///
/// with σ² = g k tanh kh; 1 in infinitely deep water (depth_m = 0).
/// Exact: σ √(h/g) = 1 gives 0.48277 (tests/sea/spectra_test.cc).
double TmaDepthFactor(double k_rad_per_m, double depth_m);

}  // namespace onesea::sea
