#include "common/sea/point_query.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hwy/targets.h"
#include "tests/sea/allocation_count.h"
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
      EXPECT_NEAR(out[n].height_m, want.at.height_m, snapshot->HeightErrorBound()) << n;
      EXPECT_NEAR(out[n].velocity_z_m_per_s, want.at.velocity_m_per_s.z, 0.005) << n;
      EXPECT_LT(out[n].residual_m, 5e-4) << n;
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
  // The bound is not idle either, most of it being the inversion's share of 1 mm.
  EXPECT_GT(worst_m, 0.1 * snapshot->HeightErrorBound());
  EXPECT_LT(snapshot->HeightErrorBound(), 0.002);
  EXPECT_LT(folded, 10);
  EXPECT_GE(checked, 49);
}

std::shared_ptr<Components> SeaWithRegularWave() {
  const auto sea = FakeSea(
      {.lengths_m = {171.0, 47.0}, .hs_m = 0.3, .depth_m = 20.0, .current_m_per_s = {0.7, 0.0}});
  RegularComponent wave;
  wave.kx_rad_per_m = 0.08;
  wave.ky_rad_per_m = -0.05;
  wave.intrinsic_rad_per_s = Sigma(std::hypot(wave.kx_rad_per_m, wave.ky_rad_per_m), 20.0);
  wave.turns_per_flick = TurnsPerFlick(wave.intrinsic_rad_per_s + 0.7 * wave.kx_rad_per_m);
  wave.phase_turns = std::uint64_t{0x3456789a} << 32;
  wave.variance_m2 = {0.32};
  sea->regular.push_back(wave);
  return sea;
}

// Regular waves lie off the lattice: queries and the direct sum add them per point, without
// interpolation.
TEST(PointQuery, ContainsRegularWavesYearsAway) {
  const auto sea = SeaWithRegularWave();
  SnapshotBuilder builder(sea);
  const SimTime time = SimTime::FromSeconds(1.0e8);
  const auto snapshot = builder.At(time, QueryDetail::kVelocity);
  const auto points = RandomPoints(100, 500.0, {3e5, 8e5});
  std::vector<SurfaceSample> out(points.size());
  snapshot->Sample(points, out);
  for (std::size_t n = 0; n < points.size(); ++n) {
    const Vec2d start = {points[n].x - out[n].displacement_x_m,
                         points[n].y - out[n].displacement_y_m};
    const Inverted want = InvertDirectly(*sea, time, points[n], start);
    ASSERT_LT(want.miss_m, 1e-6);
    EXPECT_NEAR(out[n].height_m, want.at.height_m, snapshot->HeightErrorBound());
    EXPECT_NEAR(out[n].velocity_x_m_per_s, want.at.velocity_m_per_s.x + 0.7, 0.002);
    EXPECT_NEAR(out[n].velocity_z_m_per_s, want.at.velocity_m_per_s.z, 0.002);
    // The normal is perpendicular to the displaced surface's tangents.
    const double txx = 1 + want.at.jacobian_xx, txy = want.at.jacobian_xy;
    EXPECT_NEAR(out[n].normal_x * txx + out[n].normal_y * txy + out[n].normal_z * want.at.slope_x,
                0.0, 0.002);
  }
}

// Server and clients may run on different machines and must agree exactly.
TEST(PointQuery, HasTheSameBitsOnEverySimdTarget) {
  const auto sea = SeaWithRegularWave();
  const auto points = RandomPoints(333, 5000.0, {-1e6, 2e6});
  std::vector<SurfaceSample> first;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    SnapshotBuilder builder(sea);
    const auto snapshot = builder.At(SimTime::FromSeconds(5e6), QueryDetail::kVelocity);
    std::vector<SurfaceSample> out(points.size());
    snapshot->Sample(points, out);
    if (first.empty()) first = out;
    for (std::size_t n = 0; n < out.size(); ++n) {
      ASSERT_EQ(out[n].height_m, first[n].height_m) << hwy::TargetName(target);
      ASSERT_EQ(out[n].displacement_x_m, first[n].displacement_x_m);
      ASSERT_EQ(out[n].residual_m, first[n].residual_m);
      ASSERT_EQ(out[n].normal_y, first[n].normal_y);
      ASSERT_EQ(out[n].velocity_z_m_per_s, first[n].velocity_z_m_per_s);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST(PointQuery, SampleAllocatesNothingAndSnapshotsAreRecycled) {
  const auto sea = FakeSea();
  SnapshotBuilder builder(sea);
  auto snapshot = builder.At(SimTime{}, QueryDetail::kNormal);
  const auto points = RandomPoints(1000, 3000.0);
  std::vector<SurfaceSample> out(points.size());
  snapshot->Sample(points, out);
  const std::int64_t before = AllocationCount();
  snapshot->Sample(points, out);
  EXPECT_EQ(AllocationCount(), before);
  // A recycled snapshot answers as a new one does.
  const SimTime later = SimTime::FromSeconds(4.5);
  const auto fresh = SnapshotBuilder(sea).At(later, QueryDetail::kNormal);
  snapshot = builder.At(later, QueryDetail::kNormal, std::move(snapshot));
  std::vector<SurfaceSample> again(points.size());
  snapshot->Sample(points, out);
  fresh->Sample(points, again);
  for (std::size_t n = 0; n < points.size(); ++n) ASSERT_EQ(out[n].height_m, again[n].height_m);
}

TEST(PointQueryDeathTest, RefusesNaN) {
  SnapshotBuilder builder(FakeSea({.lengths_m = {50.0}}));
  const auto snapshot = builder.At(SimTime{}, QueryDetail::kHeight);
  std::vector<SurfaceSample> out(1);
  EXPECT_DEATH(snapshot->Sample(std::vector<Vec2d>{{NAN, 0.0}}, out), "point");
  EXPECT_DEATH(snapshot->Sample(std::vector<Vec2d>{{0.0, INFINITY}}, out), "point");
}

}  // namespace
}  // namespace onesea::sea
