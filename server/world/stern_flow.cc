#include "server/world/stern_flow.h"

#include <algorithm>

namespace onesea::world {
namespace {

constexpr double kEndShare = 0.05;     // of the length, that counts as the stern
constexpr double kAsternCosine = 0.8;  // of the angle between a face of the stern and astern

}  // namespace

Stern SternOf(const TriangleMesh& mesh, const SolidProperties& solid, Vec3d centre_of_mass_m) {
  const double length_m = solid.high_m.x - solid.low_m.x;
  const double end_m = solid.low_m.x + kEndShare * length_m;
  double area_m2 = 0.0;  // seen from astern
  for (const auto& triangle : mesh.triangles) {
    const Vec3d a = mesh.vertices[triangle[0]], b = mesh.vertices[triangle[1]],
                c = mesh.vertices[triangle[2]];
    const Vec3d normal = 0.5 * Cross(b - a, c - a);
    if (-normal.x < kAsternCosine * Norm(normal)) continue;
    if (std::max({a.x, b.x, c.x}) > end_m) continue;
    area_m2 -= normal.x;
  }
  return {.x_m = solid.low_m.x - centre_of_mass_m.x, .share = area_m2 * length_m / solid.volume_m3};
}

Mat6 SternDamping(const Stern& stern, double length_m, const Mat6& added_mass,
                  double ahead_m_per_s) {
  Mat6 out{};
  if (!(ahead_m_per_s > 0.0) || !(stern.share > 0.0)) return out;
  const double per_kg = stern.share * ahead_m_per_s / length_m;
  const double sway = per_kg * added_mass[1][1], heave = per_kg * added_mass[2][2];
  const double x = stern.x_m;
  // The stern's own velocity: v + x r to port, w - x q upwards.
  out[1][1] = sway;
  out[1][5] = out[5][1] = sway * x;
  out[5][5] = sway * x * x;
  out[2][2] = heave;
  out[2][4] = out[4][2] = -heave * x;
  out[4][4] = heave * x * x;
  return out;
}

}  // namespace onesea::world
