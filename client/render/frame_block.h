#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "client/render/ocean_grid.h"
#include "client/render/render_frame.h"
#include "client/render/sky_light.h"

namespace onesea::render {

/// Mirror of the uniform block `Frame` (shaders/frame.glsl, std140): vectors only, so that both
/// languages agree on every offset. Positions are relative to the eye's
/// horizontal position, heights to the water level.
struct FrameBlock {
  glm::mat4 clip_from_world;
  glm::vec4 ray_forward;     // w: radians per pixel
  glm::vec4 ray_right;       // times the tangent of half the width; w: picture width
  glm::vec4 ray_up;          // times the tangent of half the height; w: picture height
  glm::vec4 eye;             // xyz: eye (0, 0, height); w: time [s], modulo an hour
  glm::vec4 sun_direction;   // w: azimuth [rad]
  glm::vec4 sun_irradiance;  // w: exposure
  glm::vec4 sky_irradiance;  // w: cloud cover
  glm::vec4 water_leaving;   // w: choppiness
  glm::vec4 crest_radiance;
  glm::vec4 foam_irradiance;  // rgb: colour of bubbly water; w: clouds' drift
  glm::vec4 haze;             // rgb: extinction [1/m]
  glm::vec4 cloud_radiance;   // w: 1 / cloud map [m]
  glm::vec4 wind;             // xy: direction, w: fold threshold of far foam
  glm::vec4 foam_window;      // xy: offset [turns], z: 1/extent, w: half extent [m], 0: none
  glm::vec4
      foam_level;  // x: below this there is no white, y: gain above it, z: log2 of cells per m
  glm::vec4 foam_detail;    // xy: offset [turns], z: 1/tile, w: log2 of texels per m
  glm::vec4 ripple_map;     // xy: offset [turns], z: 1/length, w: log2 of the texel [m]
  glm::vec4 ripple_stats;   // xyz: variance xx, yy, xy of ripples; w: 1 if drawn
  glm::vec4 fine_variance;  // xyz: slope variance held by no texture
  glm::vec4 grid;           // x: columns, y: first azimuth, z: azimuth step, w: log radius step
  glm::vec4 grid_rows;      // x: first row's log radius, y: 1 if row 0 is the nadir
  glm::vec4 counts;         // x: cascades, y: regular waves, z: texels per side, w: patches
  glm::vec4 cascade_map[kRenderCascadesMax];  // xy: offset [turns], z: 1/length, w: log2 texel [m]
  glm::vec4
      cascade_turn[kRenderCascadesMax];  // xy: cos, sin of the rotation; z: height variance [m²]
  glm::vec4 cascade_share[kRenderCascadesMax];  // xyz: xx, yy, xy of its slope variance, over their
                                                // trace; w: that trace over all cascades'
  glm::vec4 regular[kRenderRegularWavesMax];    // kx, ky, amplitude, phase at the eye
  glm::vec4 patch_map[kRenderPatchesMax];       // xy: offset under the eye, zw: 1/extent [1/m]
  glm::vec4 patch_cell[kRenderPatchesMax];      // x: log2 of the cell [m], y: layer
  glm::vec4 ground_place;                       // xy: offset under the eye, zw: 1/extent [1/m]
  glm::vec4 ground_area;        // x, y of the terrain's south-west and north-east ends [m]
  glm::vec4 ground_noise;       // xy: the eye's place modulo 4096 m; z: log2 of the texel [m];
                                // w: water level above the terrain's zero [m]
  glm::vec4 attenuation_place;  // xy: offset under the eye, zw: 1/extent [1/m]
  glm::vec4 water_kd;           // rgb: diffuse attenuation [1/m]; w: Hs of the open sea [m]
  glm::vec4 bottom_irradiance;  // rgb: daylight below the surface, seen from above it, over π
};

/// Slope variance [-] of one cascade, measured over its tile.
struct SlopeStats {
  double xx = 0, yy = 0, xy = 0;
  double height_variance_m2 = 0;
};
SlopeStats MeasureSlopes(const CascadePlanes& planes);

/// Slope variance [-] of all waves that no cascade holds: what the recipe says, or what Cox & Munk
/// (1954, clean sea: 0.003 + 0.00512 U) saw beyond the resolved part, whichever is more.
double UnresolvedSlopeVariance(const RenderFrame& frame, const std::vector<SlopeStats>& stats);

/// `ripples` is the slope variance that the ripple texture holds.
FrameBlock MakeFrameBlock(const RenderFrame& frame, const SkyLight& light, const OceanGrid& grid,
                          const std::vector<SlopeStats>& stats, const SlopeStats& ripples,
                          double ripple_length_m, int width, int height);

}  // namespace onesea::render
