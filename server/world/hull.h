#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "common/base/triangle_mesh.h"
#include "common/base/vec.h"
#include "server/world/rigid_math.h"

/// Hulls: closed triangle meshes in the body frame (x forward, y left, z up, origin anywhere).
namespace onesea::world {

/// A uniform solid inside a closed mesh.
struct SolidProperties {
  double volume_m3 = 0.0;
  Vec3d centroid_m;
  /// Inertia about the centroid of a body of 1 kg: times the mass gives kg m².
  Mat3d inertia_per_kg;
  double area_m2 = 0.0;
  Vec3d low_m, high_m;  ///< corners of the bounding box
};

/// Exact for the polyhedron, by the divergence theorem. Cost: O(triangles). Pre: closed, volume
/// not 0 (else centroid and inertia are not finite).
/// Source: B. Mirtich, "Fast and accurate computation of polyhedral mass properties", J. Graphics
///   Tools 1(2), 1996, here by the canonical tetrahedra from the origin to each triangle.
SolidProperties ComputeSolid(const TriangleMesh& mesh);

/// OK, or InvalidArgument saying what is wrong: no triangles, too many (kHullTrianglesMax), an
/// index without a vertex, coordinates that are not finite or too large (kHullSizeMaxM), open
/// edges, neighbours of opposite sense, faces pointing inwards, no volume. Self-intersections are
/// not looked for: the displaced volume then counts the overlap twice.
absl::Status ValidateMesh(const TriangleMesh& mesh);

}  // namespace onesea::world
