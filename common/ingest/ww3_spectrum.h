#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "common/ingest/spectrum_record.h"

/// WAVEWATCH III's ASCII point spectra ("transfer files" of its point output program).
///
///   'WAVEWATCH III SPECTRA'  50  36  1 'grid'      frequencies, directions, points
///   frequencies [Hz]; directions [rad], clockwise from north, where waves travel
///   for each time:  yyyymmdd hhmmss
///     for each point:  'name' latitude longitude depth ...
///     density [m²/Hz/rad], frequency fastest
namespace onesea::ingest {

bool IsWw3Header(absl::string_view line);

/// One record for each time and point that has energy. InvalidArgument naming file, line and field.
absl::StatusOr<std::vector<SpectrumRecord>> ParseWw3Spectra(absl::string_view name,
                                                            absl::string_view text);

}  // namespace onesea::ingest
