#pragma once

#include <cmath>

#include "common/sea/recipe.h"

/// Recipes that use every field with numbers that no short decimal holds.
namespace onesea::wire {

inline sea::SeaState ParametricSea() {
  sea::SeaState sea;
  sea.name = "wind sea and swell";
  sea.systems.push_back(sea::JonswapSystem{
      .hs_m = 1.0 / 3.0,
      .tp_s = std::nextafter(7.0, 8.0),
      .gamma = 3.3,
      .wave_to_rad = 2.1,
      .spreading = {.kind = sea::SpreadingKind::kCosine2s, .exponent_s = 25.1, .swell = 0.7}});
  sea.systems.push_back(sea::PhillipsSystem{.wind_speed_m_per_s = 9.9,
                                            .wind_to_rad = 0.1,
                                            .small_wave_cutoff_m = 0.01,
                                            .one_sided = false});
  sea.systems.push_back(sea::PiersonMoskowitzSystem{7.7, 0.3, {}});
  sea.systems.push_back(sea::FetchJonswapSystem{8.8, 12345.6, 2.2, 0.4, {}, true});
  sea.systems.push_back(sea::ElfouhailySystem{.wind_speed_m_per_s = 5.5, .inverse_wave_age = 1.1});
  sea.regular_waves.push_back({.amplitude_m = 0.7, .period_s = 9.1, .phase_rad = -0.0});
  sea.wind_speed_m_per_s = 11.1;
  sea.wind_to_rad = -3.0;
  return sea;
}

/// As large as a buoy's gets: 64 frequencies, all arrays.
inline sea::SeaState BuoySea() {
  sea::BuoySpectrum buoy;
  for (int n = 0; n < 64; ++n) {
    const float f = 0.03f + 0.0077f * static_cast<float>(n);
    buoy.frequency_hz.push_back(f);
    buoy.density_m2_per_hz.push_back(1.0f / (1.0f + 100.0f * f * f));
    buoy.mean_wave_to_rad.push_back(0.01f * static_cast<float>(n));
    buoy.principal_wave_to_rad.push_back(0.02f * static_cast<float>(n));
    buoy.r1.push_back(0.8f);
    buoy.r2.push_back(0.5f);
  }
  buoy.hs_m = 4.71;
  sea::SeaState sea;
  sea.name = "buoy";
  sea.systems.push_back(buoy);
  sea.wind_speed_m_per_s = 15.0;
  return sea;
}

inline sea::SeaState GridSea() {
  sea::GridSpectrum grid;
  for (int n = 0; n < 32; ++n) {
    grid.frequency_hz.push_back(0.04f * std::pow(1.1f, static_cast<float>(n)));
  }
  for (int m = 0; m < 36; ++m) grid.wave_to_rad.push_back(0.17453292f * static_cast<float>(m));
  for (int n = 0; n < 32 * 36; ++n) {
    grid.density_m2_per_hz_rad.push_back(0.001f * static_cast<float>(n % 37));
  }
  grid.add_tail = false;
  sea::SeaState sea;
  sea.systems.push_back(grid);
  sea.wind_speed_m_per_s = 8.0;
  return sea;
}

inline sea::Recipe RecipeOf(const sea::SeaState& sea) {
  sea::Recipe recipe;
  recipe.seed = 0xfedcba9876543210ULL;
  recipe.depth_m = 33.3;
  recipe.current_m_per_s = {0.1, -0.2};
  recipe.amplitude = sea::AmplitudeKind::kRayleigh;
  recipe.choppiness = 0.9;
  recipe.cascades = sea::DefaultCascades();
  recipe.timeline.push_back({0, 0, sea});
  return recipe;
}

}  // namespace onesea::wire
