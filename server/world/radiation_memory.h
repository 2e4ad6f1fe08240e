#pragma once

#include <span>
#include <vector>

#include "absl/status/status.h"

/// Waves made earlier still push: Cummins' convolution for one degree of freedom.
///
///   F(t) = - ∫ K(s) v(t - s) ds,  K(s) = (2/π) ∫ B(ω) cos ωs dω
///
/// with the added mass of infinite frequency in the matrix. A constant damping gives the right mean
/// decay but the wrong first swing after a release.
/// Source: W. E. Cummins, The impulse response function and ship motions, 1962.
namespace onesea::world {

struct RadiationKernel {
  double step_s = 0.0;
  std::vector<double> kernel;  ///< K at 0, step, 2 step ... [kg/s²]; empty: no memory

  /// Convolution with the newest velocity first, without the part of the step that begins now.
  double Force(std::span<const double> history_m_per_s) const;
  /// That part as a damping: trapezoid's half step at s = 0.
  double Damping() const { return kernel.empty() ? 0.0 : 0.5 * step_s * kernel[0]; }
  friend bool operator==(const RadiationKernel&, const RadiationKernel&) = default;
};

/// From damping at ascending frequencies; beyond the last it falls as its trend (ω⁻³) says.
/// InvalidArgument if the table is not ascending, negative or not finite, or the kernel too long
/// (4096 steps).
absl::Status MakeRadiationKernel(std::span<const double> omega_rad_per_s,
                                 std::span<const double> damping_kg_per_s, double step_s,
                                 double length_s, RadiationKernel& kernel);

}  // namespace onesea::world
