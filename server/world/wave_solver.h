#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "common/sea/cell_rect.h"
#include "common/sea/terrain.h"

/// A region of the interaction layer: waves on a grid of cells, beside the spectral sea.
namespace onesea::world {

enum class SolverKind : std::uint8_t {
  kIwave = 1,         ///< dispersive, omega² = g k tanh kd within its band
  kWaveEquation = 2,  ///< non-dispersive, c² = g d
  kShallowWater = 3,  ///< Kass-Miller over terrain, wetting and drying
};

struct SolverSpec {
  SolverKind kind = SolverKind::kIwave;
  sea::CellRect cells;
  double step_s = 1.0 / 60.0;
  double depth_m = 0.0;  ///< of flat bottom; 0 = infinitely deep (kIwave only)
  std::shared_ptr<const sea::Terrain> terrain;  ///< null: flat bottom at depth_m
  double damping_per_s = 0.0;  ///< energy of every wave falls as exp(-damping t), stiffness apart
  int edge_cells = 16;         ///< width of the absorbing border on each side
};

/// What acts on the water in one step. Spans have one float per cell, or none for "nothing".
struct StepForcing {
  std::span<const float> source_m = {};  ///< height added in this step (volume per cell area)
  std::span<const float> pressure_head_m = {};  ///< p / (rho g) on the surface during this step
  std::span<const float> solid = {};  ///< share of the cell that a hull or wall fills, 0..1
  std::span<const float> rest_height_m =
      {};  ///< what solid cells are held at: minus the incident sea
           ///< where the total must stand still; none: 0
};

/// One solver on one rectangle; heights are relative to the mean water level and add to the
/// spectral sea. Deterministic: same spec and forcing, same bits on every machine and SIMD width.
/// Not thread-safe.
class WaveSolver {
 public:
  virtual ~WaveSolver() = default;
  virtual const SolverSpec& spec() const = 0;

  /// Advances by spec().step_s. Allocates nothing. Pre: spans are empty or have one float per cell,
  /// all finite.
  virtual void Step(const StepForcing& forcing) = 0;

  /// Elevation of the surface [m], one per cell; 0 on dry cells.
  virtual std::span<const float> height_m() const = 0;
  /// Velocity of the water at the surface [m/s] into three arrays of one float per cell.
  virtual void Velocity(std::span<float> x, std::span<float> y, std::span<float> z) const = 0;

  /// Adds the waves of `other` where the rectangles overlap: how a region moves, grows and merges
  /// without losing a wave. Pre: same kind, cell_m and step_s.
  virtual void Adopt(const WaveSolver& other) = 0;

  /// Everything that the next step depends on, for hashes and snapshots; Restore(State()) is the
  /// identity, bit for bit. Planes of one float per cell, row-major; how many is the kind's affair.
  virtual std::vector<float> State() const = 0;
  virtual void Restore(std::span<const float> state) = 0;
};

/// What holds for every kind: InvalidArgument naming field, value and limit.
absl::Status ValidateSolverSpec(const SolverSpec& spec);

/// InvalidArgument naming field, value and limit (cell counts, unstable step, no depth where one is
/// needed).
absl::StatusOr<std::unique_ptr<WaveSolver>> MakeSolver(const SolverSpec& spec);

}  // namespace onesea::world
