#pragma once

#include <string_view>

#include "absl/status/statusor.h"
#include "onesea/v1/recipe.pb.h"

/// Directions: nautical degrees "coming from" become radians of travel by exactly rounded
/// operations alone, so that every machine reads the same number from the same file.
namespace onesea::wire {

/// 270° - from, reduced to [0, 360) and turned to radians: one subtraction, one fmod (exact), one
/// product.
double ToRadFromNauticalDeg(double from_deg);

/// Radians, counter-clockwise from east, where waves travel to. Unset: `fallback_rad`.
/// InvalidArgument for NaN, |to_rad| > 4π or |from_deg| > 360.
absl::StatusOr<double> DirectionFromProto(const v1::Direction& direction, std::string_view prefix,
                                          std::string_view field, double fallback_rad = 0.0);

}  // namespace onesea::wire
