#include "server/world/displaced_columns.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/base/check.h"
#include "common/sea/grid_place.h"

namespace onesea::world {
namespace {

// A corner of a piece: its place and how deep it lies.
struct Corner {
  double x, y, depth;
};

Corner Middle(const Corner& a, const Corner& b) {
  return {0.5 * (a.x + b.x), 0.5 * (a.y + b.y), 0.5 * (a.depth + b.depth)};
}

// Where the edge from `wet` to `dry` leaves the water.
Corner Crossing(const Corner& wet, const Corner& dry) {
  const double t = wet.depth / (wet.depth - dry.depth);
  return {wet.x + t * (dry.x - wet.x), wet.y + t * (dry.y - wet.y), 0.0};
}

// Longest side of a piece: at 0.7 a level bottom comes out level to 1 %.
constexpr double kPieceCells = 0.7;

class Spreader {
 public:
  Spreader(const sea::CellRect& cells, std::span<float> head_m, double share)
      : cells_(cells),
        head_m_(head_m),
        share_(share),
        cells_per_m_(1.0 / cells.cell_m),
        west_m_(cells.PlaceOf(cells.west, cells.south).x),
        south_m_(cells.PlaceOf(cells.west, cells.south).y) {}

  // The column between a wetted piece and the surface.
  void Add(const Corner& a, const Corner& b, const Corner& c, int splits) {
    const double longest = std::max({Reach(a, b), Reach(b, c), Reach(c, a)});
    if (splits > 0 && longest > kPieceCells * cells_.cell_m) {
      const Corner ab = Middle(a, b), bc = Middle(b, c), ca = Middle(c, a);
      Add(a, ab, ca, splits - 1);
      Add(ab, b, bc, splits - 1);
      Add(ca, bc, c, splits - 1);
      Add(ab, bc, ca, splits - 1);
      return;
    }
    // Counter-clockwise from outside: seen from above, faces that look down turn clockwise.
    const double area = -0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    const double volume = area * (a.depth + b.depth + c.depth) / 3.0;
    Spread((a.x + b.x + c.x) / 3.0, (a.y + b.y + c.y) / 3.0, volume);
  }

 private:
  static double Reach(const Corner& a, const Corner& b) {
    return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y));
  }

  void Spread(double x, double y, double volume_m3) {
    const double column = (x - west_m_) * cells_per_m_, row = (y - south_m_) * cells_per_m_;
    if (!(column >= 1.0 && column < cells_.columns - 2 && row >= 1.0 && row < cells_.rows - 2)) {
      return;
    }
    const int i = static_cast<int>(std::lround(column)), j = static_cast<int>(std::lround(row));
    const std::array<double, 3> u = Weights(column - i), v = Weights(row - j);
    const double head = share_ * volume_m3 * cells_per_m_ * cells_per_m_;
    for (int dj = 0; dj < 3; ++dj) {
      float* at = &head_m_[static_cast<std::size_t>(j + dj - 1) * cells_.columns + (i - 1)];
      for (int di = 0; di < 3; ++di) at[di] += static_cast<float>(v[dj] * u[di] * head);
    }
  }

  // Of the quadratic B-spline at offsets -1, 0, 1; t in [-1/2, 1/2].
  static std::array<double, 3> Weights(double t) {
    return {0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t, 0.5 * (0.5 + t) * (0.5 + t)};
  }

  const sea::CellRect& cells_;
  std::span<float> head_m_;
  double share_, cells_per_m_, west_m_, south_m_;
};

// The wetted part of a triangle, at most two pieces.
void AddTriangle(const std::array<Corner, 3>& triangle, Spreader& spreader) {
  constexpr int kSplitsMax = 6;
  std::array<Corner, 4> wet;
  int count = 0;
  for (int n = 0; n < 3; ++n) {
    const Corner& here = triangle[n];
    const Corner& next = triangle[(n + 1) % 3];
    if (here.depth > 0.0) wet[count++] = here;
    if ((here.depth > 0.0) != (next.depth > 0.0)) {
      wet[count++] = here.depth > 0.0 ? Crossing(here, next) : Crossing(next, here);
    }
  }
  for (int n = 2; n < count; ++n) spreader.Add(wet[0], wet[n - 1], wet[n], kSplitsMax);
}

}  // namespace

double HeightPatch::At(double x, double y) const {
  if (columns == 0) return flat_m;
  const sea::GridPlace u = sea::LocateOnGrid((x - west_m) / cell_m, columns);
  const sea::GridPlace v = sea::LocateOnGrid((y - south_m) / cell_m, rows);
  const float* at = &height_m[static_cast<std::size_t>(v.cell) * columns + u.cell];
  const double south = at[0] + u.fraction * (at[1] - at[0]);
  const double north = at[columns] + u.fraction * (at[columns + 1] - at[columns]);
  return south + v.fraction * (north - south);
}

void AddDisplacedColumns(const TriangleMesh& mesh, Vec3d centre_of_mass_m, const Pose& pose,
                         const HeightPatch& surface, const sea::CellRect& cells,
                         std::span<float> head_m, double share) {
  ONESEA_CHECK(head_m.size() == cells.cells() && cells.columns >= 2 && cells.rows >= 2);
  const Mat3d turn = ToMatrix(pose.turn);
  std::vector<Corner> corners;
  corners.reserve(mesh.vertices.size());
  for (const Vec3d& vertex : mesh.vertices) {
    const Vec3d place = pose.centre_m + turn * (vertex - centre_of_mass_m);
    corners.push_back({place.x, place.y, surface.At(place.x, place.y) - place.z});
  }
  Spreader spreader(cells, head_m, share);
  for (const auto& [a, b, c] : mesh.triangles) {
    AddTriangle({corners[a], corners[b], corners[c]}, spreader);
  }
}

}  // namespace onesea::world
