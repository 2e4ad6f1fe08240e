// The oracle: every wave at one point, in double, by libm. Slow and plain on purpose.
#include <cmath>

#include "common/base/check.h"
#include "common/sea/constants.h"
#include "common/sea/point_query.h"
#include "common/sea/wave_frame.h"

namespace onesea::sea {

namespace {

void AddWave(Vec2d k, double amplitude_m, double sigma_rad_per_s, double phase_rad,
             const Recipe& recipe, DirectSample& sum) {
  const double c = amplitude_m * std::cos(phase_rad);
  const double s = amplitude_m * std::sin(phase_rad);
  const double k_norm = Norm(k);
  const Vec2d unit = (1.0 / k_norm) * k;
  const double lambda = recipe.choppiness;
  const double coth = recipe.depth_m > 0.0 ? 1.0 / std::tanh(k_norm * recipe.depth_m) : 1.0;
  sum.height_m += c;
  sum.displacement_x_m -= lambda * unit.x * s;
  sum.displacement_y_m -= lambda * unit.y * s;
  sum.slope_x -= k.x * s;
  sum.slope_y -= k.y * s;
  sum.jacobian_xx -= lambda * k.x * unit.x * c;
  sum.jacobian_yy -= lambda * k.y * unit.y * c;
  sum.jacobian_xy -= lambda * k.x * unit.y * c;
  sum.velocity_m_per_s.x += sigma_rad_per_s * coth * unit.x * c;
  sum.velocity_m_per_s.y += sigma_rad_per_s * coth * unit.y * c;
  sum.velocity_m_per_s.z += sigma_rad_per_s * s;
}

}  // namespace

DirectSample SumDirectly(const Components& components, SimTime time, Vec2d undisplaced) {
  ONESEA_CHECK(std::isfinite(undisplaced.x) && std::isfinite(undisplaced.y))
      << "point (" << undisplaced.x << ", " << undisplaced.y << ")";
  const Recipe& recipe = components.recipe;
  std::vector<double> weights(recipe.timeline.size());
  WeatherWeights(recipe, time, weights);
  DirectSample sum;
  for (const CascadeComponents& waves : components.cascades) {
    const CascadeFrame frame(waves.cascade);
    const Vec2d at = frame.TileFraction(undisplaced);
    for (std::size_t n = 0; n < waves.i.size(); ++n) {
      double variance_m2 = 0.0;
      for (std::size_t m = 0; m < weights.size(); ++m)
        variance_m2 += weights[m] * waves.variance_m2[m][n];
      const std::uint64_t turns =
          (std::uint64_t{waves.phase_turns[n]} << 32) -
          waves.turns_per_flick[n] * static_cast<std::uint64_t>(time.flicks);
      const double phase_rad =
          2.0 * kPi *
          (waves.i[n] * at.x + waves.j[n] * at.y + static_cast<double>(turns >> 11) * 0x1p-53);
      AddWave(frame.WaveVector(waves.i[n], waves.j[n]), std::sqrt(2.0 * variance_m2),
              waves.intrinsic_rad_per_s[n], phase_rad, recipe, sum);
    }
  }
  std::vector<RegularAt> regular;
  RegularWavesAt(components, time, weights, regular);
  for (const RegularAt& wave : regular) {
    AddWave({wave.kx_rad_per_m, wave.ky_rad_per_m}, wave.amplitude_m, wave.sigma_rad_per_s,
            2.0 * kPi * wave.TurnsAt(undisplaced), recipe, sum);
  }
  return sum;
}

}  // namespace onesea::sea
