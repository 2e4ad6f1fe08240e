#include "server/world/wet_hull.h"

#include <algorithm>
#include <cmath>

#include "common/sea/constants.h"
#include "server/world/water_sample-inl.h"

namespace onesea::world {
namespace {

using Vertex = WetScratch::Vertex;

// Corner of a piece: the vertex or the place where an edge meets the surface.
struct Corner {
  Vec3d at_m;
  Vertex water;
};

// Where the edge from wet `a` to dry `b` meets the surface; `share` is its place along the edge.
Corner OnSurface(const Corner& a, const Corner& b, double share) {
  const auto mix = [&](Vec3d p, Vec3d q) { return p + share * (q - p); };
  return {mix(a.at_m, b.at_m), {0.0, 0.0, mix(a.water.relative_m_per_s, b.water.relative_m_per_s)}};
}

}  // namespace

// Everything per rho g (pressure) or rho/2 (drag) while it is summed.
struct WetHull::Sums {
  Vec3d up;  // in body axes
  DragCoefficients drag;

  Vec3d pressure_force, pressure_torque;
  Vec3d drag_force, drag_torque;
  double volume = 0.0;
  Vec3d volume_moment;
  double raise = 0.0;  // of the volume's centre along up
  double area = 0.0;
  Vec3d area_moment, area_relative;
  int wet = 0;

  void Add(const Corner& a, const Corner& b, const Corner& c, Vec3d normal, double area_m2);
};

void WetHull::Sums::Add(const Corner& a, const Corner& b, const Corner& c, Vec3d normal,
                        double area_m2) {
  const double pa = a.water.head_m, pb = b.water.head_m, pc = c.water.head_m;
  const double da = a.water.depth_m, db = b.water.depth_m, dc = c.water.depth_m;
  const Vec3d sum = a.at_m + b.at_m + c.at_m;
  const double head = pa + pb + pc, depth = da + db + dc;
  const double twelfth = area_m2 * (1.0 / 12.0);

  // ∫ p dS and ∫ x p dS of linear p: exact.
  pressure_force = pressure_force - (4.0 * twelfth * head) * normal;
  const Vec3d moment = twelfth * (head * sum + pa * a.at_m + pb * b.at_m + pc * c.at_m);
  pressure_torque = pressure_torque - Cross(moment, normal);

  // The volume as columns from the hull up to the surface.
  const double upward = Dot(normal, up) * twelfth;
  volume -= 4.0 * upward * depth;
  volume_moment = volume_moment - upward * (depth * sum + da * a.at_m + db * b.at_m + dc * c.at_m);
  raise -= 0.5 * upward * (depth * depth + da * da + db * db + dc * dc);

  const Vec3d w = (1.0 / 3.0) *
                  (a.water.relative_m_per_s + b.water.relative_m_per_s + c.water.relative_m_per_s);
  const Vec3d centre = (1.0 / 3.0) * sum;
  area += area_m2;
  area_moment = area_moment + area_m2 * centre;
  area_relative = area_relative + area_m2 * w;

  const double into = -Dot(w, normal);  // speed at which the piece moves into the water
  const double speed = Norm(w);
  const double along = drag.friction * speed;
  const double against =
      into > 0.0 ? drag.pressure * into + drag.planing * speed : -drag.suction * into;
  const Vec3d force = area_m2 * (along * w + ((along - against) * into) * normal);
  drag_force = drag_force + force;
  drag_torque = drag_torque + Cross(centre, force);
}

WetHull::WetHull(const TriangleMesh& mesh, Vec3d centre_of_mass_m) {
  vertices_m_.reserve(mesh.vertices.size());
  for (const Vec3d& v : mesh.vertices) {
    vertices_m_.push_back(v - centre_of_mass_m);
    radius_m_ = std::max(radius_m_, Norm(vertices_m_.back()));
  }
  for (const auto& t : mesh.triangles) {
    const Vec3d a = vertices_m_[t[0]], b = vertices_m_[t[1]], c = vertices_m_[t[2]];
    const Vec3d twice = Cross(b - a, c - a);
    const double length = Norm(twice);
    if (!(length > 0.0)) continue;  // a sliver has no force
    triangles_.push_back({t, (1.0 / length) * twice, 0.5 * length});
  }
}

void WetHull::Bounds(double height_m, Vec3d& low_m, Vec3d& high_m) const {
  low_m = {radius_m_, radius_m_, radius_m_};
  high_m = -1.0 * low_m;
  const auto include = [&](Vec3d v) {
    low_m = {std::min(low_m.x, v.x), std::min(low_m.y, v.y), std::min(low_m.z, v.z)};
    high_m = {std::max(high_m.x, v.x), std::max(high_m.y, v.y), std::max(high_m.z, v.z)};
  };
  for (const Triangle& t : triangles_) {
    for (int k = 0; k < 3; ++k) {
      const Vec3d a = vertices_m_[t.corners[k]], b = vertices_m_[t.corners[(k + 1) % 3]];
      if (a.z <= height_m) include(a);
      if ((a.z <= height_m) != (b.z <= height_m)) {
        include(a + ((height_m - a.z) / (b.z - a.z)) * (b - a));
      }
    }
  }
}

void WetHull::SampleVertices(const HullMotion& motion, const WaterPatch& water,
                             WetScratch& scratch) const {
  const WaterSampler sampler(water);
  const Mat3d turn = ToMatrix(motion.pose.turn);
  const Vec3d velocity = turn.TransposeTimes(motion.velocity_m_per_s);
  const Vec3d spin = turn.TransposeTimes(motion.spin_rad_per_s);
  if (scratch.vertices.size() < vertices_m_.size()) scratch.vertices.resize(vertices_m_.size());
  Vertex* out = scratch.vertices.data();
  for (const Vec3d& at : vertices_m_) {
    const WaterPoint point = internal::Sample(sampler, motion.pose.centre_m + turn * at);
    *out++ = {point.depth_m, point.head_m,
              turn.TransposeTimes(point.velocity_m_per_s) - velocity - Cross(spin, at)};
  }
}

WetForces WetHull::Evaluate(const HullMotion& motion, const WaterPatch& water,
                            double density_kg_per_m3, const DragCoefficients& drag,
                            WetScratch& scratch) const {
  SampleVertices(motion, water, scratch);
  const Mat3d turn = ToMatrix(motion.pose.turn);
  Sums sums;
  sums.up = turn.TransposeTimes({0.0, 0.0, 1.0});
  sums.drag = drag;
  const auto corner = [&](std::uint32_t vertex) {
    return Corner{vertices_m_[vertex], scratch.vertices[vertex]};
  };
  for (const Triangle& t : triangles_) {
    const bool wet[3] = {scratch.vertices[t.corners[0]].depth_m > 0.0,
                         scratch.vertices[t.corners[1]].depth_m > 0.0,
                         scratch.vertices[t.corners[2]].depth_m > 0.0};
    const int count = wet[0] + wet[1] + wet[2];
    if (count == 0) continue;
    ++sums.wet;
    if (count == 3) {
      sums.Add(corner(t.corners[0]), corner(t.corners[1]), corner(t.corners[2]), t.normal,
               t.area_m2);
      continue;
    }
    // Turn the triangle so that its odd corner comes last (one dry) or first (one wet).
    int first = 0;
    if (count == 1) {
      while (!wet[first]) ++first;
    } else {
      while (wet[(first + 2) % 3]) ++first;
    }
    const Corner a = corner(t.corners[first]), b = corner(t.corners[(first + 1) % 3]),
                 c = corner(t.corners[(first + 2) % 3]);
    const auto share = [](const Corner& from, const Corner& to) {
      return from.water.depth_m / (from.water.depth_m - to.water.depth_m);
    };
    const double ac = share(a, c);
    if (count == 1) {
      const double ab = share(a, b);
      sums.Add(a, OnSurface(a, b, ab), OnSurface(a, c, ac), t.normal, t.area_m2 * ab * ac);
    } else {
      const double bc = share(b, c);
      const Corner on_bc = OnSurface(b, c, bc);
      sums.Add(a, b, on_bc, t.normal, t.area_m2 * bc);
      sums.Add(a, on_bc, OnSurface(a, c, ac), t.normal, t.area_m2 * ac * (1.0 - bc));
    }
  }

  WetForces out;
  const double weight = density_kg_per_m3 * sea::kGravity, half = 0.5 * density_kg_per_m3;
  out.pressure_force_n = weight * sums.pressure_force;
  out.pressure_torque_n_m = weight * sums.pressure_torque;
  out.drag_force_n = half * sums.drag_force;
  out.drag_torque_n_m = half * sums.drag_torque;
  out.volume_m3 = std::max(0.0, sums.volume);
  out.wet_area_m2 = sums.area;
  out.wet_triangles = sums.wet;
  if (sums.volume > 0.0) {
    out.volume_centre_m = (1.0 / sums.volume) * (sums.volume_moment + sums.raise * sums.up);
  }
  if (sums.area > 0.0) {
    const double inverse = 1.0 / sums.area;
    out.water_velocity_m_per_s =
        inverse * sums.area_relative + turn.TransposeTimes(motion.velocity_m_per_s) +
        Cross(turn.TransposeTimes(motion.spin_rad_per_s), inverse * sums.area_moment);
  }
  return out;
}

}  // namespace onesea::world
