#include "absl/strings/str_cat.h"
#include "server/world/iwave.h"
#include "server/world/shallow_water.h"
#include "server/world/wave_equation.h"
#include "server/world/wave_solver.h"

namespace onesea::world {

absl::StatusOr<std::unique_ptr<WaveSolver>> MakeSolver(const SolverSpec& spec) {
  switch (spec.kind) {
    case SolverKind::kIwave:
      return MakeIwave(spec);
    case SolverKind::kWaveEquation:
      return MakeWaveEquation(spec);
    case SolverKind::kShallowWater:
      return MakeShallowWater(spec);
  }
  return absl::InvalidArgumentError(
      absl::StrCat("region.kind = ", static_cast<int>(spec.kind), " is not a solver"));
}

}  // namespace onesea::world
