#pragma once

#include <array>
#include <cmath>

#include "common/base/quaternion.h"
#include "common/base/real_math.h"
#include "common/base/vec.h"

/// Rotations, poses and the small matrices of rigid bodies. Plain doubles in a fixed order of
/// operations; sine and cosine come from real_math, so the bits don't depend on the machine's libm.
namespace onesea::world {

inline bool IsFinite(Vec3d v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Row-major 3 x 3.
struct Mat3d {
  std::array<double, 9> m{};

  double& operator()(int row, int column) { return m[3 * row + column]; }
  double operator()(int row, int column) const { return m[3 * row + column]; }
  friend Vec3d operator*(const Mat3d& a, Vec3d v) {
    return {a.m[0] * v.x + a.m[1] * v.y + a.m[2] * v.z, a.m[3] * v.x + a.m[4] * v.y + a.m[5] * v.z,
            a.m[6] * v.x + a.m[7] * v.y + a.m[8] * v.z};
  }
  friend Mat3d operator*(const Mat3d& a, const Mat3d& b) {
    Mat3d out;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        for (int k = 0; k < 3; ++k) out(i, j) += a(i, k) * b(k, j);
      }
    }
    return out;
  }
  /// Transpose times vector: world to body where the matrix is body to world.
  Vec3d TransposeTimes(Vec3d v) const {
    return {m[0] * v.x + m[3] * v.y + m[6] * v.z, m[1] * v.x + m[4] * v.y + m[7] * v.z,
            m[2] * v.x + m[5] * v.y + m[8] * v.z};
  }
  friend bool operator==(const Mat3d&, const Mat3d&) = default;
};

inline Mat3d ToMatrix(const Quaternion& q) {
  return {
      {1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y - q.w * q.z), 2 * (q.x * q.z + q.w * q.y),
       2 * (q.x * q.y + q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z - q.w * q.x),
       2 * (q.x * q.z - q.w * q.y), 2 * (q.y * q.z + q.w * q.x), 1 - 2 * (q.x * q.x + q.y * q.y)}};
}
/// Rotation by `angle_rad` about the unit vector `axis`, counter-clockwise seen from its tip.
inline Quaternion AboutAxis(Vec3d axis, double angle_rad) {
  const real::SinCosPair half = real::SinCos(0.5 * angle_rad);
  return {half.cos, half.sin * axis.x, half.sin * axis.y, half.sin * axis.z};
}

/// Where a body is: its centre of mass and its turn.
struct Pose {
  Vec3d centre_m;   ///< centre of mass, world
  Quaternion turn;  ///< body to world
  friend bool operator==(const Pose&, const Pose&) = default;
};

/// Linear part first: surge, sway, heave, roll, pitch, yaw, along and about the body's own axes.
using Vec6 = std::array<double, 6>;
using Mat6 = std::array<Vec6, 6>;  ///< rows

inline Vec6 Join(Vec3d linear, Vec3d angular) {
  return {linear.x, linear.y, linear.z, angular.x, angular.y, angular.z};
}
inline Vec3d Linear(const Vec6& v) { return {v[0], v[1], v[2]}; }
inline Vec3d Angular(const Vec6& v) { return {v[3], v[4], v[5]}; }
inline Vec6 operator*(const Mat6& a, const Vec6& v) {
  Vec6 out{};
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) out[i] += a[i][j] * v[j];
  }
  return out;
}
inline Vec6 operator+(Vec6 a, const Vec6& b) {
  for (int i = 0; i < 6; ++i) a[i] += b[i];
  return a;
}
inline Vec6 operator-(Vec6 a, const Vec6& b) {
  for (int i = 0; i < 6; ++i) a[i] -= b[i];
  return a;
}
inline Vec6 operator*(double s, Vec6 a) {
  for (double& value : a) value *= s;
  return a;
}
inline void AddTo(Mat6& sum, double s, const Mat6& a) {
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) sum[i][j] += s * a[i][j];
  }
}
inline double Dot(const Vec6& a, const Vec6& b) {
  double sum = 0.0;
  for (int i = 0; i < 6; ++i) sum += a[i] * b[i];
  return sum;
}

/// A matrix taken apart once for several right sides: elimination with row pivots.
class Elimination {
 public:
  explicit Elimination(const Mat6& matrix) : a_(matrix) {
    for (int column = 0; column < 6; ++column) {
      int pivot = column;
      for (int row = column + 1; row < 6; ++row) {
        if (std::abs(a_[row][column]) > std::abs(a_[pivot][column])) pivot = row;
      }
      if (!(std::abs(a_[pivot][column]) > 0.0)) return;
      std::swap(a_[pivot], a_[column]);
      pivot_[column] = pivot;
      for (int row = column + 1; row < 6; ++row) {
        const double factor = a_[row][column] / a_[column][column];
        for (int k = column + 1; k < 6; ++k) a_[row][k] -= factor * a_[column][k];
        a_[row][column] = factor;
      }
    }
    good_ = true;
  }
  /// `b` becomes x of a x = b. False where `a` is singular or x not finite; then `b` is undefined.
  bool Solve(Vec6& b) const {
    if (!good_) return false;
    for (int column = 0; column < 6; ++column) std::swap(b[pivot_[column]], b[column]);
    for (int column = 0; column < 6; ++column) {
      for (int row = column + 1; row < 6; ++row) b[row] -= a_[row][column] * b[column];
    }
    for (int row = 5; row >= 0; --row) {
      for (int k = row + 1; k < 6; ++k) b[row] -= a_[row][k] * b[k];
      b[row] /= a_[row][row];
      if (!std::isfinite(b[row])) return false;
    }
    return true;
  }

 private:
  Mat6 a_;  // factors below the diagonal
  std::array<int, 6> pivot_{};
  bool good_ = false;
};

inline bool SolveInPlace(const Mat6& a, Vec6& b) { return Elimination(a).Solve(b); }

}  // namespace onesea::world
