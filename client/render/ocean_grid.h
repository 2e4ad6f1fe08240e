#pragma once

#include "client/render/render_frame.h"

namespace onesea::render {

/// The part of a camera-centred log-polar lattice that a camera sees.
///
/// Why polar and not screen-space: the lattice turns with nothing. Its azimuths and log radii are
/// multiples of fixed steps, so when the camera turns or tilts the vertices stay where they are and
/// the waves do not swim. Spacing grows with distance as the pixel does; the last row lies beyond
/// the horizon of a round Earth.
struct OceanGrid {
  int columns = 0, rows = 0;  ///< vertices
  double first_azimuth_rad = 0.0, azimuth_step_rad = 0.0;
  double first_log_radius = 0.0,
         log_radius_step = 0.0;  ///< radius of row j is exp(first + j step) [m]
  bool has_nadir = false;        ///< row 0 is drawn at radius 0
};

inline constexpr double kEarthRadiusM = 6'371'000.0;

/// Distance at which the sea's horizon lies for an eye `height_m` above it; at least 500 m.
double HorizonDistanceM(double height_m);

/// `displacement_max_m`: how far a vertex may move in any direction.
OceanGrid FitOceanGrid(const Camera& camera, int width, int height, double pixels_per_column,
                       double displacement_max_m);

}  // namespace onesea::render
