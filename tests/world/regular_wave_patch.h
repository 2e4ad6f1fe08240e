#pragma once

#include <cmath>

#include "common/sea/constants.h"
#include "server/world/water_patch.h"

namespace onesea::world {

/// Airy wave along `to_rad`, height a cos(k·x - wt), as one band of a patch.
struct RegularWave {
  double amplitude_m = 1.0;
  double wavenumber_rad_per_m = 0.1;
  double to_rad = 0.0;
  double depth_m = std::numeric_limits<double>::infinity();

  double Omega() const {
    const double kh = wavenumber_rad_per_m * depth_m;
    return std::sqrt(sea::kGravity * wavenumber_rad_per_m * (kh > 50 ? 1.0 : std::tanh(kh)));
  }
  /// Adds to band `band` of a patch already placed and sized, and sets its wavenumber.
  void Fill(double time_s, WaterPatch& patch, int band) const {
    const double kh = wavenumber_rad_per_m * depth_m;
    const double coth = kh > 50 ? 1.0 : 1.0 / std::tanh(kh), w = Omega();
    patch.wavenumber_rad_per_m[band] = wavenumber_rad_per_m;
    for (int row = 0; row < patch.rows; ++row) {
      for (int column = 0; column < patch.columns; ++column) {
        const auto [x, y] = patch.PlaceOf(column, row);
        const double phase =
            wavenumber_rad_per_m * (std::cos(to_rad) * x + std::sin(to_rad) * y) - w * time_s;
        float* at = patch.At(column, row) + 4 * band;
        at[0] = static_cast<float>(amplitude_m * std::cos(phase));
        const double along = amplitude_m * w * coth * std::cos(phase);
        at[1] = static_cast<float>(along * std::cos(to_rad));
        at[2] = static_cast<float>(along * std::sin(to_rad));
        at[3] = static_cast<float>(amplitude_m * w * std::sin(phase));
      }
    }
  }
};

/// A square patch about (x, y), `half_m` to each side, of one wave.
inline void PatchAround(Vec3d centre, double half_m, int samples, const RegularWave& wave,
                        double time_s, WaterPatch& patch) {
  patch.cell_m = 2.0 * half_m / (samples - 1);
  patch.corner_m = {centre.x - half_m, centre.y - half_m};
  patch.depth_m = wave.depth_m;
  patch.Resize(samples, samples, 1);
  wave.Fill(time_s, patch, 0);
}

}  // namespace onesea::world
