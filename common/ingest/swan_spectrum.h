#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "common/ingest/spectrum_record.h"

/// SWAN's spectral files, 2-D or 1-D, several places and times, stationary or not (see
/// swan_header.h).
///
/// A block is FACTOR with a matrix of whole numbers (a row for each frequency), ZERO, NODATA, or
/// LOCATION with a row of quantities for each frequency. Densities per degree become densities per
/// radian; energy becomes variance by SWAN's rho = 1025, g = 9.81. 1-D files with a direction and
/// DSPR give buoy spectra: r1 = 1 - DSPR²/2, and second moments of cos^2s.
namespace onesea::ingest {

bool IsSwanHeader(absl::string_view line);

/// One record for each time and place that has energy; ZERO and NODATA give none. InvalidArgument
/// naming file, line and field. Directions of a Cartesian model are taken to have their x-axis
/// pointing east.
absl::StatusOr<std::vector<SpectrumRecord>> ParseSwanSpectra(absl::string_view name,
                                                             absl::string_view text);

}  // namespace onesea::ingest
