#pragma once

#include <memory>

#include "common/wire/frame.h"

namespace onesea::server {

/// A small valid welcome: one cascade, one JONSWAP system, eight probes.
inline std::shared_ptr<const wire::Welcome> SampleWelcome() {
  auto welcome = std::make_shared<wire::Welcome>();
  welcome->recipe.cascades = {{.length_m = 1000.0,
                               .rotation_rad = 0.1,
                               .wavenumber_min_rad_per_m = 0.01,
                               .wavenumber_max_rad_per_m = 0.15,
                               .query_grid_size = 256}};
  sea::WeatherEntry entry;
  entry.sea.systems = {sea::JonswapSystem{}};
  welcome->recipe.timeline = {entry};
  welcome->component_hash = 0x1234;
  welcome->session.name = "sample";
  for (int n = 0; n < 8; ++n) welcome->session.probes_m.push_back({10.0 * n, 0.0});
  return welcome;
}

}  // namespace onesea::server
