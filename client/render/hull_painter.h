#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "client/render/render_frame.h"
#include "common/base/vec.h"

namespace onesea::render {

struct Paint {
  std::array<float, 3> albedo{0.5f, 0.5f, 0.5f};  ///< linear sRGB, 0..1
  float gloss = 0.3f;                             ///< 0 chalk .. 1 glass
  float tinted = 0.0f;                            ///< 1: multiplied by the instance's colour
};

/// Collects painted faces and makes a HullMesh of them. Vertices of equal coordinates are one.
class HullPainter {
 public:
  std::uint32_t Vertex(Vec3d place_m);
  /// Corners counter-clockwise seen from outside; faces without area are left out.
  void Triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, const Paint& paint);
  void Quad(Vec3d a, Vec3d b, Vec3d c, Vec3d d, const Paint& paint);
  void Box(Vec3d low_m, Vec3d high_m, const Paint& paint);
  /// A box whose top is smaller: `inset_m` x from aft, y from both sides, z from the front.
  void Hood(Vec3d low_m, Vec3d high_m, Vec3d inset_m, const Paint& paint);
  /// Turns a profile of (radius, height), from below to above, about the z axis; one paint for
  /// each step. Ends of radius 0 close it.
  void Lathe(std::span<const Vec2d> profile_m, std::span<const Paint> paints, int sectors);
  /// A closed round bar between two places.
  void Bar(Vec3d from_m, Vec3d to_m, double radius_m, int sectors, const Paint& paint);

  /// Normals are means, by area, of the faces around a vertex that meet at less than
  /// `crease_rad`. Cost: corners times faces around a vertex.
  HullMesh Finish(double crease_rad = 0.6) const;

 private:
  struct Face {
    std::array<std::uint32_t, 3> corners;
    Vec3d area;  // outward normal, twice the area long
    Paint paint;
  };
  std::vector<Vec3d> vertices_;
  std::map<std::array<double, 3>, std::uint32_t> known_;
  std::vector<Face> faces_;
};

}  // namespace onesea::render
