#include "common/sea/spectrum_tma.h"

#include "common/base/real_math.h"

namespace onesea::sea {

double TmaDepthFactor(double k_rad_per_m, double depth_m) {
  if (!(depth_m > 0.0)) return 1.0;
  const double kh = k_rad_per_m * depth_m;
  if (kh > 20.0) return 1.0;
  const double t = real::Tanh(kh);
  return t * t / (1.0 + 2.0 * kh / real::Sinh(2.0 * kh));
}

}  // namespace onesea::sea
