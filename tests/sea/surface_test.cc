#include "common/sea/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/base/hash.h"
#include "common/sea/dispersion.h"
#include "common/sea/fft_strip.h"
#include "common/sea/point_query.h"
#include "hwy/targets.h"
#include "tests/sea/allocation_count.h"
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

std::vector<std::int64_t> Targets() { return hwy::SupportedAndGeneratedTargets(); }

std::uint64_t HashOf(const CascadeFields& fields) {
  Hash64 hash;
  for (int f = 0; f < kFieldCount; ++f) {
    for (const float v : fields.Plane(static_cast<Field>(f))) hash.Add(v);
  }
  return hash.value();
}

// The contract: with the own transform every plane has the same bits whatever the vector width. The
// constant is the hash on x86-64; it may change only with a new kSeaModelVersion.
TEST(Surface, HasTheSameBitsOnEverySimdTarget) {
  const auto sea = OneCascade(30, 15.0);
  std::vector<std::uint64_t> hashes;
  for (const std::int64_t target : Targets()) {
    hwy::SetSupportedTargetsForTest(target);
    Hash64 hash;
    for (const int n : {64, 128, 256}) {
      Synthesiser synthesiser(sea, 0, n, kAllFields);
      CascadeFields fields(n, kAllFields);
      synthesiser.Evaluate(SimTime::FromSeconds(987.654), fields);
      hash.Add(HashOf(fields));
    }
    hashes.push_back(hash.value());
    EXPECT_EQ(hashes.back(), hashes.front()) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
}

// Oracle: the definition of the transform, in double, on random spectra that are not Hermitian.
TEST(StripTransform, IsTheDefiningSum) {
  for (const int n : {64, 128, 256, 512, 1024}) {
    for (const int index_max : {5, n / 8, n / 2 - 1}) {
      StripTransform transform(n, index_max);
      const int side = 2 * index_max + 1, pitch = transform.Pitch();
      std::vector<float> re(side * pitch), im(re.size()), out_re(n * n), out_im(out_re.size());
      std::uint64_t random = 17;
      for (float& v : re) v = static_cast<float>(NextUnit(random) - 0.5);
      for (float& v : im) v = static_cast<float>(NextUnit(random) - 0.5);
      transform.Inverse(re.data(), im.data(), out_re.data(), out_im.data());
      for (int sample = 0; sample < 3; ++sample) {
        const int x = static_cast<int>(NextRandom(random) % n),
                  y = static_cast<int>(NextRandom(random) % n);
        double want_re = 0, want_im = 0;
        for (int i = -index_max; i <= index_max; ++i) {
          for (int j = -index_max; j <= index_max; ++j) {
            const double angle = 2 * kPi * ((i * x + j * y) % n) / n;
            const std::size_t at = (i + index_max) * pitch + j + index_max;
            want_re += re[at] * std::cos(angle) - im[at] * std::sin(angle);
            want_im += re[at] * std::sin(angle) + im[at] * std::cos(angle);
          }
        }
        const double rms = 0.41 * side;  // of a sum of side² terms of variance 1/6
        EXPECT_NEAR(out_re[y * n + x], want_re, 3e-6 * rms) << n << " " << index_max;
        EXPECT_NEAR(out_im[y * n + x], want_im, 3e-6 * rms) << n << " " << index_max;
      }
    }
  }
}

// Contract 2: a coarse and a fine grid hold the same waves; where points coincide so do the values.
TEST(Surface, ResolutionDoesNotMatterInTheSharedBand) {
  const auto sea = OneCascade(31, 0.0);
  const SimTime time = SimTime::FromSeconds(55.5);
  Synthesiser coarse(sea, 0, 64, kQueryFields), fine(sea, 0, 512, kQueryFields);
  CascadeFields a(64, kQueryFields), b(512, kQueryFields);
  coarse.Evaluate(time, a);
  fine.Evaluate(time, b);
  const auto h = a.Plane(Field::kHeight), g = b.Plane(Field::kHeight);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      ASSERT_NEAR(h[y * 64 + x], g[8 * y * 512 + 8 * x], 2e-6 * Rms(g));
    }
  }
}

// What a grid is too coarse for is reported: its variance and the omitted one make the whole.
// One-sided, since opposite waves interfere over the tile.
TEST(Surface, ReportsOmittedVariance) {
  const auto sea = FakeSea({.lengths_m = {171.0}, .index_max = 40, .one_sided = true});
  Synthesiser synthesiser(sea, 0, 64, Bit(Field::kHeight));
  CascadeFields fields(64, Bit(Field::kHeight));
  synthesiser.Evaluate(SimTime{}, fields);
  const double omitted = synthesiser.OmittedVariance(SimTime{});
  EXPECT_GT(omitted, 0.0);
  const double rms = Rms(fields.Plane(Field::kHeight));
  EXPECT_NEAR(rms * rms + omitted, VarianceAt(*sea, SimTime{}), 1e-5);
}

std::shared_ptr<Components> OneWave(int i, int j, double variance_m2) {
  auto sea = OneCascade(4, 0.0);
  auto& waves = sea->cascades[0];
  for (std::size_t n = 0; n < waves.i.size(); ++n) {
    waves.variance_m2[0][n] =
        waves.i[n] == i && waves.j[n] == j ? static_cast<float>(variance_m2) : 0.0f;
    waves.turns_per_flick[n] = TurnsPerFlick(waves.intrinsic_rad_per_s[n]);
  }
  return sea;
}

// Errata: the papers' sign lets energy run against k. A crest must move by +ω/k δt along k, and D
// must sharpen it: ∂D/∂x < 0 at a crest.
TEST(Surface, WavesTravelAlongKAndCrestsSharpen) {
  const auto sea = OneWave(2, 0, 0.5);
  const double k = 2 * 2 * kPi / 171.0, speed = std::sqrt(kGravity / k);
  Synthesiser synthesiser(sea, 0, 256, kRenderFields);
  CascadeFields now(256, kRenderFields), later(256, kRenderFields);
  const double cells_s = 171.0 / 256 / speed;  // time to travel one cell
  synthesiser.Evaluate(SimTime{}, now);
  synthesiser.Evaluate(SimTime::FromSeconds(10 * cells_s), later);
  const auto a = now.Plane(Field::kHeight), b = later.Plane(Field::kHeight);
  for (int x = 0; x < 256; ++x) EXPECT_NEAR(a[x], b[(x + 10) % 256], 0.01);
  const auto crest = std::max_element(a.begin(), a.begin() + 256) - a.begin();
  EXPECT_NEAR(a[crest], 1.0, 1e-3);
  EXPECT_NEAR(now.Plane(Field::kJacobianXX)[crest], -k, 1e-3 * k);
}

// Oracle: the particle of the choppy surface moves; at choppiness 1 in deep water (Gerstner) its
// velocity is d/dt of its displaced position.
TEST(Surface, VelocityIsTheTimeDerivativeOfDisplacementInDeepWater) {
  const auto sea = FakeSea({.lengths_m = {171.0}, .index_max = 20});
  constexpr double kStepS = 0.01;
  Synthesiser synthesiser(sea, 0, 64, kAllFields);
  CascadeFields before(64, kAllFields), now(64, kAllFields), after(64, kAllFields);
  synthesiser.Evaluate(SimTime::FromSeconds(9.0 - kStepS), before);
  synthesiser.Evaluate(SimTime::FromSeconds(9.0), now);
  synthesiser.Evaluate(SimTime::FromSeconds(9.0 + kStepS), after);
  const std::pair<Field, Field> pairs[] = {{Field::kVelocityX, Field::kDisplacementX},
                                           {Field::kVelocityY, Field::kDisplacementY},
                                           {Field::kVelocityZ, Field::kHeight}};
  for (const auto& [velocity, place] : pairs) {
    const auto v = now.Plane(velocity), p = after.Plane(place), m = before.Plane(place);
    // Second-order differences at ω <= 2.7 rad/s: (ω δt)²/6 = 1.2e-4; rounding of a difference of
    // floats 1e-4.
    for (std::size_t n = 0; n < v.size(); n += 7) {
      EXPECT_NEAR((p[n] - m[n]) / (2 * kStepS), v[n], 5e-4 * Rms(v) + 2e-4);
    }
  }
}

// A phase is a wrapping product, so a loop closes to the bit, and a century loses nothing.
TEST(Surface, LoopPeriodClosesAndACenturyLosesNothing) {
  auto sea = OneCascade(16, 0.0);
  for (std::uint64_t& f : sea->cascades[0].turns_per_flick) {
    // Frequencies as multiples of 1/64 s, rounded to 2⁻⁶⁴ turn per flick.
    const double cycles = std::nearbyint(static_cast<double>(static_cast<std::int64_t>(f)) *
                                         0x1p-64 * kFlicksPerSecond * 64.0);
    f = TurnsPerFlick(2 * kPi * cycles / 64.0);
  }
  Synthesiser synthesiser(sea, 0, 64, kQueryFields);
  CascadeFields a(64, kQueryFields), b(64, kQueryFields);
  synthesiser.Evaluate(SimTime::FromSeconds(3.0), a);
  synthesiser.Evaluate(SimTime::FromSeconds(3.0 + 64.0), b);
  const auto h = a.Plane(Field::kHeight), g = b.Plane(Field::kHeight);
  for (std::size_t n = 0; n < h.size(); ++n) ASSERT_NEAR(h[n], g[n], 3e-6 * Rms(h));
  const SimTime century = SimTime::FromSeconds(3.15e9);
  synthesiser.Evaluate(century, a);
  const DirectSample want = SumDirectly(*sea, century, {0, 0});
  EXPECT_NEAR(a.Plane(Field::kHeight)[0], want.height_m, 3e-6 * Rms(a.Plane(Field::kHeight)));
}

TEST(Surface, EvaluateAllocatesNothing) {
  auto sea = OneCascade(30, 15.0);
  sea->recipe.timeline.resize(2);
  sea->recipe.timeline[1].start_tick = 10;
  sea->recipe.timeline[1].span_ticks = 1000;
  sea->cascades[0].variance_m2.push_back(sea->cascades[0].variance_m2[0]);
  Synthesiser synthesiser(sea, 0, 128, kAllFields);
  CascadeFields fields(128, kAllFields);
  synthesiser.Evaluate(SimTime{}, fields);
  const std::int64_t before = AllocationCount();
  for (int n = 0; n < 20; ++n) synthesiser.Evaluate(TimeOfTick(20 * n, 60), fields);
  EXPECT_EQ(AllocationCount(), before);
}

TEST(SurfaceDeathTest, NamesWhatIsWrong) {
  const auto sea = OneCascade(8, 0.0);
  EXPECT_DEATH(Synthesiser(sea, 0, 100, kQueryFields), "grid size 100");
  EXPECT_DEATH(Synthesiser(sea, 1, 64, kQueryFields), "cascade 1");
  Synthesiser synthesiser(sea, 0, 64, kQueryFields);
  CascadeFields wrong(128, kQueryFields);
  EXPECT_DEATH(synthesiser.Evaluate(SimTime{}, wrong), "planes of 128");
}

}  // namespace
}  // namespace onesea::sea
