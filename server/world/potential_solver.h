#pragma once

#include <cstdint>
#include <vector>

#include "server/world/potential_kernel.h"
#include "server/world/wave_solver.h"

/// What the linear solvers share: surface elevation η and surface potential φ, one of each per
/// cell, half a step apart.
///
///   ∂φ/∂t = -g (η + p/ρg),   ∂η/∂t = Λφ + sources
///
/// Λ, symmetric and without negative eigenvalue, is what makes the waves: -∇·(d ∇) for the wave
/// equation, k tanh(kd) for iWave. The step is symplectic (leapfrog): without damping ½g⟨η,η⟩ +
/// ½⟨φ,Λφ⟩ is kept for ever but for a ripple that depends on the step, and ω is that of Λ while
/// ω step < 2. Pressure and surface velocity (∇φ, Λφ) come for free.
///
/// Border: over `edge_cells` both fields fall as exp(-σ t), σ growing as the square of the way in,
///   and the outermost cells drain as if the wave ran on (c η leaves through the rim), which
///   swallows what is too long for the border. Borders 16 cells wide send back 1-9 % of a ring wave
///   that is 10 to 20 cells long (tests/world/linear_solvers_test.cc), about 17 % of 40 cells.
/// Damping: φ alone falls as exp(-damping t): no stiffness, and a flat offset stays.
/// Solids: a cell of share s approaches its rest height as (1-s)^(t / kSolidS), whatever the step,
///   and its potential fades within kSolidMemoryS: waves reflect there, with their sign turned, as
///   in iWave's masks. Water that flows into such a cell is lost or gained there. Land does better:
///   nothing crosses its faces.
namespace onesea::world {

inline constexpr double kSolidS = 0.05;
inline constexpr double kSolidMemoryS = 10.0;  // longer than a swell's period
inline constexpr int kSubstepsMax = 16;

class PotentialSolver : public WaveSolver {
 public:
  const SolverSpec& spec() const override { return spec_; }
  void Step(const StepForcing& forcing) override;
  std::span<const float> height_m() const override { return {height_.get(), cells_}; }
  void Velocity(std::span<float> x, std::span<float> y, std::span<float> z) const override;
  void Adopt(const WaveSolver& other) override;
  std::vector<float> State() const override;
  void Restore(std::span<const float> state) override;

  int substeps() const { return substeps_; }

 protected:
  /// `border_speed_m_per_s`: of the waves that the absorbing border is made for.
  PotentialSolver(const SolverSpec& spec, int substeps, double border_speed_m_per_s);

  /// One sub-step of both fields.
  virtual void Advance(const GridPass& grid, const PotentialPass& potential) = 0;
  /// Λφ for the potential as it is: after the last sub-step, or PotentialChanged.
  virtual void Outflow(std::span<float> m_per_s) const = 0;
  /// The potential was restored or adopted: what is derived from it is stale.
  virtual void PotentialChanged(WavePlane& phi) = 0;

  double SubstepS() const { return spec_.step_s / substeps_; }
  /// Depth of still water [m] at a place in cells from the region's south-west cell; <= 0 on land.
  double DepthAt(double column, double row) const;
  bool HasLand() const { return !wet_.empty(); }
  bool Wet(int column, int row) const {
    return wet_.empty() || wet_[static_cast<std::size_t>(row) * spec_.cells.columns + column] != 0;
  }
  const WavePlane& phi() const { return phi_; }

 private:
  GridPass Grid();
  void AddSource(std::span<const float> source_m);
  void DrainRim();
  void SlopeAlongX(int row, std::span<float> x) const;
  void SlopeAlongY(int row, std::span<const float> potential, std::span<float> y) const;
  void HoldSolids(const StepForcing& forcing);

  SolverSpec spec_;
  std::size_t cells_;
  int substeps_;
  sea::FloatArray height_;           // η [m], (rows x columns)
  WavePlane phi_;                    // φ [m²/s]; its margin belongs to the kind of solver
  sea::FloatArray keep_x_, keep_y_;  // of the absorbing border, per sub-step
  float rim_keep_ = 1.0f;            // of the outermost cells' height, per sub-step
  std::vector<std::uint8_t> wet_;    // one per cell; empty: no land
};

/// The depth of the deepest cell [m]; 0 if there is no water, or on a flat bottom without a depth.
double GreatestDepth(const SolverSpec& spec);

/// The least count of sub-steps for which waves of `omega_max` rad/s are stable with a margin, or
/// InvalidArgument if it were above kSubstepsMax.
absl::StatusOr<int> SubstepsFor(const SolverSpec& spec, double omega_max_rad_per_s);

}  // namespace onesea::world
