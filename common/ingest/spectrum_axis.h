#pragma once

#include <vector>

#include "absl/status/status.h"
#include "common/base/limits.h"
#include "common/ingest/text_lines.h"

namespace onesea::ingest {

/// What ValidateSeaState() takes, checked where the file's line is still known.
inline constexpr double kFrequencyMinHz = 1.0 / (10.0 * kPeriodMaxS);
inline constexpr double kFrequencyMaxHz = 1.0 / kPeriodMinS;
inline constexpr double kDensityMax = 1e6;  ///< [m²/Hz] or [m²/Hz/rad]

/// Appends a frequency, if it is within the limits and above the last one, and there is room.
absl::Status AppendFrequency(const TextLines& lines, double hz, std::vector<float>& frequency_hz);

}  // namespace onesea::ingest
