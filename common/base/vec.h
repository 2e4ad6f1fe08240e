#pragma once

#include <cmath>

namespace onesea {

/// World frame everywhere: ENU, right-handed; x east, y north, z up [m]; z = 0 is the mean water
/// level.
struct Vec2d {
  double x = 0.0;
  double y = 0.0;

  friend Vec2d operator+(Vec2d a, Vec2d b) { return {a.x + b.x, a.y + b.y}; }
  friend Vec2d operator-(Vec2d a, Vec2d b) { return {a.x - b.x, a.y - b.y}; }
  friend Vec2d operator*(double s, Vec2d a) { return {s * a.x, s * a.y}; }
  friend bool operator==(Vec2d a, Vec2d b) = default;
};

struct Vec3d {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  friend Vec3d operator+(Vec3d a, Vec3d b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3d operator-(Vec3d a, Vec3d b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3d operator*(double s, Vec3d a) { return {s * a.x, s * a.y, s * a.z}; }
  friend bool operator==(Vec3d a, Vec3d b) = default;
};

inline double Dot(Vec2d a, Vec2d b) { return a.x * b.x + a.y * b.y; }
inline double Dot(Vec3d a, Vec3d b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3d Cross(Vec3d a, Vec3d b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double Norm(Vec2d a) { return std::sqrt(Dot(a, a)); }
inline double Norm(Vec3d a) { return std::sqrt(Dot(a, a)); }

}  // namespace onesea
