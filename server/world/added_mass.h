#pragma once

#include "server/world/hydrostatics.h"
#include "server/world/rigid_math.h"

/// Added mass from shape: the water that must move when a body does.
namespace onesea::world {

/// Of an ellipsoid in unbounded fluid, per kilogram of displaced water.
struct EllipsoidAddedMass {
  Vec3d along;     ///< [-] along the axes; a sphere has 1/2
  Vec3d about_m2;  ///< about the axes; a sphere has 0
};
/// Exact. Pre: semi-axes > 0. Allocates nothing.
/// Source: H. Lamb, Hydrodynamics, 6th ed., articles 114 and 115; the integrals as Carlson's R_D.
EllipsoidAddedMass OfEllipsoid(Vec3d semi_axes_m);

/// 6 x 6 about the centre of mass [kg, kg m, kg m²] of a hull at rest: the ellipsoid that fits the
/// box around its wetted part, mirrored at the surface, with the hull's own displacement.
/// Good for round hulls (sphere: exact at high frequency); a box's true heave and sway are some
/// 20-50 % higher. No dependence on frequency. Give the body its own matrix where that matters.
Mat6 EstimateAddedMass(const Hydrostatics& rest, double density_kg_per_m3);
/// The same of the whole hull deep under water.
Mat6 EstimateSubmergedAddedMass(const SolidProperties& solid, Vec3d centre_of_mass_m,
                                double density_kg_per_m3);

}  // namespace onesea::world
