#include "client/render/hull_levels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <map>

#include "common/base/check.h"

namespace onesea::render {
namespace {

// Paint times area, summed.
struct PaintSum {
  glm::vec3 albedo{0.0f};
  float gloss = 0.0f, tinted = 0.0f, area = 0.0f;

  void Add(const HullCorner& corner, float around) {
    area += around;
    albedo += around * glm::make_vec3(corner.albedo.data());
    gloss += around * corner.gloss;
    tinted += around * corner.tinted;
  }
};

// Corners that become one, and the paint around them.
struct Cluster {
  glm::vec3 sum{0.0f};
  float count = 0.0f;
  PaintSum paint;
  glm::vec3 place() const { return sum / count; }
};

// Triangles that become one.
struct Face {
  std::array<glm::vec3, 3> normals{};
  PaintSum paint;
};

// Half the triangle's own paint, half of what is around the corner: stripes that are folded away
// must not give way to the ones beside them, nor windows to walls.
HullCorner PaintedCorner(const Cluster& cluster, const Face& face, const glm::vec3& normal) {
  const auto mean = [&](auto part) {
    return 0.5f * (part(face.paint) / face.paint.area + part(cluster.paint) / cluster.paint.area);
  };
  const glm::vec3 at = cluster.place();
  const glm::vec3 albedo = mean([](const PaintSum& p) { return p.albedo; });
  return {{at.x, at.y, at.z},
          {normal.x, normal.y, normal.z},
          {albedo.r, albedo.g, albedo.b},
          mean([](const PaintSum& p) { return p.gloss; }),
          mean([](const PaintSum& p) { return p.tinted; })};
}

glm::vec3 PlaceOf(const HullCorner& corner) { return glm::make_vec3(corner.position_m.data()); }

}  // namespace

HullMesh CoarserHull(const HullMesh& mesh, float cell_m) {
  ONESEA_CHECK(cell_m > 0.0f && mesh.corners.size() % 3 == 0);
  std::map<std::array<int, 3>, std::uint32_t> cells;
  std::vector<Cluster> clusters;
  std::vector<std::uint32_t> cluster_of;
  for (const HullCorner& corner : mesh.corners) {
    const auto cell = [&](std::size_t axis) {
      return static_cast<int>(std::floor(corner.position_m[axis] / cell_m));
    };
    const auto [entry, is_new] =
        cells.try_emplace({cell(0), cell(1), cell(2)}, static_cast<std::uint32_t>(clusters.size()));
    if (is_new) clusters.emplace_back();
    clusters[entry->second].sum += PlaceOf(corner);
    clusters[entry->second].count += 1.0f;
    cluster_of.push_back(entry->second);
  }

  // Keyed by their corners from the least on, in the order that says which side is outside.
  std::map<std::array<std::uint32_t, 3>, Face> faces;
  for (std::size_t t = 0; t + 2 < mesh.corners.size(); t += 3) {
    std::array<std::uint32_t, 3> key{cluster_of[t], cluster_of[t + 1], cluster_of[t + 2]};
    const glm::vec3 a = PlaceOf(mesh.corners[t]), b = PlaceOf(mesh.corners[t + 1]);
    const float area = 0.5f * glm::length(glm::cross(b - a, PlaceOf(mesh.corners[t + 2]) - a));
    for (std::size_t n = 0; n < 3; ++n) clusters[key[n]].paint.Add(mesh.corners[t + n], area);
    if (key[0] == key[1] || key[1] == key[2] || key[2] == key[0]) continue;
    const auto first =
        static_cast<std::size_t>(std::min_element(key.begin(), key.end()) - key.begin());
    std::rotate(key.begin(), key.begin() + static_cast<std::ptrdiff_t>(first), key.end());
    Face& face = faces[key];
    for (std::size_t n = 0; n < 3; ++n) {
      face.paint.Add(mesh.corners[t + n], area / 3.0f);
      face.normals[n] += area * glm::make_vec3(mesh.corners[t + (n + first) % 3].normal.data());
    }
  }

  HullMesh coarse;
  for (const auto& [key, face] : faces) {
    if (!(face.paint.area > 0.0f)) continue;
    for (std::size_t n = 0; n < 3; ++n) {
      const glm::vec3 normal = glm::normalize(face.normals[n] + glm::vec3(1e-12f));
      coarse.corners.push_back(PaintedCorner(clusters[key[n]], face, normal));
    }
  }
  return coarse;
}

}  // namespace onesea::render
