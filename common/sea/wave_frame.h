#pragma once

#include <vector>

#include "common/base/vec.h"
#include "common/sea/components.h"

namespace onesea::sea {

/// A cascade's lattice: world axes turned by the rotation, in tile lengths. Same bits on every
/// machine.
struct CascadeFrame {
  explicit CascadeFrame(const Cascade& cascade);

  double cosine = 1.0;
  double sine = 0.0;
  double length_m = 1.0;

  /// Local coordinates in [0, 1] of the tile (1: just below a whole tile, as rounded), to 1e-8 m at
  /// 10⁷ m.
  Vec2d TileFraction(Vec2d world) const;
  /// Wave vector of lattice point (i, j) [rad/m], more exact than the float in CascadeComponents.
  Vec2d WaveVector(int i, int j) const;
};

/// A regular wave at one time.
struct RegularAt {
  double kx_rad_per_m = 0.0, ky_rad_per_m = 0.0;
  double amplitude_m = 0.0;
  double phase_turns = 0.0;  ///< at the origin, in [0, 1)
  double sigma_rad_per_s = 0.0;

  /// k·x/2π + phase, reduced to [-1/2, 1/2] turn.
  double TurnsAt(Vec2d world) const;
};

/// Amplitude and phase of every regular wave at `time`, for mixing weights `weights`.
void RegularWavesAt(const Components& components, SimTime time, const std::vector<double>& weights,
                    std::vector<RegularAt>& out);

/// coth(kh) and friends need e^{-2kh}; 0 in infinite depth (depth_m <= 0).
double DepthDecay(double k_rad_per_m, double depth_m);

}  // namespace onesea::sea
