#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "client/render/atmosphere.h"
#include "client/render/render_frame.h"

namespace onesea::render {

/// The sky as the water sees it: a map of radiance over the upper half sphere, once sharp and
/// thrice blurred for rough reflection, and what follows from it.
///
/// Map: (kBlurLevels x kRows x kColumns); column i is azimuth 2π i / kColumns from the sun's;
/// row j is elevation asin((j / (kRows - 1))²), so that the horizon is finely sampled.
struct SkyLight {
  static constexpr int kColumns = 256, kRows = 96, kBlurLevels = 4;
  /// Standard deviation [rad] of each level's Gaussian.
  static constexpr double kBlurRad[kBlurLevels] = {0.0, 0.1, 0.25, 0.55};

  std::vector<glm::vec3> radiance;  ///< [1/sr], clouds included on average
  glm::vec3 sun_irradiance{0};      ///< at normal incidence, behind air and clouds
  glm::vec3 sky_irradiance{0};      ///< on a horizontal surface, without the sun
  glm::vec3 cloud_radiance{0};      ///< of a cloud's evenly lit side [1/sr]
  glm::vec3 extinction_per_m{0};    ///< of the air at sea level
  double exposure = 1.0;            ///< brings the metered sky to 0.45
};

/// Cost: about 60 ms, one core: call it when sun or clouds change, not per frame.
SkyLight ComputeSkyLight(const Atmosphere& atmosphere, const Sun& sun, double cloud_cover,
                         double visibility_m);

}  // namespace onesea::render
