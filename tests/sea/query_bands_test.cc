// The bands of a snapshot against the direct sum over each cascade by itself.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "common/sea/point_query.h"
#include "tests/sea/fake_sea.h"

namespace onesea::sea {
namespace {

std::vector<Vec2d> RandomPoints(int count) {
  std::uint64_t random = 7;
  std::vector<Vec2d> points;
  for (int n = 0; n < count; ++n) {
    points.push_back({2000 * NextUnit(random) - 1000, 2000 * NextUnit(random) - 1000});
  }
  return points;
}

// The waves of one band alone.
std::shared_ptr<Components> Only(const Components& sea, int band) {
  auto one = std::make_shared<Components>(sea);
  const int cascades = static_cast<int>(sea.cascades.size());
  for (int c = 0; c < cascades; ++c) {
    if (c == band) continue;
    for (auto& variance : one->cascades[static_cast<std::size_t>(c)].variance_m2) {
      variance.assign(variance.size(), 0.0f);
    }
  }
  if (band < cascades) one->regular.clear();
  return one;
}

TEST(QueryBands, EachIsTheDirectSumOverItsWaves) {
  for (const bool with_regular : {false, true}) {
    const std::shared_ptr<Components> sea = FakeSea({.hs_m = 1.0});
    if (with_regular) {
      RegularComponent wave;
      wave.kx_rad_per_m = 0.3;
      wave.ky_rad_per_m = -0.1;
      wave.intrinsic_rad_per_s = Sigma(std::hypot(0.3, 0.1), 0.0);
      wave.turns_per_flick = static_cast<std::uint64_t>(std::ldexp(
          wave.intrinsic_rad_per_s / (2 * kPi) / static_cast<double>(kFlicksPerSecond), 64));
      wave.variance_m2 = {0.02};
      sea->regular.push_back(wave);
    }
    const SimTime time = SimTime::FromSeconds(12.25);
    const auto snapshot = SnapshotBuilder(sea).At(time, QueryDetail::kVelocity);
    const std::vector<Vec2d> points = RandomPoints(150);
    const auto bands = static_cast<std::size_t>(snapshot->bands());
    ASSERT_EQ(bands, sea->cascades.size() + (with_regular ? 1 : 0));
    std::vector<float> out(points.size() * bands * 4);
    snapshot->SampleBands(points, out);
    std::vector<SurfaceSample> samples(points.size());
    snapshot->Sample(points, samples);
    for (std::size_t b = 0; b < bands; ++b) {
      const auto alone = Only(*sea, static_cast<int>(b));
      for (std::size_t n = 0; n < points.size(); n += 3) {
        const Vec2d undisplaced = {points[n].x - samples[n].displacement_x_m,
                                   points[n].y - samples[n].displacement_y_m};
        const DirectSample direct = SumDirectly(*alone, time, undisplaced);
        const float* band = &out[(n * bands + b) * 4];
        EXPECT_NEAR(band[0], direct.height_m, 2e-3) << b << " " << n;
        EXPECT_NEAR(band[1], direct.velocity_m_per_s.x, 4e-3) << b << " " << n;
        EXPECT_NEAR(band[2], direct.velocity_m_per_s.y, 4e-3) << b << " " << n;
        EXPECT_NEAR(band[3], direct.velocity_m_per_s.z, 4e-3) << b << " " << n;
      }
    }
    for (std::size_t n = 0; n < points.size(); ++n) {
      double sum = 0.0;
      for (std::size_t b = 0; b < bands; ++b) sum += out[(n * bands + b) * 4];
      EXPECT_NEAR(sum, samples[n].height_m, 2e-3);
    }
  }
}

TEST(QueryBands, WavenumberIsTheMeanByVariance) {
  Components sea;
  sea.recipe.timeline.resize(1);
  CascadeComponents waves;
  waves.cascade = {.length_m = 100, .wavenumber_min_rad_per_m = 0.1, .wavenumber_max_rad_per_m = 1};
  waves.i = {1, 2};
  waves.j = {0, 0};
  waves.kx_rad_per_m = {0.3f, 0.0f};
  waves.ky_rad_per_m = {0.4f, 0.9f};
  waves.variance_m2 = {{3.0f, 1.0f}};
  sea.cascades = {waves, waves};
  sea.cascades[1].variance_m2 = {{0.0f, 0.0f}};
  const std::vector<double> k = BandWavenumbers(sea, SimTime{});
  ASSERT_EQ(k.size(), 2u);
  EXPECT_NEAR(k[0], (3 * 0.5 + 0.9) / 4, 1e-6);
  EXPECT_NEAR(k[1], std::sqrt(0.1), 1e-6);  // empty: the middle of its band
}

}  // namespace
}  // namespace onesea::sea
