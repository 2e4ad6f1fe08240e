#pragma once

#include <array>
#include <cstddef>

/// The convolution kernels of the iWave solver.
///
/// Problem: waves need the operator k tanh(kd). A kernel of 13 x 13 cells for it (Tessendorf's
/// iWave) is right for a narrow band only: long waves don't fit into it, short ones are cut off,
/// its sum is not zero, and it has one depth and one cell size.
///
/// Idea: write k tanh(kd) as -∇·T∇ with the five-point gradient, T = tanh(kd)/k; then the sum is
/// zero and volume is kept whatever T is. T times the potential is ∫φ dz over the depth. T is a
/// pyramid: a 9 x 9 kernel on the cells, plus one on every second cell, and so on:
///
///   T = M₀ + P (M₁ + P (M₂ + ...) R) R,   P = 4 Rᵀ,
///
/// R the binomial low-pass of 7 x 7 cells and decimation by 2. All levels are found together by
/// least squares of the relative error of T's symbol over the wavenumber plane, so each makes good
/// what its neighbours lack. The time step's own error is corrected in the same way: the target is
/// 4/τ sin²(√(τ k tanh kd)/2) / k², τ = g step²/cell, which makes leapfrog's frequency exact.
///
/// Band: |frequency error| <= 0.3 % where 1 / 2^(levels - 1) <= k cell <= 2.4, that is waves of 2.6
///   cells to 6 · 2^(levels - 1) (201 cells in a region of 256), 0.7 % from k = 0 on in water up to
///   2^(levels - 1) / 2 cells deep; longer waves in deeper water are too slow. The image that
///   decimation makes of a wave is below 2 % of it. (tests/world/iwave_design_test.cc)
/// Stability: T's symbol is positive over the whole Brillouin zone, and what it stands for,
///   k tanh(kd), is below kIwaveSymbolMax.
namespace onesea::world {

inline constexpr int kIwaveRadius = 4;
inline constexpr int kIwaveLevelsMax = 6;
inline constexpr double kIwaveSymbolMax = 4.8;
/// Deeper than this many cells is infinitely deep to a kernel.
inline constexpr double kIwaveDeepCells = 128.0;

/// Taps (i, j) with 0 <= j <= i <= 4, in the order (0,0), (1,0), (1,1), (2,0), ...; they hold for
/// (±i, ±j) and (±j, ±i).
inline constexpr std::size_t kIwaveTaps = (kIwaveRadius + 1) * (kIwaveRadius + 2) / 2;
using IwaveTaps = std::array<float, kIwaveTaps>;

struct IwaveKernels {
  int levels = 0;  ///< <= kIwaveLevelsMax; those above are zero
  std::array<IwaveTaps, kIwaveLevelsMax> taps{};
};

/// Kernels for water `depth_cells` deep (> 0, infinity allowed) and τ = g step²/cell; as many
/// levels as the depth needs, at most `levels_max`. The same bits on every machine. Cost: 1 ms.
IwaveKernels DesignIwave(double depth_cells, double step_number, int levels_max);

/// T's symbol, without the images, at (qx, qy) [rad/cell].
double IwaveSymbol(const IwaveKernels& kernels, double qx, double qy);

/// Levels for which the coarsest grid of a region still has 8 cells.
int IwaveLevelsFor(int columns, int rows);

}  // namespace onesea::world
