#include "common/sea/point_query.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hwy/targets.h"
#include "tests/sea/fake_sea.h"

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

}  // namespace
}  // namespace onesea::sea
