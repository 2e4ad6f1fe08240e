// Point queries over terrain, against the definition: the sum over cascades, each multiplied by the
// factor at the place that was asked for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/sea/attenuation.h"
#include "common/sea/point_query.h"
#include "hwy/targets.h"
#include "tests/sea/fake_sea.h"

namespace onesea::sea {
namespace {

constexpr SimTime kTime{kFlicksPerSecond * 321};

// A bottom that rises from 30 m to a shore in the east, an island, a wall with a gap.
std::shared_ptr<const Terrain> Shore() {
  constexpr int kSide = 121;
  auto terrain = std::make_shared<Terrain>();
  *terrain = {.west_m = -600,
              .south_m = -600,
              .cell_m = 10,
              .columns = kSide,
              .rows = kSide,
              .elevation_m = {}};
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const double x = -600.0 + 10.0 * i, y = -600.0 + 10.0 * j;
      double e = -30.0 + 33.0 * std::clamp((x + 400.0) / 900.0, 0.0, 1.0);
      e = std::max(e, 4.0 - 0.1 * std::hypot(x + 100.0, y - 200.0));
      if (std::abs(x - 200.0) < 12.0 && std::abs(y) > 60.0) e = 2.5;
      terrain->elevation_m.push_back(static_cast<float>(e));
    }
  }
  return terrain;
}

std::shared_ptr<const Components> ShoreSea(bool with_regular = true) {
  const auto sea = FakeSea({.hs_m = 1.5, .depth_m = 30.0, .query_grid_size = 256});
  if (with_regular) {
    RegularComponent wave;
    wave.kx_rad_per_m = 0.08;
    wave.ky_rad_per_m = -0.05;
    wave.intrinsic_rad_per_s = Sigma(std::hypot(wave.kx_rad_per_m, wave.ky_rad_per_m), 30.0);
    wave.turns_per_flick = TurnsPerFlick(wave.intrinsic_rad_per_s);
    wave.phase_turns = std::uint64_t{0x3456789a} << 32;
    wave.variance_m2 = {0.02};
    sea->regular.push_back(wave);
  }
  return OverTerrain(sea, Shore());
}

std::vector<Vec2d> Places(int count) {
  std::uint64_t random = 4;
  std::vector<Vec2d> places;
  for (int n = 0; n < count; ++n) {
    places.push_back({1400 * NextUnit(random) - 700, 1400 * NextUnit(random) - 700});
  }
  return places;
}

// The oracle: direct sums over each plane's waves alone, and the factors of the grid.
class BruteForce {
 public:
  explicit BruteForce(const Components& sea)
      : grid_(sea.attenuation->At(WeatherWeights(sea.recipe, kTime))) {
    for (std::size_t plane = 0; plane <= sea.cascades.size(); ++plane) {
      Components& one = planes_.emplace_back(sea);
      for (std::size_t c = 0; c < one.cascades.size(); ++c) {
        if (c == plane) continue;
        CascadeComponents nothing;
        nothing.cascade = one.cascades[c].cascade;
        nothing.variance_m2.resize(1);
        one.cascades[c] = std::move(nothing);
      }
      if (plane < sea.cascades.size()) one.regular.clear();
    }
    if (sea.regular.empty()) planes_.pop_back();
  }

  DirectSample At(Vec2d place, Vec2d undisplaced) const {
    DirectSample sum;
    for (std::size_t plane = 0; plane < planes_.size(); ++plane) {
      const double factor = grid_.At(place, static_cast<int>(plane));
      const DirectSample one = SumDirectly(planes_[plane], kTime, undisplaced);
      sum.height_m += factor * one.height_m;
      sum.displacement_x_m += factor * one.displacement_x_m;
      sum.displacement_y_m += factor * one.displacement_y_m;
      sum.slope_x += factor * one.slope_x;
      sum.slope_y += factor * one.slope_y;
      sum.jacobian_xx += factor * one.jacobian_xx;
      sum.jacobian_yy += factor * one.jacobian_yy;
      sum.jacobian_xy += factor * one.jacobian_xy;
      sum.velocity_m_per_s = sum.velocity_m_per_s + factor * one.velocity_m_per_s;
    }
    return sum;
  }

  // p + D(p) = place by Newton steps from `p`.
  DirectSample Invert(Vec2d place, Vec2d p) const {
    DirectSample at;
    for (int n = 0; n < 30; ++n) {
      at = At(place, p);
      const Vec2d miss = {p.x + at.displacement_x_m - place.x, p.y + at.displacement_y_m - place.y};
      if (Norm(miss) < 1e-9) return at;
      const double a = 1 + at.jacobian_xx, b = at.jacobian_xy, d = 1 + at.jacobian_yy,
                   det = a * d - b * b;
      p = p - Vec2d{(d * miss.x - b * miss.y) / det, (a * miss.y - b * miss.x) / det};
    }
    ADD_FAILURE() << "no undisplaced point for " << place.x << ' ' << place.y;
    return at;
  }

 private:
  AttenuationGrid grid_;
  std::vector<Components> planes_;
};

TEST(ShoreQuery, IsTheSumOfCascadesTimesTheirFactors) {
  for (const bool with_regular : {false, true}) {
    const auto sea = ShoreSea(with_regular);
    const BruteForce oracle(*sea);
    const auto snapshot = SnapshotBuilder(sea).At(kTime, QueryDetail::kVelocity);
    ASSERT_NE(snapshot->attenuation(), nullptr);
    const auto places = Places(250);
    std::vector<SurfaceSample> out(places.size());
    snapshot->Sample(places, out);
    double worst_m = 0.0, highest_m = 0.0;
    for (std::size_t n = 0; n < places.size(); ++n) {
      if (out[n].folded) continue;
      const DirectSample want = oracle.Invert(places[n], {places[n].x - out[n].displacement_x_m,
                                                          places[n].y - out[n].displacement_y_m});
      worst_m = std::max(worst_m, std::abs(out[n].height_m - want.height_m));
      highest_m = std::max(highest_m, std::abs(want.height_m));
      EXPECT_NEAR(out[n].velocity_x_m_per_s, want.velocity_m_per_s.x, 0.005) << n;
      EXPECT_NEAR(out[n].velocity_z_m_per_s, want.velocity_m_per_s.z, 0.005) << n;
      // The normal is perpendicular to the displaced surface's tangents.
      EXPECT_NEAR(out[n].normal_x * (1 + want.jacobian_xx) + out[n].normal_y * want.jacobian_xy +
                      out[n].normal_z * want.slope_x,
                  0.0, 0.01);
      EXPECT_LT(out[n].residual_m, 5e-4) << n;
    }
    EXPECT_LT(worst_m, snapshot->HeightErrorBound());
    EXPECT_LT(snapshot->HeightErrorBound(), 0.004);
    EXPECT_GT(highest_m, 0.5);
  }
}

TEST(ShoreQuery, LandIsStill) {
  const auto sea = ShoreSea();
  const auto snapshot = SnapshotBuilder(sea).At(kTime, QueryDetail::kVelocity);
  const std::vector<Vec2d> land = {{-100, 200}, {595, 0}, {200, 300}, {900, 40}};
  std::vector<SurfaceSample> out(land.size());
  snapshot->Sample(land, out);
  for (const SurfaceSample& sample : out) {
    EXPECT_EQ(sample.height_m, 0.0f);
    EXPECT_EQ(sample.velocity_z_m_per_s, 0.0f);
    EXPECT_EQ(sample.normal_z, 1.0f);
  }
}

TEST(ShoreQuery, BandsAddUpToTheHeight) {
  const auto sea = ShoreSea();
  const auto snapshot = SnapshotBuilder(sea).At(kTime, QueryDetail::kVelocity);
  const auto places = Places(300);
  std::vector<SurfaceSample> samples(places.size());
  snapshot->Sample(places, samples);
  const auto bands = static_cast<std::size_t>(snapshot->bands());
  std::vector<float> out(places.size() * bands * 4);
  snapshot->SampleBands(places, out);
  for (std::size_t n = 0; n < places.size(); ++n) {
    double height_m = 0.0, rise_m_per_s = 0.0;
    for (std::size_t b = 0; b < bands; ++b) {
      height_m += out[4 * (n * bands + b)];
      rise_m_per_s += out[4 * (n * bands + b) + 3];
    }
    // Points of bands are found to about a centimetre; without factors both are off by decimetres.
    EXPECT_NEAR(height_m, samples[n].height_m, 5e-3) << n;
    EXPECT_NEAR(rise_m_per_s, samples[n].velocity_z_m_per_s, 1e-2) << n;
  }
}

// Server and clients may run on different machines and must agree exactly; the careful path for
// points near folds too (the sea is steep enough for some).
TEST(ShoreQuery, HasTheSameBitsOnEverySimdTarget) {
  const auto sea = ShoreSea();
  const auto places = Places(1333);
  std::vector<SurfaceSample> first;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    const auto snapshot = SnapshotBuilder(sea).At(kTime, QueryDetail::kVelocity);
    std::vector<SurfaceSample> out(places.size());
    snapshot->Sample(places, out);
    if (first.empty()) first = out;
    for (std::size_t n = 0; n < out.size(); ++n) {
      ASSERT_EQ(out[n].height_m, first[n].height_m) << hwy::TargetName(target);
      ASSERT_EQ(out[n].displacement_x_m, first[n].displacement_x_m);
      ASSERT_EQ(out[n].normal_y, first[n].normal_y);
      ASSERT_EQ(out[n].velocity_z_m_per_s, first[n].velocity_z_m_per_s);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST(ShoreQuery, DepthAnswersAreLoweredLikewise) {
  const auto sea = ShoreSea();
  const auto snapshot = SnapshotBuilder(sea).At(kTime, QueryDetail::kHeight);
  const auto places = Places(20);
  const std::vector<double> depths(places.size(), 2.5);
  std::vector<DepthSample> out(places.size()), open(places.size());
  SampleAtDepth(*sea, kTime, places, depths, out, snapshot->attenuation().get());
  const AttenuationGrid& grid = *snapshot->attenuation();
  std::vector<DepthSample> sum(places.size());
  for (int plane = 0; plane < grid.planes; ++plane) {
    Components one = *sea;
    for (std::size_t c = 0; c < one.cascades.size(); ++c) {
      if (static_cast<int>(c) == plane) continue;
      one.cascades[c].variance_m2[0].assign(one.cascades[c].variance_m2[0].size(), 0.0f);
    }
    if (plane < static_cast<int>(one.cascades.size())) one.regular.clear();
    SampleAtDepth(one, kTime, places, depths, open);
    for (std::size_t n = 0; n < places.size(); ++n) {
      const double factor = grid.At(places[n], plane);
      sum[n].dynamic_pressure_pa += factor * open[n].dynamic_pressure_pa;
      sum[n].velocity_m_per_s = sum[n].velocity_m_per_s + factor * open[n].velocity_m_per_s;
    }
  }
  for (std::size_t n = 0; n < places.size(); ++n) {
    EXPECT_NEAR(out[n].dynamic_pressure_pa, sum[n].dynamic_pressure_pa, 0.05) << n;
    EXPECT_NEAR(out[n].velocity_m_per_s.z, sum[n].velocity_m_per_s.z, 1e-5) << n;
  }
}

// The grid changes with the weather alone, and at whole seconds of sea time.
TEST(MovingAttenuation, IsTheSameObjectUntilTheWeatherMoves) {
  auto changing = FakeSea({.lengths_m = {171.0, 47.0}, .hs_m = 1.0, .depth_m = 30.0});
  changing->recipe.tick_rate_hz = 60;
  changing->recipe.timeline.push_back({600, 600, {}});
  for (auto& cascade : changing->cascades) {
    cascade.variance_m2.push_back(cascade.variance_m2[0]);
    for (float& v : cascade.variance_m2[1]) v *= 9.0f;
  }
  const auto sea = OverTerrain(changing, Shore());
  MovingAttenuation moving(sea);
  const auto at = [&](double time_s) { return moving.At(SimTime::FromSeconds(time_s)); };
  const auto calm = at(-5.25);
  EXPECT_EQ(at(3.0), calm);
  EXPECT_EQ(at(10.9), calm);
  const auto turning = at(15.0);
  EXPECT_NE(turning, calm);
  EXPECT_EQ(at(15.99), turning);
  EXPECT_NE(*at(16.0), *turning);
  const auto rough = at(20.0);
  EXPECT_EQ(at(1e6), rough);
  EXPECT_EQ(*MovingAttenuation(sea).At(SimTime::FromSeconds(15.5)), *turning);
  // Higher waves break in deeper water.
  EXPECT_LT(rough->At({350, 0}, 0), calm->At({350, 0}, 0));
  EXPECT_EQ(MovingAttenuation(FakeSea({.lengths_m = {171.0}})).At(SimTime{}), nullptr);
}

}  // namespace
}  // namespace onesea::sea
