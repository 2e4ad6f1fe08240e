#include "server/world/hull_shapes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/check.h"
#include "common/base/real_math.h"
#include "common/sea/constants.h"

namespace onesea::world {
namespace {

using sea::kPi;

void AddQuad(TriangleMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c,
             std::uint32_t d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

struct ProfilePoint {
  double radius_m, z_m;
};

// A body of revolution about z. Profile from the lower pole to the upper one, both on the axis.
TriangleMesh Lathe(const std::vector<ProfilePoint>& profile, int sectors) {
  TriangleMesh mesh;
  const auto count = static_cast<std::uint32_t>(sectors);
  const auto vertex = [&](std::size_t ring, std::uint32_t sector) {
    return static_cast<std::uint32_t>(ring) * count + sector % count;
  };
  for (const ProfilePoint& p : profile) {
    for (int s = 0; s < sectors; ++s) {
      const real::SinCosPair turn = real::SinCos(2.0 * kPi * s / sectors);
      mesh.vertices.push_back({p.radius_m * turn.cos, p.radius_m * turn.sin, p.z_m});
    }
  }
  for (std::size_t ring = 0; ring + 1 < profile.size(); ++ring) {
    for (std::uint32_t s = 0; s < count; ++s) {
      AddQuad(mesh, vertex(ring, s), vertex(ring, s + 1), vertex(ring + 1, s + 1),
              vertex(ring + 1, s));
    }
  }
  Weld(mesh);  // joins the poles
  return mesh;
}

void Scale(TriangleMesh& mesh, Vec3d by) {
  for (Vec3d& v : mesh.vertices) v = {by.x * v.x, by.y * v.y, by.z * v.z};
}

// Scales the radius about z so that the polyhedron has the volume of the round body.
void MatchVolumeRadially(TriangleMesh& mesh, double volume_m3) {
  const double scale = std::sqrt(volume_m3 / ComputeSolid(mesh).volume_m3);
  Scale(mesh, {scale, scale, 1.0});
}

}  // namespace

TriangleMesh BoxMesh(Vec3d size_m, std::array<int, 3> cells) {
  const double size[] = {size_m.x, size_m.y, size_m.z};
  for (int axis = 0; axis < 3; ++axis) ONESEA_CHECK(size[axis] > 0 && cells[axis] >= 1);
  TriangleMesh mesh;
  // Outward normal along axis `n` with sign; u x v = n.
  const auto face = [&](int n, double sign) {
    const int u = (n + 1) % 3, v = (n + 2) % 3;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto row = static_cast<std::uint32_t>(cells[u] + 1);
    for (int j = 0; j <= cells[v]; ++j) {
      for (int i = 0; i <= cells[u]; ++i) {
        double p[3];
        p[n] = 0.5 * sign * size[n];
        p[u] = (static_cast<double>(i) / cells[u] - 0.5) * size[u];
        p[v] = (static_cast<double>(j) / cells[v] - 0.5) * size[v];
        mesh.vertices.push_back({p[0], p[1], p[2]});
      }
    }
    for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(cells[v]); ++j) {
      for (std::uint32_t i = 0; i + 1 < row; ++i) {
        const std::uint32_t a = first + j * row + i;
        if (sign > 0) {
          AddQuad(mesh, a, a + 1, a + row + 1, a + row);
        } else {
          AddQuad(mesh, a, a + row, a + row + 1, a + 1);
        }
      }
    }
  };
  for (const double sign : {-1.0, 1.0}) {
    for (int axis = 0; axis < 3; ++axis) face(axis, sign);
  }
  Weld(mesh);
  return mesh;
}

TriangleMesh BoxMesh(Vec3d size_m, int cells) { return BoxMesh(size_m, {cells, cells, cells}); }

TriangleMesh SphereMesh(double radius_m, int rings) {
  ONESEA_CHECK(radius_m > 0 && rings >= 3);
  std::vector<ProfilePoint> profile;
  for (int r = 0; r <= rings; ++r) {
    const real::SinCosPair turn = real::SinCos(kPi * r / rings);
    profile.push_back({r == 0 || r == rings ? 0.0 : turn.sin, -turn.cos});
  }
  TriangleMesh mesh = Lathe(profile, 2 * rings);
  const double scale =
      real::Pow(4.0 / 3.0 * kPi / ComputeSolid(mesh).volume_m3, 1.0 / 3.0) * radius_m;
  Scale(mesh, {scale, scale, scale});
  return mesh;
}

TriangleMesh CylinderMesh(double radius_m, double height_m, int sectors, int cells) {
  ONESEA_CHECK(radius_m > 0 && height_m > 0 && sectors >= 3 && cells >= 1);
  std::vector<ProfilePoint> profile{{0.0, -0.5 * height_m}, {0.5 * radius_m, -0.5 * height_m}};
  for (int n = 0; n <= cells; ++n) {
    profile.push_back({radius_m, (static_cast<double>(n) / cells - 0.5) * height_m});
  }
  profile.push_back({0.5 * radius_m, 0.5 * height_m});
  profile.push_back({0.0, 0.5 * height_m});
  TriangleMesh mesh = Lathe(profile, sectors);
  MatchVolumeRadially(mesh, kPi * radius_m * radius_m * height_m);
  return mesh;
}

TriangleMesh CapsuleMesh(double radius_m, double length_m, int sectors) {
  ONESEA_CHECK(radius_m > 0 && length_m > 0 && sectors >= 4);
  constexpr int kArc = 6;
  constexpr int kStraight = 6;
  std::vector<ProfilePoint> profile;
  for (int n = 0; n <= kArc; ++n) {
    const real::SinCosPair turn = real::SinCos(0.5 * kPi * n / kArc);
    profile.push_back({radius_m * turn.sin, -0.5 * length_m - radius_m * turn.cos});
  }
  profile.front().radius_m = 0.0;
  for (int n = 1; n < kStraight; ++n) {
    profile.push_back({radius_m, (static_cast<double>(n) / kStraight - 0.5) * length_m});
  }
  for (int n = kArc; n >= 0; --n) profile.push_back({profile[n].radius_m, -profile[n].z_m});
  TriangleMesh mesh = Lathe(profile, sectors);
  MatchVolumeRadially(mesh, kPi * radius_m * radius_m * (length_m + 4.0 / 3.0 * radius_m));
  for (Vec3d& v : mesh.vertices) v = {v.z, v.x, v.y};  // the axis becomes x
  return mesh;
}

TriangleMesh BoatMesh(const BoatLines& lines) {
  ONESEA_CHECK(lines.length_m > 0 && lines.beam_m > 0 && lines.depth_m > 0 && lines.stations >= 4);
  constexpr double kParallelEnds = 0.45;  // share of the length, from aft, where the bow begins
  const double tan_deadrise = real::Sin(lines.deadrise_rad) / real::Cos(lines.deadrise_rad);
  TriangleMesh mesh;
  constexpr std::uint32_t kRing = 10;
  for (int s = 0; s < lines.stations; ++s) {
    const double along = static_cast<double>(s) / (lines.stations - 1);  // 0 transom, 1 stem
    const double fore = std::max(0.0, (along - kParallelEnds) / (1.0 - kParallelEnds));
    const double aft = std::max(0.0, 1.0 - along / kParallelEnds);
    const double fullness =
        s + 1 == lines.stations ? 0.0 : 1.0 - real::Pow(fore, lines.bow_fullness);
    const double half =
        0.5 * lines.beam_m * fullness * (1.0 - (1.0 - lines.transom_share) * aft * aft);
    const double keel_z = 0.75 * lines.depth_m * fore * fore * fore;  // the stem's forefoot
    const double chine_half = 0.85 * half;
    const double chine_z =
        keel_z + std::min(chine_half * tan_deadrise + 0.5 * (lines.depth_m - keel_z) * fore,
                          0.8 * (lines.depth_m - keel_z));
    // The stem rakes: the deck reaches further forward than the keel.
    const double rake = 0.12 * lines.length_m * fore * fore;
    const auto x_at = [&](double z) {
      return (along - 0.5) * lines.length_m - rake * (1.0 - z / lines.depth_m);
    };
    const auto point = [&](double y, double z) { mesh.vertices.push_back({x_at(z), y, z}); };
    const double mid_z = 0.5 * (chine_z + lines.depth_m), mid_half = 0.5 * (chine_half + half);
    const double low_z = 0.5 * (keel_z + chine_z);
    point(0.0, keel_z);  // then up the starboard side
    point(-0.5 * chine_half, low_z);
    point(-chine_half, chine_z);
    point(-mid_half, mid_z);
    point(-half, lines.depth_m);
    point(0.0, lines.depth_m);
    point(half, lines.depth_m);  // and down the port side
    point(mid_half, mid_z);
    point(chine_half, chine_z);
    point(0.5 * chine_half, low_z);
  }
  for (std::uint32_t j = 1; j + 1 < kRing; ++j) mesh.triangles.push_back({0, j, j + 1});
  for (std::uint32_t s = 0; s + 1 < static_cast<std::uint32_t>(lines.stations); ++s) {
    for (std::uint32_t j = 0; j < kRing; ++j) {
      const std::uint32_t a = s * kRing + j, d = s * kRing + (j + 1) % kRing;
      if (j < kRing / 2) {
        AddQuad(mesh, a, a + kRing, d + kRing, d);
      } else {  // the port side is the mirror image, diagonals included
        AddQuad(mesh, a + kRing, d + kRing, d, a);
      }
    }
  }
  Weld(mesh);
  return mesh;
}

}  // namespace onesea::world
