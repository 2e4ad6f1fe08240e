#include "server/world/hull.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "common/base/limits.h"

namespace onesea::world {
namespace {

std::string Place(Vec3d v) { return absl::StrFormat("(%.4g, %.4g, %.4g)", v.x, v.y, v.z); }

absl::Status CheckNumbers(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return absl::InvalidArgumentError("hull has no triangles");
  if (mesh.triangles.size() > kHullTrianglesMax) {
    return absl::InvalidArgumentError(absl::StrCat("hull has ", mesh.triangles.size(),
                                                   " triangles, at most ", kHullTrianglesMax));
  }
  for (std::size_t n = 0; n < mesh.vertices.size(); ++n) {
    const Vec3d v = mesh.vertices[n];
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!IsFinite(v) || !(largest <= kHullSizeMaxM)) {
      return absl::InvalidArgumentError(absl::StrCat("hull vertex ", n, " at ", Place(v),
                                                     " m: coordinates must be within ",
                                                     kHullSizeMaxM, " m of the origin"));
    }
  }
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
    for (std::uint32_t corner : mesh.triangles[n]) {
      if (corner >= mesh.vertices.size()) {
        return absl::InvalidArgumentError(absl::StrCat("hull triangle ", n, " names vertex ",
                                                       corner, " of ", mesh.vertices.size()));
      }
    }
  }
  return absl::OkStatus();
}

// Every edge is walked exactly once each way.
absl::Status CheckClosed(const TriangleMesh& mesh) {
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) edges.emplace_back(t[k], t[(k + 1) % 3]);
  }
  std::sort(edges.begin(), edges.end());
  const auto count = [&](Edge e) {
    const auto [from, to] = std::equal_range(edges.begin(), edges.end(), e);
    return to - from;
  };
  std::size_t open = 0, turned = 0;
  Edge first_open, first_turned;
  for (const Edge& e : edges) {
    const auto forth = count(e), back = count({e.second, e.first});
    if (forth + back == 1 || (forth + back) % 2 == 1) {
      if (open++ == 0) first_open = e;
    } else if (forth != back) {
      if (turned++ == 0) first_turned = e;
    }
  }
  const auto at = [&](Edge e) {
    return Place(0.5 * (mesh.vertices[e.first] + mesh.vertices[e.second]));
  };
  if (open > 0) {
    return absl::InvalidArgumentError(
        absl::StrCat("hull is not closed: ", open, " open edges, first at ", at(first_open), " m"));
  }
  if (turned > 0) {
    return absl::InvalidArgumentError(
        absl::StrCat("hull has neighbouring triangles of opposite sense: ", turned,
                     " edges, first at ", at(first_turned), " m"));
  }
  return absl::OkStatus();
}

}  // namespace

SolidProperties ComputeSolid(const TriangleMesh& mesh) {
  SolidProperties out;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  out.low_m = {kInfinity, kInfinity, kInfinity};
  out.high_m = {-kInfinity, -kInfinity, -kInfinity};
  for (const Vec3d& v : mesh.vertices) {
    out.low_m = {std::min(out.low_m.x, v.x), std::min(out.low_m.y, v.y),
                 std::min(out.low_m.z, v.z)};
    out.high_m = {std::max(out.high_m.x, v.x), std::max(out.high_m.y, v.y),
                  std::max(out.high_m.z, v.z)};
  }
  // About the middle of the box: far from the origin the tetrahedra would cancel.
  const Vec3d middle = 0.5 * (out.low_m + out.high_m);
  Vec3d first;                     // ∫ x dV
  std::array<double, 6> second{};  // ∫ xx, yy, zz, xy, yz, zx dV
  for (const auto& t : mesh.triangles) {
    const Vec3d a = mesh.vertices[t[0]] - middle, b = mesh.vertices[t[1]] - middle,
                c = mesh.vertices[t[2]] - middle;
    const Vec3d twice_area = Cross(b - a, c - a);
    out.area_m2 += 0.5 * Norm(twice_area);
    const double volume = Dot(a, Cross(b, c)) / 6.0;  // of the tetrahedron to the middle
    const Vec3d sum = a + b + c;
    out.volume_m3 += volume;
    first = first + (volume / 4.0) * sum;
    const auto moment = [&](double Vec3d::*i, double Vec3d::*j) {
      return volume / 20.0 * (sum.*i * sum.*j + a.*i * a.*j + b.*i * b.*j + c.*i * c.*j);
    };
    second[0] += moment(&Vec3d::x, &Vec3d::x);
    second[1] += moment(&Vec3d::y, &Vec3d::y);
    second[2] += moment(&Vec3d::z, &Vec3d::z);
    second[3] += moment(&Vec3d::x, &Vec3d::y);
    second[4] += moment(&Vec3d::y, &Vec3d::z);
    second[5] += moment(&Vec3d::z, &Vec3d::x);
  }
  const double inverse = 1.0 / out.volume_m3;
  const Vec3d g = inverse * first;  // centroid from the middle
  out.centroid_m = middle + g;
  const double xx = second[0] * inverse - g.x * g.x, yy = second[1] * inverse - g.y * g.y,
               zz = second[2] * inverse - g.z * g.z, xy = second[3] * inverse - g.x * g.y,
               yz = second[4] * inverse - g.y * g.z, zx = second[5] * inverse - g.z * g.x;
  out.inertia_per_kg = {{yy + zz, -xy, -zx, -xy, zz + xx, -yz, -zx, -yz, xx + yy}};
  return out;
}

absl::Status ValidateMesh(const TriangleMesh& mesh) {
  if (absl::Status s = CheckNumbers(mesh); !s.ok()) return s;
  if (absl::Status s = CheckClosed(mesh); !s.ok()) return s;
  const SolidProperties solid = ComputeSolid(mesh);
  const Vec3d size = solid.high_m - solid.low_m;
  const double box = size.x * size.y * size.z;
  if (!(std::max({size.x, size.y, size.z}) >= kHullSizeMinM)) {
    return absl::InvalidArgumentError(absl::StrCat("hull is ", std::max({size.x, size.y, size.z}),
                                                   " m long, at least ", kHullSizeMinM,
                                                   " m: is the unit right?"));
  }
  if (!(std::abs(solid.volume_m3) > 1e-6 * box)) {
    return absl::InvalidArgumentError(
        absl::StrCat("hull encloses no volume (", solid.volume_m3, " m³)"));
  }
  if (solid.volume_m3 < 0.0) {
    return absl::InvalidArgumentError(absl::StrCat("hull faces point inwards (volume ",
                                                   solid.volume_m3,
                                                   " m³): reverse the order of the corners"));
  }
  return absl::OkStatus();
}

}  // namespace onesea::world
