#pragma once

#include <memory>

#include "absl/status/statusor.h"
#include "server/world/wave_solver.h"

/// Shallow water over terrain: what Kass and Miller (1990) made cheap, on a staggered grid.
///
///   ∂η/∂t = -∂(H u)/∂x - ∂(H v)/∂y + s,   ∂u/∂t = -g ∂(η + p)/∂x - α u,   the same for v
///
///   η  m     level of the water above the mean, at cell centres; on dry land the ground's
///   b  m     the bottom, η >= b;  H = η - b, on a face see below
///   u  m/s   mean velocity over the depth, through the east face of a cell; v: the north face
///   p  m     pressure head on the surface
///   α  1/s   damping_per_s: energy of a wave falls as exp(-α t)
///
/// A step is a sweep along x for (η, u), then one along y for (η, v). Each line is a tridiagonal
/// system of the theta scheme: the new level and velocity have the weight θ in both equations, the
/// depths are those of the beginning. In one sweep a wave that the grid's own frequency ω belongs
/// to is multiplied by (1 - i(1-θ)ω dt) / (1 + iθ ω dt): for θ = 1/2 no energy is lost at any step,
/// and any step is stable; kShallowTheta loses (2θ-1)(ω dt)² of it, nothing but the shortest waves.
/// (Kass and Miller's θ = 1 on η alone loses half of the energy of a wave of ω dt = 1.) A wave's
/// frequency on the grid is ω = 2c/dx sin(k dx/2) along an axis, c² = g H, then tan(ω' dt/2) = ω
/// dt/2; along a diagonal tan²(ω' dt/2) = a² + b² + a²b² of the two axes' a, b.
///
/// Wetting and drying: water crosses a face over the higher of the two grounds, with the level
/// upstream; no cell gives more than it holds (the fluxes out of it are scaled); where water
/// reaches a dry face it has the velocity of the wet face behind it; sheets under 0.1 m are slowed
/// by friction. Levels change by fluxes only, so volume is kept to rounding, and a flat lake stays
/// exactly flat over any bottom and around any island.
///
/// Absorbing edges (edge_cells > 0): the outer faces let waves leave with √(gH), exact at normal
/// incidence, and waves fade over edge_cells; the level far outside is 0. Of a round wave some 4 to
/// 13 % comes back, the less the shorter it is. edge_cells = 0: walls.
///
/// Solids: without rest heights a cell's faces are open to 1 - solid: walls reflect and volume is
/// kept. With rest heights the level of a solid cell is held there instead (water is exchanged with
/// the body). Both act at a rate, so the number of steps doesn't matter.
///
/// What it can't do: there is no dispersion (every wave runs at √(gH); use it where kH < 0.5, an
/// error of 4 % in speed), no advection of momentum (no bores or hydraulic jumps of the right
/// speed; the run-up of a wave that doesn't break is some 15 % high, a basin that swings with
/// moving shores loses 8 % a period), no breaking, no bottom friction but that of thin sheets, no
/// Coriolis force, one layer. Velocities are bounded by that of a broken dam as high as the
/// region's relief.
///
/// Cost: see docs/measurements.md; 256² takes some 0.15 ms with AVX-512. Memory: 40 bytes a
/// cell. Bits: every line is a lane, in a fixed order of operations, never fused.
///
/// Source: M. Kass, G. Miller, "Rapid, stable fluid dynamics for computer graphics", Computer
/// Graphics 24(4), 1990, for the idea; depths at faces after G. S. Stelling, S. P. A. Duinmeijer,
/// "A staggered conservative scheme for every Froude number in rapidly varied shallow water flows",
/// Int. J. Numer. Meth. Fluids 43, 2003.
namespace onesea::world {

/// Weight of the new state. [0.5, 1]
inline constexpr double kShallowTheta = 0.505;

/// At rest: wet everywhere that lies below the mean level. InvalidArgument naming field, value and
/// limit: besides ValidateSolverSpec(), a flat bottom needs depth_m > 0.
absl::StatusOr<std::unique_ptr<WaveSolver>> MakeShallowWater(const SolverSpec& spec,
                                                             double theta = kShallowTheta);

}  // namespace onesea::world
