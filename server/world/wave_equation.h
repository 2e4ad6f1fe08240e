#pragma once

#include "absl/status/statusor.h"
#include "server/world/wave_solver.h"

/// The two-dimensional wave equation on a region: every wave runs at c = √(g d).
namespace onesea::world {

/// (∂²/∂t² - ∇·(g d ∇)) φ = forcing, five points, explicit. Over terrain the depth of a face is
/// that at its middle; faces between water and land are closed, so waves rise at the shore and the
/// water's volume is kept. Sub-steps so that c step / cell <= 0.63.
/// InvalidArgument: no water in the region, or too many sub-steps.
/// Right for waves longer than about 10 cells (phase speed 1 % low at 11, at c step / cell = 0.3)
/// and than 20 depths; shorter waves of real water are slower: use kIwave.
absl::StatusOr<std::unique_ptr<WaveSolver>> MakeWaveEquation(const SolverSpec& spec);

}  // namespace onesea::world
