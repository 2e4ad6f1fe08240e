#include "server/world/hydrostatics.h"

#include <algorithm>

#include "common/sea/constants.h"

namespace onesea::world {

Hydrostatics FloatUpright(const WetHull& hull, double mass_kg, double density_kg_per_m3) {
  WetScratch scratch;
  const WaterPatch calm;
  const auto at = [&](double height_m, Quaternion turn) {
    return hull.Evaluate({.pose = {{0.0, 0.0, height_m}, turn}}, calm, density_kg_per_m3, {},
                         scratch);
  };
  const double wanted_m3 = mass_kg / density_kg_per_m3;
  const double radius = hull.radius_m();
  Hydrostatics out;
  double deep = -2.0 * radius, high = 2.0 * radius;
  out.floats = wanted_m3 < at(deep, {}).volume_m3;
  if (out.floats) {
    for (int n = 0; n < 60; ++n) {
      const double middle = 0.5 * (deep + high);
      (at(middle, {}).volume_m3 > wanted_m3 ? deep : high) = middle;
    }
  }
  out.centre_height_m = deep;
  const WetForces rest = at(deep, {});
  out.volume_m3 = rest.volume_m3;
  out.buoyancy_centre_m = rest.volume_centre_m;
  hull.Bounds(out.floats ? -deep : radius, out.wet_low_m, out.wet_high_m);
  if (!out.floats) return out;

  const double step_m = 1e-5 * radius;
  out.heave_n_per_m =
      (at(deep - step_m, {}).pressure_force_n.z - at(deep + step_m, {}).pressure_force_n.z) /
      (2.0 * step_m);
  constexpr double kStepRad = 1e-4;
  const auto stiffness = [&](Vec3d axis) {
    return (Dot(at(deep, AboutAxis(axis, -kStepRad)).pressure_torque_n_m, axis) -
            Dot(at(deep, AboutAxis(axis, kStepRad)).pressure_torque_n_m, axis)) /
           (2.0 * kStepRad);
  };
  out.roll_n_m_per_rad = stiffness({1.0, 0.0, 0.0});
  out.pitch_n_m_per_rad = stiffness({0.0, 1.0, 0.0});
  return out;
}

}  // namespace onesea::world
