#pragma once

#include <cmath>

#include "common/base/real_math.h"
#include "common/base/vec.h"

namespace onesea {

/// Unit quaternion of a turn, body to world. q and -q are the same turn.
struct Quaternion {
  double w = 1.0, x = 0.0, y = 0.0, z = 0.0;
  friend bool operator==(const Quaternion&, const Quaternion&) = default;

  /// First b, then a.
  friend Quaternion operator*(const Quaternion& a, const Quaternion& b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
            a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
  }
};

inline double Dot(const Quaternion& a, const Quaternion& b) {
  return a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Identity where the norm is zero or not finite.
inline Quaternion Normalised(const Quaternion& q) {
  const double norm = std::sqrt(Dot(q, q));
  if (!(norm > 1e-12) || !std::isfinite(norm)) return {};
  return {q.w / norm, q.x / norm, q.y / norm, q.z / norm};
}

/// Turn by |v| radians about v, counter-clockwise seen from its tip.
inline Quaternion TurnBy(Vec3d v) {
  const double angle_rad = Norm(v);
  if (!(angle_rad > 1e-12)) return {};
  const real::SinCosPair half = real::SinCos(0.5 * angle_rad);
  const double scale = half.sin / angle_rad;
  return {half.cos, scale * v.x, scale * v.y, scale * v.z};
}

/// The same turn the other way round.
inline Quaternion Inverse(const Quaternion& q) { return {q.w, -q.x, -q.y, -q.z}; }

inline Vec3d Rotate(const Quaternion& q, Vec3d v) {
  const Quaternion turned = q * Quaternion{0.0, v.x, v.y, v.z} * Inverse(q);
  return {turned.x, turned.y, turned.z};
}

/// Angle of the turn from a to b [rad], [0, π]; good to 1e-8.
inline double AngleBetween(const Quaternion& a, const Quaternion& b) {
  const Quaternion between = b * Inverse(a);
  const double sine = Norm(Vec3d{between.x, between.y, between.z});
  return 2.0 * std::atan2(sine, std::fabs(between.w));
}

}  // namespace onesea
