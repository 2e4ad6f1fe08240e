#include "server/world/wet_hull.h"

#include <algorithm>
#include <cmath>

#include "common/sea/constants.h"

namespace onesea::world {
namespace {

Vec3d VectorOf(const std::array<double, kWetSums>& sums, int at) {
  return {sums[at], sums[at + 1], sums[at + 2]};
}

}  // namespace

WetHull::WetHull(const TriangleMesh& mesh, Vec3d centre_of_mass_m) {
  vertices_m_.reserve(mesh.vertices.size());
  for (const Vec3d& v : mesh.vertices) {
    const Vec3d& from = vertices_m_.emplace_back(v - centre_of_mass_m);
    radius_m_ = std::max(radius_m_, Norm(from));
    reach_m_ = {std::max(reach_m_.x, std::abs(from.x)), std::max(reach_m_.y, std::abs(from.y)),
                std::max(reach_m_.z, std::abs(from.z))};
  }
  for (const auto& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      edge_max_m_ = std::max(edge_max_m_, Norm(vertices_m_[t[k]] - vertices_m_[t[(k + 1) % 3]]));
    }
    if (Norm(TwiceArea(t)) > 0.0) triangles_.push_back(t);  // a sliver has no force
  }
  // Blocks of triangles are then mostly all wet or all dry.
  const auto height = [&](const auto& t) {
    return vertices_m_[t[0]].z + vertices_m_[t[1]].z + vertices_m_[t[2]].z;
  };
  std::stable_sort(triangles_.begin(), triangles_.end(),
                   [&](const auto& a, const auto& b) { return height(a) < height(b); });
  FillBlocks();
}

Vec3d WetHull::TwiceArea(const std::array<std::uint32_t, 3>& triangle) const {
  const Vec3d a = vertices_m_[triangle[0]];
  return Cross(vertices_m_[triangle[1]] - a, vertices_m_[triangle[2]] - a);
}

void WetHull::FillBlocks() {
  mesh_.vertices = WholeBlocks(vertices_m_.size());
  mesh_.triangles = WholeBlocks(triangles_.size());
  for (auto* array : {&mesh_.x, &mesh_.y, &mesh_.z}) {
    *array = sea::AllocateZeros<double>(mesh_.vertices);
  }
  for (auto* array : {&mesh_.normal_x, &mesh_.normal_y, &mesh_.normal_z, &mesh_.area}) {
    *array = sea::AllocateZeros<double>(mesh_.triangles);
  }
  for (int k = 0; k < 3; ++k) {
    mesh_.corner[k] = sea::AllocateZeros<std::int64_t>(mesh_.triangles);
    for (auto* array : {&mesh_.corner_x[k], &mesh_.corner_y[k], &mesh_.corner_z[k]}) {
      *array = sea::AllocateZeros<double>(mesh_.triangles);
    }
  }
  for (std::size_t n = 0; n < vertices_m_.size(); ++n) {
    mesh_.x[n] = vertices_m_[n].x, mesh_.y[n] = vertices_m_[n].y, mesh_.z[n] = vertices_m_[n].z;
  }
  for (std::size_t n = 0; n < triangles_.size(); ++n) {
    const Vec3d twice = TwiceArea(triangles_[n]);
    const double length = Norm(twice);
    mesh_.normal_x[n] = twice.x / length;
    mesh_.normal_y[n] = twice.y / length;
    mesh_.normal_z[n] = twice.z / length;
    mesh_.area[n] = 0.5 * length;
    for (int k = 0; k < 3; ++k) {
      const Vec3d at = vertices_m_[triangles_[n][k]];
      mesh_.corner[k][n] = triangles_[n][k];
      mesh_.corner_x[k][n] = at.x, mesh_.corner_y[k][n] = at.y, mesh_.corner_z[k][n] = at.z;
    }
  }
}

void WetHull::Bounds(double height_m, Vec3d& low_m, Vec3d& high_m) const {
  low_m = {radius_m_, radius_m_, radius_m_};
  high_m = -1.0 * low_m;
  const auto include = [&](Vec3d v) {
    low_m = {std::min(low_m.x, v.x), std::min(low_m.y, v.y), std::min(low_m.z, v.z)};
    high_m = {std::max(high_m.x, v.x), std::max(high_m.y, v.y), std::max(high_m.z, v.z)};
  };
  for (const auto& t : triangles_) {
    for (int k = 0; k < 3; ++k) {
      const Vec3d a = vertices_m_[t[k]], b = vertices_m_[t[(k + 1) % 3]];
      if (a.z <= height_m) include(a);
      if ((a.z <= height_m) != (b.z <= height_m)) {
        include(a + ((height_m - a.z) / (b.z - a.z)) * (b - a));
      }
    }
  }
}

WetForces WetHull::Evaluate(const HullMotion& motion, const WaterPatch& water,
                            double density_kg_per_m3, const wire::Drag& drag,
                            WetScratch& scratch) const {
  const Mat3d turn = ToMatrix(motion.pose.turn);
  const Vec3d velocity = turn.TransposeTimes(motion.velocity_m_per_s);
  const Vec3d spin = turn.TransposeTimes(motion.spin_rad_per_s);
  scratch.Reserve(mesh_);
  SampleVertices(mesh_, {motion.pose.centre_m, turn, velocity, spin, edge_max_m_},
                 WaterSampler(water), scratch);
  const WetCoefficients coefficients{turn.TransposeTimes({0.0, 0.0, 1.0}), drag.friction,
                                     drag.pressure, drag.suction, drag.planing};
  std::array<double, kWetSums> sums;
  WetForces out;
  out.wet_triangles = SumWetted(mesh_, coefficients, scratch, sums);

  const double weight = density_kg_per_m3 * sea::kGravity, half = 0.5 * density_kg_per_m3;
  out.pressure_force_n = weight * VectorOf(sums, kPressureForce);
  out.pressure_torque_n_m = weight * VectorOf(sums, kPressureTorque);
  out.drag_force_n = half * VectorOf(sums, kDragForce);
  out.drag_torque_n_m = half * VectorOf(sums, kDragTorque);
  const double volume = sums[kVolume], area = sums[kArea];
  out.volume_m3 = std::max(0.0, volume);
  out.wet_area_m2 = area;
  if (volume > 0.0) {
    out.volume_centre_m =
        (1.0 / volume) * (VectorOf(sums, kVolumeMoment) + sums[kRaise] * coefficients.up);
  }
  if (area > 0.0) {
    out.water_velocity_m_per_s = (1.0 / area) * VectorOf(sums, kAreaRelative) + velocity +
                                 Cross(spin, (1.0 / area) * VectorOf(sums, kAreaMoment));
  }
  return out;
}

}  // namespace onesea::world
