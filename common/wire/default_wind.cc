#include "common/wire/default_wind.h"

#include <algorithm>
#include <cmath>

#include "common/base/limits.h"
#include "common/sea/constants.h"

namespace onesea::wire {
namespace {

double WindOfHeight(double hs_m) {
  return std::min(std::sqrt(sea::kGravity * hs_m / 0.22), kWindSpeedMaxMPerS);
}

// Trapezoidal m0 over frequency, for a height only as good as a wind guess needs.
template <typename Density>
double HeightOf(const std::vector<float>& frequency_hz, Density density_m2_per_hz) {
  double m0 = 0.0;
  for (std::size_t n = 1; n < frequency_hz.size(); ++n) {
    const double width_hz = static_cast<double>(frequency_hz[n]) - frequency_hz[n - 1];
    m0 += 0.5 * width_hz * (density_m2_per_hz(n) + density_m2_per_hz(n - 1));
  }
  return 4.0 * std::sqrt(m0);
}

struct WindOf {
  Wind operator()(const sea::PhillipsSystem& s) const {
    return {s.wind_speed_m_per_s, s.wind_to_rad};
  }
  Wind operator()(const sea::PiersonMoskowitzSystem& s) const {
    return {s.wind_speed_19_5_m_per_s / 1.026, s.wave_to_rad};
  }
  Wind operator()(const sea::JonswapSystem& s) const {
    return {s.spreading.swell > 0.0 ? 0.0 : WindOfHeight(s.hs_m), s.wave_to_rad};
  }
  Wind operator()(const sea::FetchJonswapSystem& s) const {
    return {s.wind_speed_m_per_s, s.wave_to_rad};
  }
  Wind operator()(const sea::ElfouhailySystem& s) const {
    return {s.wind_speed_m_per_s, s.wave_to_rad};
  }
  Wind operator()(const sea::BuoySpectrum& s) const {
    const auto& density = s.density_m2_per_hz;
    const double hs_m =
        s.hs_m > 0.0 ? s.hs_m : HeightOf(s.frequency_hz, [&](std::size_t n) { return density[n]; });
    const auto peak = std::max_element(density.begin(), density.end()) - density.begin();
    const bool directional = !s.mean_wave_to_rad.empty();
    return {WindOfHeight(hs_m), directional ? s.mean_wave_to_rad[peak] : s.fallback_wave_to_rad};
  }
  Wind operator()(const sea::GridSpectrum& s) const {
    const std::size_t directions = s.wave_to_rad.size();
    const auto& density = s.density_m2_per_hz_rad;
    const double width_rad = 2.0 * sea::kPi / static_cast<double>(directions);
    const auto summed = [&](std::size_t n) {
      double sum = 0.0;
      for (std::size_t m = 0; m < directions; ++m) sum += density[n * directions + m];
      return sum * width_rad;
    };
    const auto peak = std::max_element(density.begin(), density.end()) - density.begin();
    return {WindOfHeight(s.hs_m > 0.0 ? s.hs_m : HeightOf(s.frequency_hz, summed)),
            s.wave_to_rad[static_cast<std::size_t>(peak) % directions]};
  }
};

}  // namespace

Wind DefaultWind(const sea::SeaState& sea) {
  Wind strongest;
  for (const sea::WaveSystem& system : sea.systems) {
    const Wind wind = std::visit(WindOf{}, system);
    if (wind.speed_m_per_s > strongest.speed_m_per_s) strongest = wind;
  }
  if (strongest.speed_m_per_s == 0.0 && !sea.systems.empty()) {
    strongest.to_rad = std::visit(WindOf{}, sea.systems.front()).to_rad;
  }
  return strongest;
}

}  // namespace onesea::wire
