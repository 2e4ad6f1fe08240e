#pragma once

#include "server/world/wet_hull.h"

/// How a body floats upright in calm water.
namespace onesea::world {

struct Hydrostatics {
  bool floats = false;            ///< false: it sinks; then the figures are those of the whole hull
  double centre_height_m = 0.0;   ///< of the centre of mass above the water, at rest
  double volume_m3 = 0.0;         ///< displaced at rest
  Vec3d buoyancy_centre_m;        ///< from the centre of mass
  Vec3d wet_low_m, wet_high_m;    ///< bounding box of the part under water, from the centre of mass
  double heave_n_per_m = 0.0;     ///< stiffness: rho g times the waterplane's area
  double roll_n_m_per_rad = 0.0;  ///< rho g V GM, about the centre of mass; negative: capsizes
  double pitch_n_m_per_rad = 0.0;
};

/// Level: trim and heel are not solved for, so `centre_height_m` is where the *upright* body has
/// its displacement. Error of the height: 1e-12 of the hull's radius. Cost: 70 evaluations.
Hydrostatics FloatUpright(const WetHull& hull, double mass_kg, double density_kg_per_m3);

}  // namespace onesea::world
