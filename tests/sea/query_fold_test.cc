#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "common/sea/point_query.h"
#include "tests/sea/fake_sea.h"
#include "tests/sea/fine_sea.h"

namespace onesea::sea {
namespace {

// Oracle: a fine mesh of undisplaced points, displaced; every triangle that covers a query point is
// a sheet.
class SheetMesh {
 public:
  SheetMesh(const FineSea& sea, double half_m, double step_m)
      : side_(static_cast<int>(2 * half_m / step_m) + 1), half_m_(half_m), bins_(kBins * kBins) {
    vertices_.reserve(static_cast<std::size_t>(side_) * side_);
    for (int j = 0; j < side_; ++j) {
      for (int i = 0; i < side_; ++i) {
        const double x = -half_m + i * step_m, y = -half_m + j * step_m;
        const FinePoint at = sea.At(x, y);
        vertices_.push_back({x + at.dx_m, y + at.dy_m, at.height_m});
      }
    }
    for (int j = 0; j + 1 < side_; ++j) {
      for (int i = 0; i + 1 < side_; ++i) {
        const int a = j * side_ + i;
        AddTriangle(a, a + 1, a + side_);
        AddTriangle(a + 1, a + side_ + 1, a + side_);
      }
    }
  }

  // Heights of all sheets over (x, y).
  std::vector<double> Sheets(Vec2d p) const {
    std::vector<double> heights;
    for (const auto& t : bins_[BinOf(p.y) * kBins + BinOf(p.x)]) {
      const Vec3d a = vertices_[t[0]], b = vertices_[t[1]], c = vertices_[t[2]];
      const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
      const double u = ((p.x - a.x) * (c.y - a.y) - (c.x - a.x) * (p.y - a.y)) / area;
      const double v = ((b.x - a.x) * (p.y - a.y) - (p.x - a.x) * (b.y - a.y)) / area;
      if (u >= 0 && v >= 0 && u + v <= 1)
        heights.push_back(a.z + u * (b.z - a.z) + v * (c.z - a.z));
    }
    return heights;
  }

 private:
  static constexpr int kBins = 200;
  int BinOf(double x) const {
    return std::clamp(static_cast<int>((x + half_m_) / (2 * half_m_) * kBins), 0, kBins - 1);
  }
  void AddTriangle(int a, int b, int c) {
    const auto [x0, x1] = std::minmax({vertices_[a].x, vertices_[b].x, vertices_[c].x});
    const auto [y0, y1] = std::minmax({vertices_[a].y, vertices_[b].y, vertices_[c].y});
    for (int y = BinOf(y0); y <= BinOf(y1); ++y) {
      for (int x = BinOf(x0); x <= BinOf(x1); ++x) bins_[y * kBins + x].push_back({a, b, c});
    }
  }
  int side_;
  double half_m_;
  std::vector<Vec3d> vertices_;
  std::vector<std::vector<std::array<int, 3>>> bins_;
};

// A sea so steep that crests fold over some per cent of the area.
TEST(QueryFolds, AreFlaggedAndTheTopSheetAnswers) {
  const auto sea = FakeSea(
      {.lengths_m = {171.0, 47.0, 13.0}, .hs_m = 5.0, .choppiness = 1.2, .peak_rad_per_m = 0.2});
  const SimTime time = SimTime::FromSeconds(50);
  const SheetMesh mesh(FineSea(sea, time), 15.0, 0.06);
  SnapshotBuilder builder(sea);
  const auto snapshot = builder.At(time, QueryDetail::kHeight);
  std::vector<Vec2d> points(8000);
  std::uint64_t random = 3;
  for (Vec2d& p : points) p = {22 * NextUnit(random) - 11, 22 * NextUnit(random) - 11};
  std::vector<SurfaceSample> out(points.size());
  snapshot->Sample(points, out);
  int folds = 0, missed = 0, invented = 0, lower = 0, unsolved = 0;
  for (std::size_t n = 0; n < points.size(); ++n) {
    const std::vector<double> sheets = mesh.Sheets(points[n]);
    ASSERT_FALSE(sheets.empty());
    const bool folded = sheets.size() > 1;
    folds += folded;
    missed += folded && !out[n].folded;
    invented += !folded && out[n].folded;
    if (out[n].folded)
      lower += out[n].height_m < *std::max_element(sheets.begin(), sheets.end()) - 0.15;
    unsolved += out[n].residual_m > 1e-3f;
  }
  std::printf("%d folds, %d missed, %d invented, %d not the top\n", folds, missed, invented, lower);
  EXPECT_GT(folds, 100);
  // The screening of the vectorised path is no proof: where waves of several scales fold at once it
  // accepts a lower sheet now and then (12 % of the folds of this extreme sea).
  EXPECT_LT(missed, 0.15 * folds);
  EXPECT_LT(invented, 0.05 * folds);
  EXPECT_LT(lower, 0.03 * folds);
  EXPECT_LT(unsolved, 0.1 * folds);
}

}  // namespace
}  // namespace onesea::sea
