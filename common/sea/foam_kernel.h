#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/base/vec.h"
#include "common/sea/aligned.h"
#include "common/sea/surface.h"

/// The vectorised inside of FoamWindow.
namespace onesea::sea {

inline constexpr FieldSet kFoamFields =
    Bit(Field::kJacobianXX) | Bit(Field::kJacobianYY) | Bit(Field::kJacobianXY);

/// The Jacobian of one cascade at one instant: ((N + 1) x (N + 1) x 4) of (xx, yy, xy, 0); the last
/// row and column repeat the first, so that a cell's corners need no wrapping.
struct FoamGrid {
  FoamGrid(const Cascade& cascade);
  void Fill(const CascadeFields& fields);

  int grid_size;
  double cosine, sine, cells_per_m;
  FloatArray values;
};

/// A run of foam cells along x: cells first_i, first_i + 1, ... with centres at origin + (i + ½, j
/// + ½) cell_m.
struct FoamRow {
  Vec2d origin_m;
  double cell_m = 1.0;
  std::int64_t first_i = 0;
  std::int64_t j = 0;
};

/// growth[n] = 255 clamp(gain (threshold - J), 0, 1), J the determinant of the total Jacobian at
/// the cell's centre. Depends on the cell alone, not on the run, to the bit and on every SIMD
/// target.
void FoamGrowth(std::span<const FoamGrid> grids, const FoamRow& row, float threshold, float gain,
                std::span<std::uint8_t> growth);

}  // namespace onesea::sea
