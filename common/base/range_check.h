#pragma once

#include <string>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"

namespace onesea {

/// InvalidArgument naming field, value and limits unless low <= value <= high. NaN is refused.
inline absl::Status CheckInRange(const std::string& field, double value, double low, double high) {
  if (value >= low && value <= high) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(field, " = ", value, " is outside [", low, ", ", high, "]"));
}

/// As CheckInRange, with `low` itself refused.
inline absl::Status CheckAbove(const std::string& field, double value, double low, double high) {
  if (value > low && value <= high) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(field, " = ", value, " is outside (", low, ", ", high, "]"));
}

}  // namespace onesea
