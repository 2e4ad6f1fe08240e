#pragma once

#include "server/world/wave_plane.h"

/// The vectorised passes of PotentialSolver. No operation is fused and each cell has one order of
/// operations: the same bits on every SIMD target. Columns are multiples of 16.
namespace onesea::world {

/// What both passes know of the grid. `keep_x[i] keep_y[j]` is what the absorbing border leaves of
/// a wave in a step. Values smaller than kCalm become 0, so that calm water is exactly calm and no
/// subnormal number slows the step.
struct GridPass {
  int columns = 0;
  int rows = 0;
  float* height = nullptr;  ///< (rows x columns)
  const float* keep_x = nullptr;
  const float* keep_y = nullptr;
  int border = 0;  ///< keep_x is 1 from this column to as many before the end
};
inline constexpr float kCalm = 1e-15f;

/// phi <- keep (phi - g_dt (height + pressure_head)); `keep` beside the border's is the damping.
struct PotentialPass {
  float g_dt = 0.0f;
  float keep = 1.0f;
  const float* pressure_head = nullptr;  ///< (rows x columns), or null for none
  WavePlane* phi = nullptr;
};
void AdvancePotential(const GridPass& grid, const PotentialPass& pass);

/// height <- keep_x keep_y (height - sum over the four faces of `conductance` times the step of
/// `psi` across it). Nothing crosses the rim. With faces: east[j columns + i] is the conductance
/// between cells i and i + 1, north between rows j and j + 1, and `uniform` is not read.
struct HeightPass {
  WavePlane* psi = nullptr;  ///< its margin columns beside the grid are written
  float uniform = 0.0f;
  const float* east = nullptr;
  const float* north = nullptr;
};
void AdvanceHeight(const GridPass& grid, const HeightPass& pass);

/// AdvancePotential, then AdvanceHeight with psi = phi, in one sweep over memory.
void AdvanceBoth(const GridPass& grid, const PotentialPass& potential, const HeightPass& height);

}  // namespace onesea::world
