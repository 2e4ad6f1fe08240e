#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/sea/aligned.h"
#include "server/world/rigid_math.h"
#include "server/world/water_patch.h"

/// The vectorised inside of WetHull::Evaluate().
namespace onesea::world {

/// Triangles are summed in blocks: lane n of eight sums takes triangles n, n + 8, n + 16, ...
inline constexpr std::size_t kWetBlock = 8;

/// A hull about its centre of mass, each array padded to whole blocks (empty triangles).
struct WetMesh {
  std::size_t vertices = 0, triangles = 0;  ///< padded
  sea::AlignedArray<double> x, y, z;
  std::array<sea::AlignedArray<std::int64_t>, 3> corner;
  /// Their places once more, in the order of the triangles: loads are cheaper than gathers.
  std::array<sea::AlignedArray<double>, 3> corner_x, corner_y, corner_z;
  sea::AlignedArray<double> normal_x, normal_y, normal_z, area;
};

/// Wetted parts of triangles that cross the surface: what a mesh and its vertices say of whole
/// ones, corner by corner. Padded with pieces of no area.
struct WetPieces {
  std::size_t count = 0, capacity = 0;
  struct Corner {
    sea::AlignedArray<double> x, y, z, depth, head, rx, ry, rz;
  };
  std::array<Corner, 3> corner;
  sea::AlignedArray<double> normal_x, normal_y, normal_z, area;

  void Reserve(std::size_t pieces);
};

/// What the water does at every vertex; relative velocity of the water to the hull in body axes.
struct WetVertices {
  std::size_t capacity = 0;
  sea::AlignedArray<double> depth, head, rx, ry, rz;
  std::vector<std::uint32_t> clipped;  ///< triangles that cross the surface
  WetPieces pieces;                    ///< of those

  void Reserve(const WetMesh& mesh);
};

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

struct WetMotion {
  Vec3d centre_m;
  Mat3d turn;                              ///< body to world
  Vec3d velocity_m_per_s, spin_rad_per_s;  ///< body axes
  double dry_above_m;                      ///< no vertex higher has a wetted neighbour
};

/// Depth, head and relative velocity of every vertex: the same bits as SampleWater.
void SampleVertices(const WetMesh& mesh, const WetMotion& motion, const WaterSampler& water,
                    WetVertices& out);

struct WetCoefficients {
  Vec3d up;  ///< body axes
  double friction, pressure, suction, planing;
};
/// Sums over triangles that are wholly under water, and lists those that cross the surface. Returns
/// how many are wholly wet. The same bits on every SIMD target.
int SumSubmerged(const WetMesh& mesh, const WetCoefficients& coefficients, WetVertices& vertices,
                 std::array<double, kWetSums>& sums);

/// Adds the sums over pieces.
void SumPieces(const WetPieces& pieces, const WetCoefficients& coefficients,
               std::array<double, kWetSums>& sums);

}  // namespace onesea::world
