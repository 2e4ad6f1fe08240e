#pragma once

#include <memory>
#include <string>

#include "common/base/check.h"
#include "common/sea/components.h"
#include "common/wire/session_spec.h"

namespace onesea {

/// A sea that is built in milliseconds: one cascade of 200 m, one JONSWAP system.
inline sea::SeaState SmallSea(double hs_m = 1.0) {
  sea::SeaState sea;
  sea.name = "small";
  sea::JonswapSystem system;
  system.hs_m = hs_m;
  system.tp_s = 5.0;
  sea.systems.push_back(system);
  sea.wind_speed_m_per_s = 7.0;
  return sea;
}

inline SessionSpec SmallSession(const std::string& name = "small") {
  SessionSpec spec;
  spec.name = name;
  sea::Cascade cascade;
  cascade.length_m = 200.0;
  cascade.rotation_rad = 0.3;
  cascade.wavenumber_min_rad_per_m = 0.0;
  cascade.wavenumber_max_rad_per_m = 0.24;  // 64 points: at most 2π/200 · 64/8 = 0.2513
  cascade.query_grid_size = 64;
  spec.recipe.cascades = {cascade};
  spec.recipe.timeline.push_back({0, 0, SmallSea()});
  spec.probes_m = {{0.0, 0.0}, {30.0, -7.0}, {1000.5, 99.0}};
  return spec;
}

inline std::shared_ptr<const sea::Components> BuildOrDie(const sea::Recipe& recipe) {
  auto components = sea::BuildComponents(recipe);
  ONESEA_CHECK(components.ok()) << components.status().ToString();
  return *components;
}

}  // namespace onesea
