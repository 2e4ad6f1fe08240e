#pragma once

#include "server/world/hull.h"

namespace onesea::world {

/// Wigley's hull, y = ±(B/2) (1 - (2x/L)²)(1 - (z/T)²) below z = 0, vertical sides above.
/// Exact: V = 4/9 LBT, A = 2/3 LB, centre of buoyancy 3T/8 below the water, BM = 4LB³/(105 V).
inline TriangleMesh WigleyMesh(double length_m, double beam_m, double draft_m, double freeboard_m,
                               int along = 60, int deep = 30) {
  TriangleMesh mesh;
  const int levels = deep + 2;  // keel to water, then the deck's edge
  const auto index = [&](int i, int j, int side) {
    return static_cast<std::uint32_t>((i * levels + j) * 2 + side);
  };
  for (int i = 0; i <= along; ++i) {
    const double s = 2.0 * i / along - 1.0;
    for (int j = 0; j < levels; ++j) {
      const double z = j <= deep ? draft_m * (static_cast<double>(j) / deep - 1.0) : freeboard_m;
      const double t = z < 0 ? z / draft_m : 0.0;
      const double y = 0.5 * beam_m * (1 - s * s) * (1 - t * t);
      mesh.vertices.push_back({0.5 * length_m * s, y, z});
      mesh.vertices.push_back({0.5 * length_m * s, -y, z});
    }
  }
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j + 1 < levels; ++j) {
      quad(index(i, j, 0), index(i, j + 1, 0), index(i + 1, j + 1, 0), index(i + 1, j, 0));
      quad(index(i, j, 1), index(i + 1, j, 1), index(i + 1, j + 1, 1), index(i, j + 1, 1));
    }
    const int top = levels - 1;
    quad(index(i, top, 0), index(i, top, 1), index(i + 1, top, 1), index(i + 1, top, 0));
  }
  Weld(mesh);
  return mesh;
}

}  // namespace onesea::world
