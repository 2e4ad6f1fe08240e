#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/sea/aligned.h"
#include "server/world/rigid_math.h"
#include "server/world/water_patch.h"

/// The vectorised inside of WetHull::Evaluate(). The same bits on every SIMD target.
namespace onesea::world {

/// Triangles are summed in blocks: lane n of eight sums takes triangles n, n + 8, n + 16, ...
inline constexpr std::size_t kWetBlock = 8;
constexpr std::size_t WholeBlocks(std::size_t n) {
  return (n + kWetBlock - 1) / kWetBlock * kWetBlock;
}

/// A hull about its centre of mass, each array padded to whole blocks (empty triangles).
struct WetMesh {
  std::size_t vertices = 0, triangles = 0;  ///< padded
  sea::AlignedArray<double> x, y, z;
  std::array<sea::AlignedArray<std::int64_t>, 3> corner;
  /// Their places once more, in the order of the triangles: loads are cheaper than gathers.
  std::array<sea::AlignedArray<double>, 3> corner_x, corner_y, corner_z;
  sea::AlignedArray<double> normal_x, normal_y, normal_z, area;
};

/// The waves of a patch in a few depths, all bands together: what costs much is done once for each
/// sample of the patch and not for each vertex of the hull. Between two depths, in which the waves
/// are exact, they are linear. Depths grow as squares from 0 to the hull's lowest vertex, since
/// short waves fade near the surface: of a band of wavenumber k at most 0.4 % is added where the
/// hull is 1/k deep, 1.1 % where it is 3/k and 3.6 % where it is 10/k deep.
struct WaterProfile {
  static constexpr int kDepths = 8;
  static constexpr int kRecord = 4 * kDepths;  ///< head felt and velocity x, y, z for each depth
  sea::FloatArray height_m;                    ///< (samples) above the mean level
  sea::FloatArray record;                      ///< (samples x kDepths x 4)
  std::size_t capacity = 0;                    ///< in samples

  void Reserve(std::size_t samples);
};

/// What the water does at every vertex; relative velocity of the water to the hull in body axes.
struct WetVertices {
  std::size_t capacity = 0;
  sea::AlignedArray<double> depth, head, rx, ry, rz;
  sea::AlignedArray<double> above, column, row;  ///< place: above z = 0, and in cells of the patch
  WaterProfile profile;
  std::size_t crossings = 0, triangle_capacity = 0;
  sea::AlignedArray<std::int64_t> crossing;  ///< triangles that cross the surface

  void Reserve(const WetMesh& mesh);
};

struct WetMotion {
  Vec3d centre_m;
  Mat3d turn;                              ///< body to world
  Vec3d velocity_m_per_s, spin_rad_per_s;  ///< body axes
  double edge_max_m;                       ///< of the mesh's triangles
};

/// Depth, head and relative velocity of every vertex: as SampleWater, but for what WaterProfile
/// says. Vertices that have no wet neighbour are given as dry, without their depth.
void SampleVertices(const WetMesh& mesh, const WetMotion& motion, const WaterSampler& water,
                    WetVertices& out);

/// Sums over wetted triangles; pressure per rho g, drag per rho/2.
enum WetSum {
  kPressureForce = 0,   // 3
  kPressureTorque = 3,  // 3
  kDragForce = 6,       // 3
  kDragTorque = 9,      // 3
  kVolumeMoment = 12,   // 3
  kAreaMoment = 15,     // 3
  kAreaRelative = 18,   // 3
  kVolume = 21,
  kRaise = 22,
  kArea = 23,
  kWetSums = 24,
};

struct WetCoefficients {
  Vec3d up;  ///< body axes
  double friction, pressure, suction, planing;
};

/// Sums over the wetted part of every triangle. Returns how many are wetted.
int SumWetted(const WetMesh& mesh, const WetCoefficients& coefficients, WetVertices& vertices,
              std::array<double, kWetSums>& sums);

}  // namespace onesea::world
