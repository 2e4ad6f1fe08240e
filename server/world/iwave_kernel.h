#pragma once

#include "server/world/iwave_design.h"
#include "server/world/wave_plane.h"

/// The vectorised passes of iWave's operator. No operation is fused and each cell has one order of
/// operations: the same bits on every SIMD target.
namespace onesea::world {

/// out = kernel * in, from rows `first_row` to `last_row` - 1 and columns from `first_column` (a
/// multiple of 16) to `last_column` - 1. Reads 4 cells beyond, which must be finite: the margin's
/// zeros, or neighbours.
struct ConvolveRange {
  int first_column = 0;
  int last_column = 0;
  int first_row = 0;
  int last_row = 0;
};
void Convolve(const WavePlane& in, const IwaveTaps& taps, const ConvolveRange& range,
              WavePlane& out);

/// Cells of a range whose rows are filled up to multiples of 16.
inline std::size_t PackedCells(const ConvolveRange& range) {
  const int pitch = (range.last_column - range.first_column + 15) / 16 * 16;
  return static_cast<std::size_t>(pitch) * (range.last_row - range.first_row);
}

/// out = weight in, and sum += weight in, cell by cell; `weight` has PackedCells(range) values, row
/// after row.
void Weigh(const WavePlane& in, const float* weight, const ConvolveRange& range, WavePlane& out);
void AddWeighed(const WavePlane& in, const float* weight, const ConvolveRange& range,
                WavePlane& sum);

/// Differences of a potential across the faces of its cells, times `open` (1, or 0 where a face is
/// closed): x(i, j) between cells i and i + 1, y(i, j) between rows j and j + 1.
struct FacePlanes {
  WavePlane x, y;
};
void FaceDifferences(const WavePlane& phi, const FacePlanes& open, FacePlanes& difference);

/// height <- keep_x keep_y (height - scale (what leaves through the open faces)).
struct GridPass;
void AdvanceHeightByFlow(const GridPass& grid, const FacePlanes& flow, const FacePlanes& open,
                         float scale);

/// coarse = R fine. Pre: coarse has half of fine's columns and rows.
void Restrict(const WavePlane& fine, WavePlane& coarse);

/// fine += P coarse.
void ProlongAdd(const WavePlane& coarse, WavePlane& fine);

}  // namespace onesea::world
