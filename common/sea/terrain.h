#pragma once

#include <cstdint>
#include <vector>

#include "absl/status/status.h"
#include "common/base/vec.h"

/// The bottom and the land: one grid of elevations in the world frame.
namespace onesea::sea {

struct Terrain {
  double west_m = 0.0;   ///< x of the first column of samples
  double south_m = 0.0;  ///< y of the first row
  double cell_m = 10.0;  ///< distance of samples, both ways
  int columns = 0;
  int rows = 0;
  std::vector<float> elevation_m;  ///< (rows x columns) row-major from the south-west; up, 0 = mean
                                   ///< water level, negative under water

  /// Bilinear; outside, the value of the nearest edge. Pre: valid.
  double ElevationAt(Vec2d place) const;
  /// Does water of this height above the mean leave the place uncovered?
  bool IsDry(Vec2d place, double water_height_m) const {
    return ElevationAt(place) >= water_height_m;
  }
};

/// OK, or InvalidArgument naming field, value and limit.
absl::Status ValidateTerrain(const Terrain& terrain);

/// Over every field, for "do you have this one already?".
std::uint64_t TerrainHash(const Terrain& terrain);

}  // namespace onesea::sea
