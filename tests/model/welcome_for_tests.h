#pragma once

#include <cmath>

#include "common/base/check.h"
#include "common/sea/components.h"
#include "common/wire/frame.h"

namespace onesea::client {

/// Two cascades with a JONSWAP sea: quick to build, choppy enough to fold here and there.
inline sea::Recipe ChoppyRecipe() {
  sea::Recipe recipe;
  recipe.seed = 7;
  recipe.cascades = {{.length_m = 311.0,
                      .rotation_rad = 0.3,
                      .wavenumber_min_rad_per_m = 0.01,
                      .wavenumber_max_rad_per_m = 0.16,
                      .query_grid_size = 64},
                     {.length_m = 83.0,
                      .rotation_rad = 1.1,
                      .wavenumber_min_rad_per_m = 0.16,
                      .wavenumber_max_rad_per_m = 0.6,
                      .query_grid_size = 64}};
  sea::SeaState sea;
  sea.name = "choppy";
  sea.systems = {sea::JonswapSystem{.hs_m = 2.0, .tp_s = 7.0, .wave_to_rad = 0.5, .spreading = {}}};
  recipe.timeline = {{.sea = sea}};
  return recipe;
}

/// Nothing but one 8 s wave of 0.7 m travelling north-east: its height is a cosine.
inline sea::Recipe OneWaveRecipe() {
  sea::Recipe recipe = ChoppyRecipe();
  recipe.choppiness = 0.0;
  recipe.timeline[0].sea.systems.clear();
  recipe.timeline[0].sea.regular_waves = {{.amplitude_m = 0.7,
                                           .period_s = 8.0,
                                           .wave_to_rad = 0.25 * 3.14159265358979,
                                           .phase_rad = 0.4}};
  return recipe;
}

/// What a server would send for `recipe`.
inline wire::Welcome WelcomeFor(const sea::Recipe& recipe) {
  auto components = sea::BuildComponents(recipe);
  ONESEA_CHECK(components.ok()) << components.status();
  wire::Welcome welcome;
  welcome.recipe = recipe;
  welcome.component_hash = (*components)->hash;
  welcome.session.name = "test";
  welcome.session.tick_rate_hz = recipe.tick_rate_hz;
  welcome.session.component_hash = (*components)->hash;
  welcome.session.probes_m = {{0.0, 0.0}, {120.5, -33.0}, {-400.0, 77.0}};
  return welcome;
}

}  // namespace onesea::client
