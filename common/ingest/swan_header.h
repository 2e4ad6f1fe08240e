#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "common/ingest/grid_axes.h"
#include "common/ingest/text_lines.h"

/// The head of SWAN's spectral files: what follows is a sequence of blocks, one for each time and
/// place.
///
///   SWAN 1 / TIME, coding / LONLAT or LOCATIONS, n, n pairs / AFREQ or RFREQ, n, n values /
///   NDIR or CDIR, n, n values / QUANT, n, n times (name, unit, exception value)
namespace onesea::ingest {

enum class SwanQuantity { kVarianceDensity, kEnergyDensity, kDirection, kSpread, kOther };

struct SwanColumn {
  SwanQuantity quantity = SwanQuantity::kOther;
  bool is_nautical = false;  ///< kDirection only: coming from, clockwise from north
  double exception_value = 0.0;
};

/// Longitude and latitude if has_lon_lat, else metres in the model's frame.
struct SwanPlace {
  double x = 0.0, y = 0.0;
};

struct SwanHeader {
  bool has_time = false;
  bool has_lon_lat = false;
  bool is_relative_frequency = false;
  std::vector<SwanPlace> places;    ///< at least one place is meant even where the file names none
  std::vector<float> frequency_hz;  ///< ascending, > 0
  std::vector<double> wave_to_rad;  ///< file order; none: 1-D spectra
  DirectionAxis axis;               ///< unused for 1-D
  std::vector<SwanColumn> columns;  ///< 2-D: the density alone
};

/// Reads up to and including QUANT. InvalidArgument with file, line and field.
absl::StatusOr<SwanHeader> ParseSwanHeader(TextLines& lines);

/// Moves to the next line that is neither blank nor a comment.
bool NextSwanLine(TextLines& lines);

/// The first word of a line in upper case: SWAN's keywords are not sensitive to case.
std::string SwanKeyword(absl::string_view line);

}  // namespace onesea::ingest
