#pragma once

#include <glm/vec3.hpp>

#include "client/render/render_frame.h"

namespace onesea::render {

/// Optical constants of a Jerlov water type at 610, 545 and 460 nm.
///
///   symbol      unit  meaning
///   kd          1/m   diffuse attenuation of daylight
///   absorption  1/m   a
///   reflectance -     irradiance reflectance just below the surface, 0.33 b_b / a
///
/// Source: Kd from Jerlov 1976 and Austin & Petzold 1984; a = 0.9 Kd (1 - 2.25 R);
///   b_b from chlorophyll fits (oceanic) or 0.018 of the particle scattering (coastal).
struct WaterOptics {
  glm::vec3 kd, absorption, reflectance;
};
const WaterOptics& OpticsOf(WaterType type);

/// Radiance that leaves the sea upwards [per steradian], for a downward irradiance just above it:
/// L = E · 0.54 · R / Q with Q = 4; 0.54 is transmission both ways over n² (Austin 1974).
glm::vec3 WaterLeavingRadiance(const WaterOptics& optics, const glm::vec3& irradiance);

/// The same for water full of fine bubbles, as in a breaking crest: backscattering `bubbles_per_m`
/// (white) added.
glm::vec3 BubblyReflectance(const WaterOptics& optics, float bubbles_per_m);

}  // namespace onesea::render
