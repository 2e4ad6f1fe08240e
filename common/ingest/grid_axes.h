#pragma once

#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "common/sea/sea_state.h"

/// From the directions and matrices of wave-model files to a GridSpectrum, whose directions ascend
/// within one turn.
namespace onesea::ingest {

/// The columns of a grid in terms of those of a file.
struct DirectionAxis {
  std::vector<float> wave_to_rad;  ///< (m) ascending in [0, 2π)
  std::vector<int> source_column;  ///< (m) column of the file; -1: none, no energy
  int file_columns = 0;
};

/// Sorts directions of travel. Directions within `rounding_rad` of an even division of the circle
/// are put on it, since three printed digits would else make unequal cells. Where they cover only a
/// sector, a column without energy is added at either end, lest the outermost ones be taken to hold
/// half of the empty rest. InvalidArgument (without place): fewer than 2 or more than
/// kSpectrumDirectionsMax, or two directions equal.
absl::StatusOr<DirectionAxis> SortDirections(std::span<const double> wave_to_rad,
                                             double rounding_rad);

/// Appends one frequency's values (file order, density per hertz and radian).
void AppendGridRow(const DirectionAxis& axis, std::span<const float> density_m2_per_hz_rad,
                   sea::GridSpectrum& grid);

}  // namespace onesea::ingest
