#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "common/sea/point_query.h"
#include "hwy/targets.h"
#include "tests/sea/fake_sea.h"

namespace onesea::sea {
namespace {

// Oracle: Airy theory in double by libm, in its textbook form with cosh and sinh.
DepthSample AirySum(const Components& sea, SimTime time, Vec2d x, double below_m) {
  const double h = sea.recipe.depth_m;
  DepthSample sum;
  sum.velocity_m_per_s = {sea.recipe.current_m_per_s.x, sea.recipe.current_m_per_s.y, 0};
  for (const CascadeComponents& waves : sea.cascades) {
    for (std::size_t n = 0; n < waves.i.size(); ++n) {
      const double unit = 2 * kPi / waves.cascade.length_m;
      const double c = std::cos(waves.cascade.rotation_rad),
                   s = std::sin(waves.cascade.rotation_rad);
      const double kx = unit * (c * waves.i[n] - s * waves.j[n]);
      const double ky = unit * (s * waves.i[n] + c * waves.j[n]);
      const double k = std::hypot(kx, ky);
      const double turns =
          waves.phase_turns[n] * 0x1p-32 -
          static_cast<double>(waves.turns_per_flick[n] * static_cast<std::uint64_t>(time.flicks)) *
              0x1p-64;
      const double phase = kx * x.x + ky * x.y + 2 * kPi * turns;
      const double a = std::sqrt(2.0 * waves.variance_m2[0][n]);
      const double sigma = Sigma(k, h);
      const double z = -below_m;
      const double horizontal = h > 0 ? std::cosh(k * (z + h)) / std::sinh(k * h) : std::exp(k * z);
      const double vertical = h > 0 ? std::sinh(k * (z + h)) / std::sinh(k * h) : std::exp(k * z);
      const double level = h > 0 ? std::cosh(k * (z + h)) / std::cosh(k * h) : std::exp(k * z);
      sum.velocity_m_per_s.x += a * sigma * horizontal * kx / k * std::cos(phase);
      sum.velocity_m_per_s.y += a * sigma * horizontal * ky / k * std::cos(phase);
      sum.velocity_m_per_s.z += a * sigma * vertical * std::sin(phase);
      sum.dynamic_pressure_pa += kWaterDensityKgPerM3 * kGravity * a * level * std::cos(phase);
    }
  }
  return sum;
}

TEST(DepthQuery, IsAiryTheory) {
  for (const double water_m : {0.0, 25.0, 4.0}) {
    const auto sea = FakeSea({.lengths_m = {613.0, 171.0, 47.0},
                              .index_max = 20,
                              .hs_m = 1.0,
                              .depth_m = water_m,
                              .current_m_per_s = {0.5, 0.25}});
    const SimTime time = SimTime::FromSeconds(4321.5);
    for (const double below_m : {0.0, 0.7, 3.9, 20.0}) {
      if (water_m > 0 && below_m > water_m) continue;
      const std::vector<Vec2d> points = {{0, 0}, {17.25, -33.0}, {400.0, 900.0}};
      const std::vector<double> depths(points.size(), below_m);
      std::vector<DepthSample> out(points.size());
      SampleAtDepth(*sea, time, points, depths, out);
      for (std::size_t n = 0; n < points.size(); ++n) {
        const DepthSample want = AirySum(*sea, time, points[n], below_m);
        // 3700 terms in float against an RMS of the order of 1 m/s and 1 m.
        EXPECT_NEAR(out[n].velocity_m_per_s.x, want.velocity_m_per_s.x, 2e-5);
        EXPECT_NEAR(out[n].velocity_m_per_s.y, want.velocity_m_per_s.y, 2e-5);
        EXPECT_NEAR(out[n].velocity_m_per_s.z, want.velocity_m_per_s.z, 2e-5);
        EXPECT_NEAR(out[n].dynamic_pressure_pa, want.dynamic_pressure_pa, 0.1);
      }
    }
  }
}

// At z = 0 the depth query and the velocity of the direct sum are the same wave.
TEST(DepthQuery, MeetsTheSurfaceAtZeroDepthFarOut) {
  const auto sea = FakeSea({.depth_m = 30.0});
  const SimTime time = SimTime::FromSeconds(3.0e8);  // ten years
  const std::vector<Vec2d> points = {{1.0e6, -2.0e6}, {-3.5e5, 12.0}};
  const std::vector<double> depths = {0.0, 0.0};
  std::vector<DepthSample> out(2);
  SampleAtDepth(*sea, time, points, depths, out);
  for (std::size_t n = 0; n < points.size(); ++n) {
    const DirectSample want = SumDirectly(*sea, time, points[n]);
    EXPECT_NEAR(out[n].velocity_m_per_s.x, want.velocity_m_per_s.x, 5e-5);
    EXPECT_NEAR(out[n].velocity_m_per_s.z, want.velocity_m_per_s.z, 5e-5);
    EXPECT_NEAR(out[n].dynamic_pressure_pa / (kWaterDensityKgPerM3 * kGravity), want.height_m,
                5e-5);
  }
}

TEST(DepthQuery, HasTheSameBitsOnEverySimdTarget) {
  const auto sea = FakeSea({.depth_m = 12.0});
  const std::vector<Vec2d> points = {{3.0, 4.0}, {-1e5, 77.7}};
  const std::vector<double> depths = {0.5, 6.0};
  std::vector<DepthSample> first;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    std::vector<DepthSample> out(2);
    SampleAtDepth(*sea, SimTime{123456789}, points, depths, out);
    if (first.empty()) first = out;
    for (int n = 0; n < 2; ++n) {
      EXPECT_EQ(out[n].velocity_m_per_s, first[n].velocity_m_per_s) << hwy::TargetName(target);
      EXPECT_EQ(out[n].dynamic_pressure_pa, first[n].dynamic_pressure_pa)
          << hwy::TargetName(target);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST(DepthQueryDeathTest, RefusesNaN) {
  const auto sea = FakeSea();
  const std::vector<Vec2d> points = {{NAN, 0.0}};
  const std::vector<double> depths = {1.0};
  std::vector<DepthSample> out(1);
  EXPECT_DEATH(SampleAtDepth(*sea, SimTime{}, points, depths, out), "nan");
}

}  // namespace
}  // namespace onesea::sea
