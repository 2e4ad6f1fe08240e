#pragma once

#include <cstddef>

#include "common/sea/aligned.h"

/// The vectorised inside of the shallow-water solver. shallow_water.h explains the scheme.
namespace onesea::world {

/// Lines that one strip of a sweep holds, on every SIMD target.
inline constexpr int kStripLines = 32;

/// Floats behind each natural row: one cache line, since power-of-two strides share L1 sets.
inline constexpr int kRowPadding = 16;

/// Film [m] that doesn't flow: below it a face is shut, so that no product underflows.
inline constexpr float kFilmDepthM = 1e-6f;
/// Cells with less water [m] than this report a height and a velocity of zero.
inline constexpr float kDryDepthM = 1e-3f;

struct ShallowFields {
  int columns = 0;
  int rows = 0;
  std::size_t pitch =
      0;  ///< of the natural arrays; padded, since power-of-two strides share L1 sets

  // (rows x pitch), row-major: "natural".
  sea::FloatArray level;   ///< eta [m], of the water, or of the ground where there is none
  sea::FloatArray bottom;  ///< b [m]; level >= bottom always
  sea::FloatArray v;       ///< [m/s] through the north face of each cell

  // (rows / kStripLines x columns x kStripLines): lines along x are lanes.
  sea::FloatArray bottom_across;
  sea::FloatArray u;  ///< [m/s] through the east face of each cell

  sea::FloatArray height;          ///< (rows x columns) eta, 0 where dry
  sea::FloatArray keep_x, keep_y;  ///< (columns), (rows): share of waves kept in one step
  sea::FloatArray zeros;           ///< (rows x columns)

  // Of the step.
  float step_s = 0.0f;
  float step_per_cell = 0.0f;  ///< lambda = dt / dx [s/m]
  float theta = 0.5f;
  float keep_velocity = 1.0f;  ///< exp(-damping dt)
  float velocity_max = 0.0f;   ///< [m/s] of the faces
  bool open = false;           ///< waves leave through the outer faces

  // Scratch of one strip: (max(columns, rows) + kRowPadding) x kStripLines each.
  sea::FloatArray gain, offset, depth, moved, flux, level_across, pressure_across, solid_across;
};

/// Null or (rows x columns) row-major.
struct ShallowForcing {
  const float* source_m = nullptr;
  const float* pressure_head_m = nullptr;
  const float* solid = nullptr;
  const float* rest_height_m = nullptr;
};

/// One step: a sweep along x, then one along y.
void StepShallowWater(ShallowFields& fields, const ShallowForcing& forcing);

/// Of the water at the surface of every cell [m/s], (rows x columns) each; `per_cell` is 1 / dx.
/// Uses the fields' scratch.
void ShallowWaterVelocities(const ShallowFields& fields, float per_cell, float* x, float* y,
                            float* z);

}  // namespace onesea::world
