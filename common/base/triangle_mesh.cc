#include "common/base/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace onesea {
namespace {

std::tuple<double, double, double> Key(Vec3d v) { return {v.x, v.y, v.z}; }

}  // namespace

void Weld(TriangleMesh& mesh) {
  std::vector<std::uint32_t> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  // NaN has no order; who uses a mesh refuses those.
  if (!std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                   [](Vec3d v) { return std::isfinite(v.x + v.y + v.z); })) {
    return;
  }
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return Key(mesh.vertices[a]) < Key(mesh.vertices[b]);
  });
  // The first of equal vertices in the file keeps its place, so that the order of the file stays.
  std::vector<std::uint32_t> first(order.size()), place(order.size());
  for (std::size_t n = 0; n < order.size(); ++n) {
    const bool same = n > 0 && Key(mesh.vertices[order[n]]) == Key(mesh.vertices[order[n - 1]]);
    first[order[n]] = same ? first[order[n - 1]] : order[n];
  }
  std::vector<Vec3d> vertices;
  for (std::uint32_t n = 0; n < first.size(); ++n) {
    if (first[n] == n) {
      place[n] = static_cast<std::uint32_t>(vertices.size());
      vertices.push_back(mesh.vertices[n]);
    } else {
      place[n] = place[first[n]];
    }
  }
  for (auto& t : mesh.triangles) {
    for (std::uint32_t& corner : t) {
      if (corner < place.size()) corner = place[corner];
    }
  }
  std::erase_if(mesh.triangles,
                [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  mesh.vertices = std::move(vertices);
}

}  // namespace onesea
