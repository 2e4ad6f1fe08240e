#include "common/sea/surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "common/base/hash.h"
#include "common/sea/fft_strip.h"
#include "common/sea/point_query.h"
#include "hwy/targets.h"
#include "tests/sea/fake_sea.h"

namespace onesea::sea {
namespace {

constexpr FieldSet kAllFields = kRenderFields | kVelocityFields;

double FieldOf(const DirectSample& s, Field field) {
  switch (field) {
    case Field::kHeight:
      return s.height_m;
    case Field::kDisplacementX:
      return s.displacement_x_m;
    case Field::kDisplacementY:
      return s.displacement_y_m;
    case Field::kSlopeX:
      return s.slope_x;
    case Field::kSlopeY:
      return s.slope_y;
    case Field::kJacobianXX:
      return s.jacobian_xx;
    case Field::kJacobianYY:
      return s.jacobian_yy;
    case Field::kJacobianXY:
      return s.jacobian_xy;
    case Field::kVelocityX:
      return s.velocity_m_per_s.x;
    case Field::kVelocityY:
      return s.velocity_m_per_s.y;
    case Field::kVelocityZ:
      return s.velocity_m_per_s.z;
  }
  return NAN;
}

Vec2d WorldOf(const Cascade& cascade, int n, int x, int y) {
  const double u = cascade.length_m * x / n, v = cascade.length_m * y / n;
  const double c = std::cos(cascade.rotation_rad), s = std::sin(cascade.rotation_rad);
  return {c * u - s * v, s * u + c * v};
}

double Rms(std::span<const float> plane) {
  double sum = 0;
  for (float v : plane) sum += double{v} * v;
  return std::sqrt(sum / static_cast<double>(plane.size()));
}

std::shared_ptr<Components> OneCascade(int index_max, double depth_m) {
  return FakeSea({.lengths_m = {171.0},
                  .index_max = index_max,
                  .depth_m = depth_m,
                  .current_m_per_s = {1.5, -0.5}});
}

// Oracle: the double sum over all waves at grid points, which shares no code with evolution and
// transform.
class SurfaceAgainstDirectSum : public testing::TestWithParam<std::tuple<int, int, TransformKind>> {
};

TEST_P(SurfaceAgainstDirectSum, EveryFieldAgrees) {
  const auto [n, index_max, kind] = GetParam();
  if (!TransformAvailable(kind)) GTEST_SKIP();
  const auto sea = OneCascade(index_max, 20.0);
  const SimTime time = SimTime::FromSeconds(12345.678);
  Synthesiser synthesiser(sea, 0, n, kAllFields, kind);
  CascadeFields fields(n, kAllFields);
  synthesiser.Evaluate(time, fields);
  EXPECT_EQ(synthesiser.OmittedVariance(time), 0.0);
  std::uint64_t random = 7;
  for (int sample = 0; sample < 40; ++sample) {
    const int x = static_cast<int>(NextRandom(random) % n),
              y = static_cast<int>(NextRandom(random) % n);
    const DirectSample want = SumDirectly(*sea, time, WorldOf(sea->recipe.cascades[0], n, x, y));
    for (int f = 0; f < kFieldCount; ++f) {
      const auto field = static_cast<Field>(f);
      const auto plane = fields.Plane(field);
      // Rounding of some thousand terms in float: 2e-6 of the RMS at the most seen; the k of the
      // factors is a float.
      EXPECT_NEAR(plane[y * n + x], FieldOf(want, field), 3e-6 * Rms(plane))
          << f << " at " << x << "," << y;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Sizes, SurfaceAgainstDirectSum,
    testing::Combine(testing::Values(64, 128, 256), testing::Values(3, 8, 20, 31),
                     testing::Values(TransformKind::kOwn, TransformKind::kFftw)));
INSTANTIATE_TEST_SUITE_P(Fold, SurfaceAgainstDirectSum,
                         testing::Values(std::tuple{256, 32, TransformKind::kOwn},
                                         std::tuple{512, 64, TransformKind::kOwn},
                                         std::tuple{1024, 128, TransformKind::kOwn},
                                         std::tuple{1024, 40, TransformKind::kFftw}));

}  // namespace
}  // namespace onesea::sea
