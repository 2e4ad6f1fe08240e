// The synthesised surface itself, measured as an instrument would: what comes out is compared with
// the physics that went in, not with the components.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "common/sea/components.h"
#include "common/sea/constants.h"
#include "common/sea/surface.h"
#include "common/sea/wave_spectrum.h"

namespace onesea::sea {
namespace {

using Complex = std::complex<double>;

constexpr int kReach = 33;  // highest |index| of a default cascade
constexpr int kSide = 2 * kReach + 1;

Recipe RecipeOf(const WaveSystem& system) {
  Recipe recipe;
  recipe.cascades = DefaultCascades();
  recipe.timeline.push_back({0, 0, {"", {system}, {}, 0.0, 0.0}});
  return recipe;
}

// Spatial Fourier coefficients of a plane for |i|, |j| <= kReach: row-major, j outer.
std::vector<Complex> Transform(std::span<const float> plane, int n) {
  std::vector<Complex> phase(static_cast<std::size_t>(n));
  for (int x = 0; x < n; ++x)
    phase[static_cast<std::size_t>(x)] = std::polar(1.0, -2.0 * kPi * x / n);
  const auto factor = [&](int index, int x) {
    return phase[static_cast<std::size_t>(((index * x) % n + n) % n)];
  };
  std::vector<Complex> rows(static_cast<std::size_t>(n * kSide));
  for (int y = 0; y < n; ++y) {
    for (int i = -kReach; i <= kReach; ++i) {
      Complex sum;
      for (int x = 0; x < n; ++x)
        sum += factor(i, x) * static_cast<double>(plane[static_cast<std::size_t>(y * n + x)]);
      rows[static_cast<std::size_t>(y * kSide + i + kReach)] = sum;
    }
  }
  std::vector<Complex> out(static_cast<std::size_t>(kSide * kSide));
  for (int j = -kReach; j <= kReach; ++j) {
    for (int i = 0; i < kSide; ++i) {
      Complex sum;
      for (int y = 0; y < n; ++y)
        sum += factor(j, y) * rows[static_cast<std::size_t>(y * kSide + i)];
      out[static_cast<std::size_t>((j + kReach) * kSide + i)] = sum / static_cast<double>(n * n);
    }
  }
  return out;
}

// Energy by wave vector: height and vertical velocity together tell a wave from its opposite.
struct Directional {
  double m0 = 0.0, cosine = 0.0, sine = 0.0, m_minus1 = 0.0;
};

void AddCascade(const std::shared_ptr<const Components>& components, int cascade, SimTime time,
                Directional& total) {
  constexpr int kGrid = 128;
  const FieldSet fields = Bit(Field::kHeight) | Bit(Field::kVelocityZ);
  Synthesiser synthesiser(components, cascade, kGrid, fields);
  CascadeFields planes(kGrid, fields);
  synthesiser.Evaluate(time, planes);
  const std::vector<Complex> height = Transform(planes.Plane(Field::kHeight), kGrid);
  const std::vector<Complex> rise = Transform(planes.Plane(Field::kVelocityZ), kGrid);
  const Cascade& c = components->recipe.cascades[static_cast<std::size_t>(cascade)];
  for (int j = -kReach; j <= kReach; ++j) {
    for (int i = -kReach; i <= kReach; ++i) {
      if (i == 0 && j == 0) continue;
      const double k = 2.0 * kPi / c.length_m * std::hypot(i, j);
      const double sigma = std::sqrt(kGravity * k + kSurfaceTensionOverDensity * k * k * k);
      const auto n = static_cast<std::size_t>((j + kReach) * kSide + i + kReach);
      const Complex forward = 0.5 * (height[n] + Complex(0.0, 1.0) * rise[n] / sigma);
      const double variance = 2.0 * std::norm(forward);
      const double angle = std::atan2(j, i) + c.rotation_rad;
      total.m0 += variance;
      total.m_minus1 += variance / sigma;
      total.cosine += variance * std::cos(angle);
      total.sine += variance * std::sin(angle);
    }
  }
}

TEST(SurfacePhysics, HeightDirectionAndSpreadComeBackFromTheSurface) {
  JonswapSystem system{3.0, 9.0, 3.3, 2.2, {SpreadingKind::kCosine2s, 15.0, 0.0}, false};
  const auto components = *BuildComponents(RecipeOf(system));
  Directional sea;
  for (int c = 0; c < 4; ++c) AddCascade(components, c, SimTime::FromSeconds(1234.5), sea);
  EXPECT_NEAR(4.0 * std::sqrt(sea.m0), 3.0, 0.03);
  EXPECT_NEAR(std::atan2(sea.sine, sea.cosine), 2.2, 0.01);
  const double r1 = std::hypot(sea.sine, sea.cosine) / sea.m0;
  EXPECT_NEAR(std::sqrt(2.0 * (1.0 - r1)) * 180.0 / kPi, 20.257, 0.4);  // √(2/(s+1))
  // Te of a JONSWAP sea with γ = 3.3 is 0.9033 Tp (integrated by another program).
  EXPECT_NEAR(2.0 * kPi * sea.m_minus1 / sea.m0 / 9.0, 0.9033, 0.01);
}

// Time-mean of the spatial variance, with no transform at all.
TEST(SurfacePhysics, VarianceOfThePlanesIsTheRecipes) {
  const auto components = *BuildComponents(RecipeOf(JonswapSystem{}));
  double sum = 0.0;
  constexpr int kTimes = 8;
  for (int c = 0; c < 4; ++c) {
    Synthesiser synthesiser(components, c, 128, Bit(Field::kHeight));
    CascadeFields planes(128, Bit(Field::kHeight));
    for (int t = 0; t < kTimes; ++t) {
      synthesiser.Evaluate(SimTime::FromSeconds(100.0 + 37.7 * t), planes);
      for (const float eta : planes.Plane(Field::kHeight)) {
        sum += static_cast<double>(eta) * static_cast<double>(eta) / (128.0 * 128.0 * kTimes);
      }
    }
  }
  EXPECT_NEAR(4.0 * std::sqrt(sum), 2.0, 0.02);
}

// Where each spatial harmonic's time series has its spectral peak, over the whole range of
// frequencies and both signs: a wave that moves along +k turns as exp(-iωt).
double MeasuredFrequency(const std::vector<Complex>& series, double step_s) {
  const auto n = static_cast<int>(series.size());
  const auto power = [&](double omega) {
    Complex sum;
    for (int t = 0; t < n; ++t) {
      const double window = 0.5 - 0.5 * std::cos(2.0 * kPi * (t + 0.5) / n);
      sum += window * series[static_cast<std::size_t>(t)] * std::polar(1.0, omega * step_s * t);
    }
    return std::norm(sum);
  };
  const double coarse = kPi / (n * step_s);
  double best = 0.0;
  double best_power = -1.0;
  for (int m = -n; m <= n; ++m) {
    const double p = power(m * coarse);
    if (p > best_power) {
      best_power = p;
      best = m * coarse;
    }
  }
  double width = coarse;
  for (int round = 0; round < 30; ++round) {
    if (power(best - width) > power(best))
      best -= width;
    else if (power(best + width) > power(best))
      best += width;
    else
      width *= 0.5;
  }
  return best;
}

TEST(SurfacePhysics, DispersionFromASpaceTimeTransform) {
  constexpr int kGrid = 64;
  constexpr int kTimes = 200;
  constexpr double kStepS = 0.4;
  Recipe recipe =
      RecipeOf(JonswapSystem{2.0, 6.0, 1.0, 0.5, {SpreadingKind::kCosine2s, 4.0, 0.0}, false});
  recipe.depth_m = 7.0;
  recipe.current_m_per_s = {1.2, -0.7};
  recipe.cascades = {{200.0, 0.3, 0.0, 8.0 * 2.0 * kPi / 200.0, 64}};
  const auto components = *BuildComponents(recipe);
  Synthesiser synthesiser(components, 0, kGrid, Bit(Field::kHeight));
  CascadeFields planes(kGrid, Bit(Field::kHeight));
  std::vector<std::vector<Complex>> transforms;
  for (int t = 0; t < kTimes; ++t) {
    synthesiser.Evaluate(SimTime::FromSeconds(50.0 + kStepS * t), planes);
    transforms.push_back(Transform(planes.Plane(Field::kHeight), kGrid));
  }
  int tested = 0;
  for (int j = -6; j <= 6; ++j) {
    for (int i = 1; i <= 6; ++i) {
      const double angle = std::atan2(j, i) + 0.3;
      // Well downwind, where the opposite wave is far weaker, and not far below the peak.
      if (std::fabs(angle - 0.5) > 1.0 || std::hypot(i, j) < 3.9) continue;
      std::vector<Complex> series;
      for (const auto& transform : transforms) {
        series.push_back(transform[static_cast<std::size_t>((j + kReach) * kSide + i + kReach)]);
      }
      const double k = 2.0 * kPi / 200.0 * std::hypot(i, j);
      const double want = std::sqrt(kGravity * k * std::tanh(7.0 * k)) +
                          k * (1.2 * std::cos(angle) - 0.7 * std::sin(angle));
      EXPECT_NEAR(MeasuredFrequency(series, kStepS) / want, 1.0, 2e-3) << i << " " << j;
      ++tested;
    }
  }
  EXPECT_GT(tested, 15);
}

// ∂η/∂t = -c·∇η for a travelling wave, so -<w ∇η> points where the sea travels.
TEST(SurfacePhysics, TheSeaTravelsWithTheWind) {
  for (const double wind_to : {-2.0, 0.6, 3.0}) {
    PhillipsSystem system;
    system.wind_to_rad = wind_to;
    const auto components = *BuildComponents(RecipeOf(system));
    const FieldSet fields = Bit(Field::kVelocityZ) | Bit(Field::kSlopeX) | Bit(Field::kSlopeY);
    double x = 0.0;
    double y = 0.0;
    for (int c = 0; c < 3; ++c) {
      Synthesiser synthesiser(components, c, 128, fields);
      CascadeFields planes(128, fields);
      synthesiser.Evaluate(SimTime::FromSeconds(77.0), planes);
      const auto w = planes.Plane(Field::kVelocityZ);
      const auto sx = planes.Plane(Field::kSlopeX);
      const auto sy = planes.Plane(Field::kSlopeY);
      for (std::size_t n = 0; n < w.size(); ++n) {
        x -= static_cast<double>(w[n] * sx[n]);
        y -= static_cast<double>(w[n] * sy[n]);
      }
    }
    EXPECT_NEAR(std::remainder(std::atan2(y, x) - wind_to, 2.0 * kPi), 0.0, 0.05);
  }
}

// Displacement gathers the surface at crests and stretches it at troughs, in the measure of theory:
// <η ∇·D> = -λ ∫ k F dk. The other sign would make round crests and sharp troughs.
TEST(SurfacePhysics, CrestsSharpen) {
  const JonswapSystem steep{4.0, 8.0, 3.3, 0.0, {SpreadingKind::kCosine2s, 10.0, 0.0}, false};
  Recipe recipe = RecipeOf(steep);
  recipe.choppiness = 0.8;
  const auto components = *BuildComponents(recipe);
  const FieldSet fields = Bit(Field::kHeight) | kNormalFields;
  Synthesiser synthesiser(components, 0, 256, fields);
  CascadeFields planes(256, fields);
  double correlation = 0.0;
  double crest_area = 0.0, crests = 0.0, trough_area = 0.0, troughs = 0.0;
  constexpr int kTimes = 5;
  for (int t = 0; t < kTimes; ++t) {
    synthesiser.Evaluate(SimTime::FromSeconds(60.0 * t), planes);
    for (std::size_t n = 0; n < 256 * 256; ++n) {
      const double eta = planes.Plane(Field::kHeight)[n];
      const double xx = planes.Plane(Field::kJacobianXX)[n];
      const double yy = planes.Plane(Field::kJacobianYY)[n];
      const double xy = planes.Plane(Field::kJacobianXY)[n];
      const double area = (1.0 + xx) * (1.0 + yy) - xy * xy;
      correlation += eta * (xx + yy) / (256.0 * 256.0 * kTimes);
      crest_area += eta > 1.5 ? area : 0.0;
      crests += eta > 1.5 ? 1.0 : 0.0;
      trough_area += eta < -1.5 ? area : 0.0;
      troughs += eta < -1.5 ? 1.0 : 0.0;
    }
  }
  const auto spectrum = MakeWaveSpectrum(steep, 0.0);
  const double want =
      -0.8 * RadialMoment(*spectrum, 1e-3, recipe.cascades[0].wavenumber_max_rad_per_m, 1);
  EXPECT_NEAR(correlation / want, 1.0, 0.02);
  EXPECT_LT(crest_area / crests, 0.95);
  EXPECT_GT(trough_area / troughs, 1.05);
}

}  // namespace
}  // namespace onesea::sea
