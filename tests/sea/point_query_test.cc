#include "common/sea/point_query.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hwy/targets.h"
#include "tests/sea/fake_sea.h"
#include "tests/sea/fine_sea.h"

namespace onesea::sea {
namespace {

// Oracle: p + D(p) = x solved on the direct sum by Newton steps with its own Jacobian.
struct Inverted {
  DirectSample at;
  Vec2d p;
  double miss_m = 0;
};
Inverted InvertDirectly(const Components& sea, SimTime time, Vec2d x, Vec2d start) {
  Inverted r;
  r.p = start;
  for (int n = 0; n < 30; ++n) {
    r.at = SumDirectly(sea, time, r.p);
    const Vec2d miss = {r.p.x + r.at.displacement_x_m - x.x, r.p.y + r.at.displacement_y_m - x.y};
    r.miss_m = Norm(miss);
    if (r.miss_m < 1e-9) break;
    const double a = 1 + r.at.jacobian_xx, b = r.at.jacobian_xy, d = 1 + r.at.jacobian_yy,
                 det = a * d - b * b;
    r.p = r.p - Vec2d{(d * miss.x - b * miss.y) / det, (a * miss.y - b * miss.x) / det};
  }
  return r;
}

std::vector<Vec2d> RandomPoints(int count, double extent_m, Vec2d centre = {}) {
  std::uint64_t random = 99;
  std::vector<Vec2d> points(count);
  for (Vec2d& p : points) {
    p.x = centre.x + extent_m * (NextUnit(random) - 0.5);
    p.y = centre.y + extent_m * (NextUnit(random) - 0.5);
  }
  return points;
}

TEST(PointQuery, AgreesWithTheInvertedDirectSum) {
  const auto sea = FakeSea({.hs_m = 1.0});
  const SimTime time = SimTime::FromSeconds(321.0);
  SnapshotBuilder builder(sea);
  const auto snapshot = builder.At(time, QueryDetail::kVelocity);
  for (const Vec2d centre : {Vec2d{}, Vec2d{1e6, -7e5}}) {
    const auto points = RandomPoints(200, 1000.0, centre);
    std::vector<SurfaceSample> out(points.size());
    snapshot->Sample(points, out);
    for (std::size_t n = 0; n < points.size(); ++n) {
      const Vec2d p0 = {points[n].x - out[n].displacement_x_m,
                        points[n].y - out[n].displacement_y_m};
      const Inverted want = InvertDirectly(*sea, time, points[n], p0);
      ASSERT_LT(want.miss_m, 1e-6);
      if (out[n].folded) continue;
      EXPECT_NEAR(out[n].height_m, want.at.height_m, 0.02) << n;
      EXPECT_NEAR(out[n].velocity_z_m_per_s, want.at.velocity_m_per_s.z, 0.1) << n;
      EXPECT_LT(out[n].residual_m, 1e-3) << n;
    }
  }
}

// The claim: a million points, none beyond the bound. The oracle is FineSea, checked
// against the direct sum here.
TEST(PointQuery, ErrorBoundHoldsForAMillionPoints) {
  const auto sea = FakeSea({.hs_m = 2.0});
  const SimTime time = SimTime::FromSeconds(77.0);
  const FineSea fine(sea, time);
  SnapshotBuilder builder(sea);
  const auto snapshot = builder.At(time, QueryDetail::kHeight);
  const auto points = RandomPoints(1'000'000, 3000.0);
  std::vector<SurfaceSample> out(points.size());
  snapshot->Sample(points, out);
  double worst_m = 0, sum2 = 0;
  int folded = 0, checked = 0;
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (out[n].folded) {
      ++folded;
      continue;
    }
    double px = points[n].x - out[n].displacement_x_m, py = points[n].y - out[n].displacement_y_m;
    FinePoint at;
    ASSERT_LT(fine.Invert(points[n].x, points[n].y, px, py, at), 1e-5) << n;
    const double error_m = std::abs(out[n].height_m - at.height_m);
    worst_m = std::max(worst_m, error_m);
    sum2 += error_m * error_m;
    if (n % 20000 == 0) {
      const Inverted exact = InvertDirectly(*sea, time, points[n], {px, py});
      ASSERT_NEAR(at.height_m, exact.at.height_m, 2e-4);
      ++checked;
    }
  }
  std::printf("bound %.4f m, worst %.4f m, rms %.5f m, %d folded\n", snapshot->HeightErrorBound(),
              worst_m, std::sqrt(sum2 / static_cast<double>(points.size())), folded);
  EXPECT_LT(worst_m, snapshot->HeightErrorBound());
  // The bound is not idle either.
  EXPECT_GT(worst_m, 0.3 * snapshot->HeightErrorBound());
  EXPECT_LT(folded, 10);
  EXPECT_GE(checked, 49);
}

}  // namespace
}  // namespace onesea::sea
