#include "server/world/added_mass.h"

#include <algorithm>
#include <cmath>

namespace onesea::world {
namespace {

// Carlson's R_D(x, y, z) by duplication: the arguments approach each other fourfold a step.
// Source: B. C. Carlson, Numerical computation of real or complex elliptic integrals, 1995.
double CarlsonD(double x, double y, double z) {
  double sum = 0.0, scale = 1.0;
  for (int n = 0; n < 40; ++n) {
    const double rx = std::sqrt(x), ry = std::sqrt(y), rz = std::sqrt(z);
    const double lambda = rx * ry + ry * rz + rz * rx;
    sum += scale / (rz * (z + lambda));
    scale *= 0.25;
    x = 0.25 * (x + lambda);
    y = 0.25 * (y + lambda);
    z = 0.25 * (z + lambda);
  }
  const double mean = 0.2 * (x + y + 3.0 * z);
  return 3.0 * sum + scale / (mean * std::sqrt(mean));
}

// About the axis across b and c (Lamb 115, divided by the displaced mass).
double About(double b, double c, double beta, double gamma) {
  const double difference = b * b - c * c;
  if (std::abs(difference) < 1e-9 * (b * b + c * c)) return 0.0;
  return 0.2 * difference * difference * (gamma - beta) /
         (2.0 * difference + (b * b + c * c) * (beta - gamma));
}

// From about the ellipsoid's centre, `at_m` from the centre of mass, to the centre of mass:
// the velocity there is v + omega x at.
Mat6 MoveToCentreOfMass(const Vec6& diagonal, Vec3d at_m) {
  const double offset[3][3] = {
      {0, at_m.z, -at_m.y}, {-at_m.z, 0, at_m.x}, {at_m.y, -at_m.x, 0}};  // omega x at
  Mat6 motion{};
  for (int i = 0; i < 6; ++i) motion[i][i] = 1.0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) motion[i][3 + j] = offset[i][j];
  }
  Mat6 out{};
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      for (int k = 0; k < 6; ++k) out[i][j] += motion[k][i] * diagonal[k] * motion[k][j];
    }
  }
  return out;
}

Mat6 Estimate(Vec3d semi_axes_m, double displaced_kg, Vec3d at_m) {
  const EllipsoidAddedMass unit = OfEllipsoid(semi_axes_m);
  Vec6 diagonal = Join(unit.along, unit.about_m2);
  for (double& value : diagonal) value *= displaced_kg;
  return MoveToCentreOfMass(diagonal, at_m);
}

}  // namespace

EllipsoidAddedMass OfEllipsoid(Vec3d semi_axes_m) {
  // Flatter than 1 : 1000 tells nothing new and divides by nearly zero.
  const double least = 1e-3 * std::max({semi_axes_m.x, semi_axes_m.y, semi_axes_m.z});
  const double a = std::max(semi_axes_m.x, least), b = std::max(semi_axes_m.y, least),
               c = std::max(semi_axes_m.z, least);
  const double scale = 2.0 / 3.0 * a * b * c;
  const double alpha = scale * CarlsonD(b * b, c * c, a * a);
  const double beta = scale * CarlsonD(c * c, a * a, b * b);
  const double gamma = scale * CarlsonD(a * a, b * b, c * c);
  return {{alpha / (2.0 - alpha), beta / (2.0 - beta), gamma / (2.0 - gamma)},
          {About(b, c, beta, gamma), About(c, a, gamma, alpha), About(a, b, alpha, beta)}};
}

Mat6 EstimateAddedMass(const Hydrostatics& rest, double density_kg_per_m3) {
  const Vec3d box = rest.wet_high_m - rest.wet_low_m;
  const double below = rest.floats ? box.z : 0.5 * box.z;  // the mirror image completes it
  return Estimate({0.5 * box.x, 0.5 * box.y, below}, density_kg_per_m3 * rest.volume_m3,
                  rest.buoyancy_centre_m);
}

Mat6 EstimateSubmergedAddedMass(const SolidProperties& solid, Vec3d centre_of_mass_m,
                                double density_kg_per_m3) {
  return Estimate(0.5 * (solid.high_m - solid.low_m), density_kg_per_m3 * solid.volume_m3,
                  solid.centroid_m - centre_of_mass_m);
}

}  // namespace onesea::world
