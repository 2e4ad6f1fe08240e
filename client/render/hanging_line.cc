#include "client/render/hanging_line.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "common/base/check.h"

namespace onesea::render {
namespace {

// sinh(u) / u = ratio > 1, by Newton from a start above the root, from where it descends without
// overshooting.
double SolveSinhRatio(double ratio) {
  // sinh(u)/u > 1 + u²/6, and u < 2 ln(2 ratio) + 1 where it is large.
  double u = std::min(std::sqrt(6.0 * (ratio - 1.0)), 2.0 * std::log(2.0 * ratio) + 1.0);
  for (int n = 0; n < 20; ++n) {
    const double slope = std::cosh(u) - ratio;
    if (!(slope > 0.0)) break;
    u -= (std::sinh(u) - ratio * u) / slope;
  }
  return u;
}

}  // namespace

void HangingLine(Vec3d from_m, Vec3d to_m, double length_m, std::span<Vec3d> points) {
  ONESEA_CHECK(points.size() >= 2);
  const Vec3d way = to_m - from_m;
  const double last = static_cast<double>(points.size() - 1);
  const double slack = length_m * length_m - way.z * way.z;
  // The line is never quite upright: steeper ones are drawn out of one a thousandth as wide.
  const double across = std::max(std::hypot(way.x, way.y), 1e-3 * length_m);
  const double ratio = std::sqrt(std::max(slack, 0.0)) / across;
  for (std::size_t n = 0; n < points.size(); ++n) {
    points[n] = from_m + (static_cast<double>(n) / last) * way;
  }
  if (!(ratio > 1.0 + 1e-9)) return;
  const double u = SolveSinhRatio(ratio), a = across / (2.0 * u);
  const double lowest = 0.5 * across - a * std::asinh(way.z / (2.0 * a * std::sinh(u)));
  const double start = -a * std::sinh(lowest / a);  // length along the line from its lowest point
  for (std::size_t n = 1; n + 1 < points.size(); ++n) {
    const double along = start + static_cast<double>(n) / last * length_m;
    const double x = lowest + a * std::asinh(along / a);
    const double share = x / across;
    points[n] = {from_m.x + share * way.x, from_m.y + share * way.y,
                 from_m.z + std::hypot(a, along) - a * std::cosh(lowest / a)};
  }
}

}  // namespace onesea::render
