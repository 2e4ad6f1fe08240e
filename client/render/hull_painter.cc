#include "client/render/hull_painter.h"

#include <cmath>

#include "common/base/check.h"

namespace onesea::render {
namespace {

constexpr double kPi = 3.14159265358979323846;

std::array<float, 3> Floats(Vec3d v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace

std::uint32_t HullPainter::Vertex(Vec3d place) {
  const auto next = static_cast<std::uint32_t>(vertices_.size());
  const auto [entry, is_new] = known_.try_emplace({place.x, place.y, place.z}, next);
  if (is_new) vertices_.push_back(place);
  return entry->second;
}

void HullPainter::Triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, const Paint& paint) {
  const Vec3d area = Cross(vertices_[b] - vertices_[a], vertices_[c] - vertices_[a]);
  if (!(Norm(area) > 0.0)) return;
  faces_.push_back({{a, b, c}, area, paint});
}

void HullPainter::Quad(Vec3d a, Vec3d b, Vec3d c, Vec3d d, const Paint& paint) {
  const std::uint32_t va = Vertex(a), vb = Vertex(b), vc = Vertex(c), vd = Vertex(d);
  Triangle(va, vb, vc, paint);
  Triangle(va, vc, vd, paint);
}

void HullPainter::Box(Vec3d low, Vec3d high, const Paint& paint) { Hood(low, high, {}, paint); }

void HullPainter::Hood(Vec3d low, Vec3d high, Vec3d inset, const Paint& paint) {
  const Vec3d bottom[] = {{low.x, low.y, low.z},
                          {high.x, low.y, low.z},
                          {high.x, high.y, low.z},
                          {low.x, high.y, low.z}};
  const double aft = low.x + inset.x, front = high.x - inset.z;
  const double right = low.y + inset.y, left = high.y - inset.y;
  const Vec3d top[] = {
      {aft, right, high.z}, {front, right, high.z}, {front, left, high.z}, {aft, left, high.z}};
  for (int n = 0; n < 4; ++n) {
    const int m = (n + 1) % 4;
    Quad(bottom[n], bottom[m], top[m], top[n], paint);
  }
  Quad(top[0], top[1], top[2], top[3], paint);
  Quad(bottom[3], bottom[2], bottom[1], bottom[0], paint);
}

void HullPainter::Lathe(std::span<const Vec2d> profile, std::span<const Paint> paints,
                        int sectors) {
  ONESEA_CHECK(paints.size() + 1 == profile.size() && sectors >= 3);
  const auto at = [&](std::size_t step, int sector) {
    const double angle = 2.0 * kPi * (sector % sectors) / sectors;
    const double radius = profile[step].x;
    return Vec3d{radius * std::cos(angle), radius * std::sin(angle), profile[step].y};
  };
  for (std::size_t step = 0; step < paints.size(); ++step) {
    for (int n = 0; n < sectors; ++n) {
      Quad(at(step, n), at(step, n + 1), at(step + 1, n + 1), at(step + 1, n), paints[step]);
    }
  }
}

void HullPainter::Bar(Vec3d from, Vec3d to, double radius, int sectors, const Paint& paint) {
  const Vec3d axis = (1.0 / Norm(to - from)) * (to - from);
  const Vec3d other = std::abs(axis.z) < 0.9 ? Vec3d{0, 0, 1} : Vec3d{1, 0, 0};
  Vec3d u = Cross(other, axis);
  u = (1.0 / Norm(u)) * u;
  const Vec3d v = Cross(axis, u);
  const auto ring = [&](Vec3d centre, int n) {
    const double angle = 2.0 * kPi * (n % sectors) / sectors;
    return centre + radius * std::cos(angle) * u + radius * std::sin(angle) * v;
  };
  for (int n = 0; n < sectors; ++n) {
    Quad(ring(from, n), ring(from, n + 1), ring(to, n + 1), ring(to, n), paint);
    Triangle(Vertex(to), Vertex(ring(to, n)), Vertex(ring(to, n + 1)), paint);
    Triangle(Vertex(from), Vertex(ring(from, n + 1)), Vertex(ring(from, n)), paint);
  }
}

HullMesh HullPainter::Finish(double crease_rad) const {
  std::vector<std::vector<std::uint32_t>> around(vertices_.size());
  for (std::uint32_t f = 0; f < faces_.size(); ++f) {
    for (std::uint32_t corner : faces_[f].corners) around[corner].push_back(f);
  }
  const double cosine = std::cos(crease_rad);
  HullMesh mesh;
  mesh.corners.reserve(3 * faces_.size());
  for (const Face& face : faces_) {
    const double length = Norm(face.area);
    for (std::uint32_t corner : face.corners) {
      Vec3d normal{};
      for (std::uint32_t f : around[corner]) {
        const Vec3d& other = faces_[f].area;
        if (Dot(other, face.area) >= cosine * Norm(other) * length) normal = normal + other;
      }
      mesh.corners.push_back({Floats(vertices_[corner]), Floats((1.0 / Norm(normal)) * normal),
                              face.paint.albedo, face.paint.gloss, face.paint.tinted});
    }
  }
  return mesh;
}

}  // namespace onesea::render
