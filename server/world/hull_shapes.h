#pragma once

#include <array>

#include "server/world/hull.h"

/// Closed meshes of simple bodies, centred at the origin of the body frame. Pre: sizes > 0.
///
/// Round bodies are inscribed polyhedra whose radius is scaled so that the *volume* is that of the
/// true body: drafts come out right at any number of facets.
namespace onesea::world {

/// Rectangles along the edges in x, y and z: waves shorter than a face need inner vertices.
TriangleMesh BoxMesh(Vec3d size_m, std::array<int, 3> cells);
/// As many along each edge.
TriangleMesh BoxMesh(Vec3d size_m, int cells = 4);

/// 2 · rings · (rings - 1) · 2 triangles; poles on the z axis.
TriangleMesh SphereMesh(double radius_m, int rings = 12);

/// Axis along z. `sectors` around, `cells` along the height.
TriangleMesh CylinderMesh(double radius_m, double height_m, int sectors = 24, int cells = 4);

/// Axis along x; `length_m` is that of the cylindrical part, without the half spheres at the ends.
TriangleMesh CapsuleMesh(double radius_m, double length_m, int sectors = 16);

/// A boat: flat transom, vee bottom that rises to a raked stem, flared sides, flat deck. The keel's
/// lowest line is at z = 0, the deck at z = depth_m, midships at x = 0.
struct BoatLines {
  double length_m = 5.0;
  double beam_m = 2.0;
  double depth_m = 0.9;         ///< keel to deck
  double deadrise_rad = 0.3;    ///< of the bottom amidships and aft; more towards the stem
  double transom_share = 0.85;  ///< breadth of the transom of the greatest, (0, 1]
  double bow_fullness = 2.0;    ///< > 1; larger carries the beam further forward
  int stations = 17;
};
TriangleMesh BoatMesh(const BoatLines& lines);

}  // namespace onesea::world
