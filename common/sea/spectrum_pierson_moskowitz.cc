#include "common/sea/spectrum_pierson_moskowitz.h"

#include <cmath>

#include "common/sea/constants.h"

namespace onesea::sea {

JonswapShape PiersonMoskowitzShape(const PiersonMoskowitzSystem& system) {
  constexpr double kBeta = 0.74;
  const double root = std::sqrt(std::sqrt(0.8 * kBeta));
  return {0.0081, root * kGravity / system.wind_speed_19_5_m_per_s, 1.0, 0.0};
}

std::unique_ptr<const WaveSpectrum> MakePiersonMoskowitzSpectrum(
    const PiersonMoskowitzSystem& system, double depth_m) {
  const JonswapShape shape = PiersonMoskowitzShape(system);
  const double wind_10_m_per_s = system.wind_speed_19_5_m_per_s / 1.026;  // neutral air
  const double age = wind_10_m_per_s * shape.omega_p_rad_per_s / kGravity;
  return MakeSpectrum(shape, {system.spreading, shape.omega_p_rad_per_s, age}, system.wave_to_rad,
                      depth_m);
}

}  // namespace onesea::sea
