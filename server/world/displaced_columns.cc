#include "server/world/displaced_columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "common/base/check.h"
#include "common/sea/constants.h"
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
// Distance of lumps: what spreads them has no ripple of a cell's length.
constexpr double kLumpCells = 1.0;

// Splits wetted pieces until they are small, and hands on the columns above them.
template <typename Take>
class Splitter {
 public:
  Splitter(double longest_m, const Take& take) : longest_m_(longest_m), take_(take) {}

  // The column between a wetted piece and the surface.
  void Add(const Corner& a, const Corner& b, const Corner& c, int splits) const {
    const double longest = std::max({Reach(a, b), Reach(b, c), Reach(c, a)});
    if (splits > 0 && longest > longest_m_) {
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
    take_((a.x + b.x + c.x) / 3.0, (a.y + b.y + c.y) / 3.0, volume);
  }

 private:
  static double Reach(const Corner& a, const Corner& b) {
    return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y));
  }
  double longest_m_;
  const Take& take_;
};

class Spreader {
 public:
  Spreader(const sea::CellRect& cells, std::span<float> head_m, double share)
      : cells_(cells),
        head_m_(head_m),
        share_(share),
        cells_per_m_(1.0 / cells.cell_m),
        west_m_(cells.PlaceOf(cells.west, cells.south).x),
        south_m_(cells.PlaceOf(cells.west, cells.south).y) {}

  void operator()(double x, double y, double volume_m3) const {
    const double column = (x - west_m_) * cells_per_m_, row = (y - south_m_) * cells_per_m_;
    if (!(column >= 1.0 && column < cells_.columns - 2 && row >= 1.0 && row < cells_.rows - 2)) {
      return;
    }
    // To the nearest; a tie may fall either way.
    // NOLINTNEXTLINE(bugprone-incorrect-roundings): both are positive
    const int i = static_cast<int>(column + 0.5), j = static_cast<int>(row + 0.5);
    const std::array<double, 3> u = Weights(column - i), v = Weights(row - j);
    const double head = share_ * volume_m3 * cells_per_m_ * cells_per_m_;
    for (int dj = 0; dj < 3; ++dj) {
      float* at = &head_m_[static_cast<std::size_t>(j + dj - 1) * cells_.columns + (i - 1)];
      for (int di = 0; di < 3; ++di) at[di] += static_cast<float>(v[dj] * u[di] * head);
    }
  }

 private:
  // Of the quadratic B-spline at offsets -1, 0, 1; t in [-1/2, 1/2].
  static std::array<double, 3> Weights(double t) {
    return {0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t, 0.5 * (0.5 + t) * (0.5 + t)};
  }

  const sea::CellRect& cells_;
  std::span<float> head_m_;
  double share_, cells_per_m_, west_m_, south_m_;
};

// The wetted part of a triangle, at most two pieces.
template <typename Take>
void AddTriangle(const std::array<Corner, 3>& triangle, const Splitter<Take>& splitter) {
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
  for (int n = 2; n < count; ++n) splitter.Add(wet[0], wet[n - 1], wet[n], kSplitsMax);
}

// Calls take(x, y, volume) for the columns of all wetted pieces.
template <typename Take>
void ForColumns(const TriangleMesh& mesh, Vec3d centre_of_mass_m, const Pose& pose,
                const HeightPatch& surface, double longest_m, const Take& take) {
  const Mat3d turn = ToMatrix(pose.turn);
  std::vector<Corner> corners;
  corners.reserve(mesh.vertices.size());
  for (const Vec3d& vertex : mesh.vertices) {
    const Vec3d place = pose.centre_m + turn * (vertex - centre_of_mass_m);
    corners.push_back({place.x, place.y, surface.At(place.x, place.y) - place.z});
  }
  const Splitter<Take> splitter(longest_m, take);
  for (const auto& [a, b, c] : mesh.triangles) {
    AddTriangle({corners[a], corners[b], corners[c]}, splitter);
  }
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
  const Spreader spreader(cells, head_m, share);
  ForColumns(mesh, centre_of_mass_m, pose, surface, kPieceCells * cells.cell_m, spreader);
}

namespace {

using LumpIndex = std::pair<std::int64_t, std::int64_t>;
using Lumps = std::map<LumpIndex, LumpedColumn>;  // places times volumes

void AddLump(double x, double y, double volume_m3, double lump_m, Lumps& lumps) {
  LumpedColumn& lump = lumps[{std::llround(x / lump_m), std::llround(y / lump_m)}];
  lump.x_m += x * volume_m3;
  lump.y_m += y * volume_m3;
  lump.volume_m3 += volume_m3;
}

// Share of a column of depth `h` that is seen `r` away on a square of side `lump_m`: the integral
// of (1/r - 1/√(r² + h²)) / 2πh, near the column in closed form.
double SeenAt(double r, double h, double lump_m) {
  const auto within = [&](double radius) {
    return (radius + h - std::sqrt(radius * radius + h * h)) / h;
  };
  if (r == 0.0) return within(lump_m / std::sqrt(sea::kPi));
  return lump_m * lump_m * (1.0 / r - 1.0 / std::sqrt(r * r + h * h)) / (2.0 * sea::kPi * h);
}

// As the surface sees what lies below it: three times a column's depth around. What it would see
// further off is spread evenly over that.
void AddSpread(double x, double y, double volume_m3, double lump_m, Lumps& lumps) {
  const double depth_m = volume_m3 / (lump_m * lump_m);
  const int reach = static_cast<int>(3.0 * depth_m / lump_m);
  if (!(depth_m > 0.0) || reach == 0) return AddLump(x, y, volume_m3, lump_m, lumps);
  const auto for_each = [&](const auto& use) {
    for (int j = -reach; j <= reach; ++j) {
      for (int i = -reach; i <= reach; ++i) {
        if (i * i + j * j > reach * reach) continue;
        use(i * lump_m, j * lump_m, SeenAt(lump_m * std::sqrt(i * i + j * j), depth_m, lump_m));
      }
    }
  };
  double seen = 0.0;
  int squares = 0;
  for_each([&](double, double, double share) {
    seen += share;
    ++squares;
  });
  const double rest = (1.0 - seen) / squares;
  for_each([&](double east, double north, double share) {
    AddLump(x + east, y + north, volume_m3 * (share + rest), lump_m, lumps);
  });
}

}  // namespace

std::vector<LumpedColumn> ColumnsAtRest(const TriangleMesh& mesh, Vec3d centre_of_mass_m,
                                        double centre_height_m, double cell_m) {
  const double lump_m = kLumpCells * cell_m;
  Lumps whole;
  const auto take = [&](double x, double y, double volume_m3) {
    AddLump(x, y, volume_m3, lump_m, whole);
  };
  ForColumns(mesh, centre_of_mass_m, {{0.0, 0.0, centre_height_m}, {}}, HeightPatch{},
             kPieceCells * cell_m, take);
  Lumps lumps;
  for (const auto& [index, lump] : whole) {
    if (lump.volume_m3 == 0.0) continue;
    AddSpread(lump.x_m / lump.volume_m3, lump.y_m / lump.volume_m3, lump.volume_m3, lump_m, lumps);
  }
  std::vector<LumpedColumn> columns;
  for (const auto& [index, lump] : lumps) {
    // Overhangs count down; where they leave nothing, there is no middle either.
    if (std::abs(lump.volume_m3) < 1e-9 * lump_m * lump_m * lump_m) continue;
    const double x = lump.x_m / lump.volume_m3, y = lump.y_m / lump.volume_m3;
    const double low_x = (static_cast<double>(index.first) - 0.5) * lump_m;
    const double low_y = (static_cast<double>(index.second) - 0.5) * lump_m;
    columns.push_back({std::clamp(x, low_x, low_x + lump_m), std::clamp(y, low_y, low_y + lump_m),
                       lump.volume_m3});
  }
  return columns;
}

void AddColumns(std::span<const LumpedColumn> columns, Vec2d place_m, const Quaternion& turn,
                const sea::CellRect& cells, std::span<float> head_m, double share) {
  ONESEA_CHECK(head_m.size() == cells.cells() && cells.columns >= 2 && cells.rows >= 2);
  const Spreader spread(cells, head_m, share);
  const double cosine = turn.w * turn.w - turn.z * turn.z, sine = 2.0 * turn.w * turn.z;
  for (const LumpedColumn& column : columns) {
    spread(place_m.x + cosine * column.x_m - sine * column.y_m,
           place_m.y + sine * column.x_m + cosine * column.y_m, column.volume_m3);
  }
}

}  // namespace onesea::world
