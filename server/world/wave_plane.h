#pragma once

#include <cstddef>

#include "common/base/limits.h"
#include "common/sea/aligned.h"

/// A grid of floats with a margin of zeros, so that stencils need no special case at the rim.
namespace onesea::world {

struct WavePlane {
  static constexpr int kMarginRows = 4;      ///< below and above
  static constexpr int kMarginColumns = 16;  ///< left; right twice that and what fills a cache line

  static constexpr int kColumnsMax = kRegionSideMax;

  WavePlane() = default;
  WavePlane(int columns_in, int rows_in)
      : columns(columns_in),
        rows(rows_in),
        pitch((static_cast<std::size_t>(columns_in) + 15) / 16 * 16 + 3 * kMarginColumns),
        data(sea::AllocateZeros<float>(pitch *
                                       (static_cast<std::size_t>(rows_in) + 2 * kMarginRows))) {}

  /// Row y from column 0 on, on a cache line. y in [-kMarginRows, rows + kMarginRows).
  float* Row(int y) { return data.get() + Offset(y); }
  const float* Row(int y) const { return data.get() + Offset(y); }
  std::size_t Offset(int y) const {
    return static_cast<std::size_t>(y + kMarginRows) * pitch + kMarginColumns;
  }

  int columns = 0;
  int rows = 0;
  std::size_t pitch = 0;
  sea::FloatArray data;  ///< (rows + 2 kMarginRows) x pitch
};

}  // namespace onesea::world
