// Velocity and pressure below the surface by the direct sum over every wave.
//
// Idea: lanes are waves. Wave n of a cascade adds to partial sum n mod 16 whatever the vector
//   width, and the sixteen are added in one order at the end: the same bits on every SIMD target.
// Limits: float; phases are integers (2⁻³² turn), so far points and late times lose nothing.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/sea/depth_query.cc"
#include "hwy/foreach_target.h"
//
#include <cstddef>
#include <cstdint>

#include "common/sea/aligned.h"
#include "common/sea/constants.h"
#include "common/sea/sincos-inl.h"
#include "hwy/highway.h"

#ifndef ONESEA_SEA_DEPTH_QUERY_ONCE_
#define ONESEA_SEA_DEPTH_QUERY_ONCE_
namespace onesea::sea {
namespace {

constexpr std::size_t kPartialSums = 16;

// The waves of one cascade at one time; arrays padded to whole groups with amplitude 0.
struct DepthWaves {
  std::size_t count = 0;  // multiple of kPartialSums
  AlignedArray<std::int32_t> i, j;
  AlignedArray<std::uint32_t> turns;
  FloatArray amplitude_m, kx, ky, sigma;
};

// What the kernel needs of the point.
struct DepthPoint {
  std::uint32_t u_turns, v_turns;  // local coordinates in 2⁻³² tile length
  float below_m;                   // below z = 0
  float water_depth_m;             // 0: infinite
  float factor;                    // of the cascade there
};

struct DepthSums {
  float velocity_x[kPartialSums], velocity_y[kPartialSums], velocity_z[kPartialSums];
  float head_m[kPartialSums];  // pressure / (rho g)
};

}  // namespace
}  // namespace onesea::sea
#endif

HWY_BEFORE_NAMESPACE();
namespace onesea::sea {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, kPartialSums>;
using V = hn::Vec<D>;

// e^{-x} for x >= 0; relative error 3e-7 for x < 10, 0.5e-7 x beyond; 0 towards e⁻⁸⁷.
HWY_INLINE V ExpOfMinus(V x) {
  const D d;
  const hn::RebindToSigned<D> di;
  const V halvings = hn::Min(hn::Mul(x, hn::Set(d, 1.44269504f)), hn::Set(d, 126.0f));
  const V whole = hn::Round(halvings);
  const V f = hn::Mul(hn::Sub(whole, halvings), hn::Set(d, 0.693147181f));
  V p = hn::Set(d, 1.0f / 5040.0f);
  constexpr float kTaylor[7] = {1.0f / 720, 1.0f / 120, 1.0f / 24, 1.0f / 6, 0.5f, 1.0f, 1.0f};
  for (float c : kTaylor) p = hn::Add(hn::Mul(p, f), hn::Set(d, c));
  const auto exponent = hn::Sub(hn::Set(di, 127), hn::ConvertTo(di, whole));
  return hn::Mul(p, hn::BitCast(d, hn::ShiftLeft<23>(exponent)));
}

void SumAtDepth(const DepthWaves& waves, const DepthPoint& point, DepthSums& sums) {
  const D d;
  const hn::RebindToSigned<D> di;
  const hn::RebindToUnsigned<D> du;
  const std::size_t lanes = hn::Lanes(d);
  const auto u = hn::BitCast(di, hn::Set(du, point.u_turns)),
             v = hn::BitCast(di, hn::Set(du, point.v_turns));
  const V below = hn::Set(d, point.below_m), water = hn::Set(d, point.water_depth_m);
  const V two = hn::Set(d, 2.0f), one = hn::Set(d, 1.0f);
  const V gravity = hn::Set(d, static_cast<float>(kGravity));
  const V tension = hn::Set(d, static_cast<float>(kSurfaceTensionOverDensity));
  const V factor = hn::Set(d, point.factor);
  const bool finite = point.water_depth_m > 0.0f;
  for (std::size_t lane = 0; lane < kPartialSums; lane += lanes) {
    V vx = hn::Load(d, sums.velocity_x + lane), vy = hn::Load(d, sums.velocity_y + lane);
    V vz = hn::Load(d, sums.velocity_z + lane), head = hn::Load(d, sums.head_m + lane);
    for (std::size_t n = lane; n < waves.count; n += kPartialSums) {
      const auto place = hn::Add(hn::Mul(hn::Load(di, waves.i.get() + n), u),
                                 hn::Mul(hn::Load(di, waves.j.get() + n), v));
      V sine, cosine;
      const auto turns = hn::Load(du, waves.turns.get() + n);
      SinCosTurns(d, hn::Add(turns, hn::BitCast(du, place)), sine, cosine);
      const V kx = hn::Load(d, waves.kx.get() + n), ky = hn::Load(d, waves.ky.get() + n);
      const V k = hn::Sqrt(hn::Add(hn::Mul(kx, kx), hn::Mul(ky, ky)));
      const V sigma = hn::Load(d, waves.sigma.get() + n);
      const V amplitude = hn::Mul(factor, hn::Load(d, waves.amplitude_m.get() + n));
      const V down = ExpOfMinus(hn::Mul(k, below));
      V level = down, rise = down;  // cosh k(z+h) / cosh kh and sinh k(z+h) / cosh kh
      V over_tanh = sigma;          // σ coth kh
      if (finite) {
        const V up = ExpOfMinus(hn::Mul(k, hn::Sub(hn::Mul(two, water), below)));
        const V scale = hn::Div(one, hn::Add(one, ExpOfMinus(hn::Mul(two, hn::Mul(k, water)))));
        level = hn::Mul(scale, hn::Add(down, up));
        rise = hn::Mul(scale, hn::Sub(down, up));
        // By the dispersion relation, which does not cancel in shallow water.
        const V g = hn::Add(gravity, hn::Mul(tension, hn::Mul(k, k)));
        over_tanh = hn::Div(hn::Mul(g, k), sigma);
      }
      const V along = hn::Mul(hn::Mul(amplitude, cosine), level);
      const V speed = hn::Div(hn::Mul(along, over_tanh), k);
      vx = hn::Add(vx, hn::Mul(speed, kx));
      vy = hn::Add(vy, hn::Mul(speed, ky));
      vz = hn::Add(vz, hn::Mul(hn::Mul(amplitude, sine), hn::Mul(rise, over_tanh)));
      head = hn::Add(head, along);
    }
    hn::Store(vx, d, sums.velocity_x + lane);
    hn::Store(vy, d, sums.velocity_y + lane);
    hn::Store(vz, d, sums.velocity_z + lane);
    hn::Store(head, d, sums.head_m + lane);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace onesea::sea
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/base/real_math.h"
#include "common/sea/attenuation.h"
#include "common/sea/point_query.h"
#include "common/sea/wave_frame.h"

namespace onesea::sea {
HWY_EXPORT(SumAtDepth);

namespace {

DepthWaves WavesAt(const CascadeComponents& waves, SimTime time, std::span<const double> weights) {
  DepthWaves at;
  const std::size_t used = waves.i.size();
  at.count = (used + kPartialSums - 1) / kPartialSums * kPartialSums;
  at.i = AllocateZeros<std::int32_t>(at.count);
  at.j = AllocateZeros<std::int32_t>(at.count);
  at.turns = AllocateZeros<std::uint32_t>(at.count);
  for (FloatArray* array : {&at.amplitude_m, &at.kx, &at.ky, &at.sigma}) {
    *array = AllocateZeros<float>(at.count);
    std::fill_n(array->get() + used, at.count - used, array == &at.amplitude_m ? 0.0f : 1.0f);
  }
  const auto flicks = static_cast<std::uint64_t>(time.flicks);
  for (std::size_t n = 0; n < used; ++n) {
    double variance_m2 = 0.0;
    for (std::size_t m = 0; m < weights.size(); ++m) {
      variance_m2 += weights[m] * waves.variance_m2[m][n];
    }
    const std::uint64_t phase = std::uint64_t{waves.phase_turns[n]} << 32;
    at.i[n] = waves.i[n];
    at.j[n] = waves.j[n];
    at.turns[n] = static_cast<std::uint32_t>((phase - waves.turns_per_flick[n] * flicks) >> 32);
    at.amplitude_m[n] = static_cast<float>(std::sqrt(2.0 * variance_m2));
    at.kx[n] = waves.kx_rad_per_m[n];
    at.ky[n] = waves.ky_rad_per_m[n];
    at.sigma[n] = waves.intrinsic_rad_per_s[n];
  }
  return at;
}

void AddRegular(const RegularAt& wave, Vec2d point, double below_m, double water_depth_m,
                DepthSample& sample) {
  const double kx = wave.kx_rad_per_m, ky = wave.ky_rad_per_m;
  const double k = std::sqrt(kx * kx + ky * ky);
  const double decay = DepthDecay(k, water_depth_m);
  const double down = real::Exp(-k * below_m);
  const double up = water_depth_m > 0.0 ? real::Exp(-k * (2.0 * water_depth_m - below_m)) : 0.0;
  const real::SinCosPair phase = real::SinCos(2.0 * kPi * wave.TurnsAt(point));
  const double speed = wave.sigma_rad_per_s * wave.amplitude_m / (1.0 - decay);
  sample.velocity_m_per_s.x += speed * (kx / k) * (down + up) * phase.cos;
  sample.velocity_m_per_s.y += speed * (ky / k) * (down + up) * phase.cos;
  sample.velocity_m_per_s.z += speed * (down - up) * phase.sin;
  sample.dynamic_pressure_pa +=
      kWaterDensityKgPerM3 * kGravity * wave.amplitude_m * (down + up) / (1.0 + decay) * phase.cos;
}

std::uint32_t ToTurns(double fraction) {
  return static_cast<std::uint32_t>(static_cast<std::uint64_t>(fraction * 0x1p32));
}

double Total(const float (&partial)[kPartialSums]) {
  double sum = 0.0;
  for (float value : partial) sum += value;
  return sum;
}

}  // namespace

void SampleAtDepth(const Components& components, SimTime time, std::span<const Vec2d> points,
                   std::span<const double> depth_m, std::span<DepthSample> out,
                   const AttenuationGrid* attenuation) {
  ONESEA_CHECK(points.size() == depth_m.size() && points.size() == out.size())
      << points.size() << " points, " << depth_m.size() << " depths, " << out.size() << " answers";
  const Recipe& recipe = components.recipe;
  std::vector<double> weights(recipe.timeline.size());
  WeatherWeights(recipe, time, weights);
  std::vector<RegularAt> regular;
  RegularWavesAt(components, time, weights, regular);
  std::vector<DepthWaves> waves;
  std::vector<CascadeFrame> frames;
  for (const CascadeComponents& cascade : components.cascades) {
    waves.push_back(WavesAt(cascade, time, weights));
    frames.emplace_back(cascade.cascade);
  }
  for (std::size_t p = 0; p < points.size(); ++p) {
    ONESEA_CHECK(std::isfinite(points[p].x) && std::isfinite(points[p].y) && depth_m[p] >= 0.0 &&
                 std::isfinite(depth_m[p]))
        << "point (" << points[p].x << ", " << points[p].y << "), depth " << depth_m[p];
    // Nothing moves below the bottom but what moves at it.
    const double below_m = recipe.depth_m > 0.0 ? std::min(depth_m[p], recipe.depth_m) : depth_m[p];
    DepthSample sample;
    std::array<float, kCascadesMax + 1> factors;
    factors.fill(1.0f);
    if (attenuation != nullptr) attenuation->AllAt(points[p], factors.data());
    alignas(64) DepthSums sums = {};
    for (std::size_t c = 0; c < waves.size(); ++c) {
      const Vec2d at = frames[c].TileFraction(points[p]);
      const DepthPoint point = {ToTurns(at.x), ToTurns(at.y), static_cast<float>(below_m),
                                static_cast<float>(recipe.depth_m), factors[c]};
      HWY_DYNAMIC_DISPATCH(SumAtDepth)(waves[c], point, sums);
    }
    sample.velocity_m_per_s = {Total(sums.velocity_x) + recipe.current_m_per_s.x,
                               Total(sums.velocity_y) + recipe.current_m_per_s.y,
                               Total(sums.velocity_z)};
    sample.dynamic_pressure_pa = kWaterDensityKgPerM3 * kGravity * Total(sums.head_m);
    for (RegularAt wave : regular) {
      wave.amplitude_m *= double{factors[waves.size()]};
      AddRegular(wave, points[p], below_m, recipe.depth_m, sample);
    }
    out[p] = sample;
  }
}

}  // namespace onesea::sea
#endif  // HWY_ONCE
