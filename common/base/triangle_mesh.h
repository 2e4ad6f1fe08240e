#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/base/vec.h"

namespace onesea {

struct TriangleMesh {
  std::vector<Vec3d> vertices;  ///< [m]
  /// Corners counter-clockwise seen from outside.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  friend bool operator==(const TriangleMesh&, const TriangleMesh&) = default;
};

/// Joins vertices of equal coordinates and drops triangles that lose a corner by it: STL files
/// repeat every vertex. Meshes with coordinates that are not finite stay as they are.
void Weld(TriangleMesh& mesh);

}  // namespace onesea
