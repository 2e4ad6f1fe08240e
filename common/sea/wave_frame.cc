#include "common/sea/wave_frame.h"

#include <cmath>

#include "common/base/real_math.h"
#include "common/sea/constants.h"

namespace onesea::sea {

CascadeFrame::CascadeFrame(const Cascade& cascade)
    : cosine(real::Cos(cascade.rotation_rad)),
      sine(real::Sin(cascade.rotation_rad)),
      length_m(cascade.length_m) {}

Vec2d CascadeFrame::TileFraction(Vec2d world) const {
  const double u = (cosine * world.x + sine * world.y) / length_m;
  const double v = (cosine * world.y - sine * world.x) / length_m;
  return {u - std::floor(u), v - std::floor(v)};
}

Vec2d CascadeFrame::WaveVector(int i, int j) const {
  const double unit = 2.0 * kPi / length_m;
  return {unit * (cosine * i - sine * j), unit * (sine * i + cosine * j)};
}

double RegularAt::TurnsAt(Vec2d world) const {
  const double turns =
      (kx_rad_per_m * world.x + ky_rad_per_m * world.y) / (2.0 * kPi) + phase_turns;
  return turns - std::nearbyint(turns);
}

void RegularWavesAt(const Components& components, SimTime time, const std::vector<double>& weights,
                    std::vector<RegularAt>& out) {
  out.clear();
  for (const RegularComponent& wave : components.regular) {
    double variance_m2 = 0.0;
    for (std::size_t m = 0; m < weights.size(); ++m)
      variance_m2 += weights[m] * wave.variance_m2[m];
    const std::uint64_t turns =
        wave.phase_turns - wave.turns_per_flick * static_cast<std::uint64_t>(time.flicks);
    out.push_back({.kx_rad_per_m = wave.kx_rad_per_m,
                   .ky_rad_per_m = wave.ky_rad_per_m,
                   .amplitude_m = std::sqrt(2.0 * variance_m2),
                   .phase_turns = static_cast<double>(turns >> 11) * 0x1p-53,
                   .sigma_rad_per_s = wave.intrinsic_rad_per_s});
  }
}

double DepthDecay(double k_rad_per_m, double depth_m) {
  return depth_m > 0.0 ? real::Exp(-2.0 * k_rad_per_m * depth_m) : 0.0;
}

}  // namespace onesea::sea
