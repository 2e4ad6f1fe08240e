#include "common/sea/dispersion.h"

#include <cmath>

#include "common/base/real_math.h"
#include "common/base/sim_time.h"
#include "common/sea/constants.h"

namespace onesea::sea {
namespace {

double DepthFactor(double k, double depth_m) {
  return depth_m > 0.0 ? real::Tanh(k * depth_m) : 1.0;
}

}  // namespace

double IntrinsicFrequency(double k_rad_per_m, double depth_m) {
  const double k = k_rad_per_m;
  const double restoring = k * (kGravity + kSurfaceTensionOverDensity * (k * k));
  return std::sqrt(restoring * DepthFactor(k, depth_m));
}

double GroupVelocity(double k_rad_per_m, double depth_m) {
  const double k = k_rad_per_m;
  const double capillary = kSurfaceTensionOverDensity * (k * k);
  const double t = DepthFactor(k, depth_m);
  // 2 σ dσ/dk; the second term is 0 in deep water, where depth_m = 0.
  const double slope =
      (kGravity + 3.0 * capillary) * t + k * (kGravity + capillary) * depth_m * (1.0 - t * t);
  return slope / (2.0 * IntrinsicFrequency(k, depth_m));
}

double WavenumberOf(double sigma_rad_per_s, double depth_m) {
  const double sigma = sigma_rad_per_s;
  // Both the deep and the shallow speed are upper bounds of gravity waves' speed, so each gives a
  // wavenumber that is too small; without capillarity the larger of them is still left of the root.
  double k = sigma * sigma / kGravity;
  if (depth_m > 0.0) {
    const double shallow = sigma / std::sqrt(kGravity * depth_m);
    if (shallow > k) k = shallow;
  }
  for (int step = 0; step < 60; ++step) {
    const double next = k + (sigma - IntrinsicFrequency(k, depth_m)) / GroupVelocity(k, depth_m);
    const bool settled = std::fabs(next - k) <= 4e-16 * k;
    k = next;
    if (settled) break;
  }
  return k;
}

double RoundToLoop(double omega_rad_per_s, double loop_period_s) {
  if (!(loop_period_s > 0.0)) return omega_rad_per_s;
  const double step = 2.0 * kPi / loop_period_s;
  return std::floor(omega_rad_per_s / step + 0.5) * step;
}

std::uint64_t TurnsPerFlick(double omega_rad_per_s) {
  const double hertz = omega_rad_per_s / (2.0 * kPi);
  const double turns = hertz / static_cast<double>(kFlicksPerSecond) * 0x1p64;
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(turns + 0.5)));
}

std::uint64_t TurnsOfAngle(double angle_rad) {
  const double turns = angle_rad / (2.0 * kPi);
  const double fraction = turns - std::floor(turns);  // in [0, 1]; 1 only by rounding
  return fraction < 1.0 ? static_cast<std::uint64_t>(fraction * 0x1p64) : 0;
}

}  // namespace onesea::sea
