#pragma once

#include "absl/status/statusor.h"
#include "server/world/wave_solver.h"

/// Dispersive waves on a region: ω² = g k tanh(kd) for any cell size and depth within the band that
/// iwave_design.h states. Over terrain waves shoal, refract and are turned back by the shore; land
/// is closed, and volume and energy are kept.
namespace onesea::world {

/// InvalidArgument: no water in the region, or cells so small that step_s needs too many sub-steps.
/// Cost of building: 1 ms over a flat bottom, 50 ms over terrain.
absl::StatusOr<std::unique_ptr<WaveSolver>> MakeIwave(const SolverSpec& spec);

}  // namespace onesea::world
