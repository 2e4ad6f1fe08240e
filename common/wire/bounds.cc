#include "common/wire/bounds.h"

#include "absl/strings/str_cat.h"

namespace onesea::wire {

absl::Status CheckReal(std::string_view prefix, std::string_view field, double value, double min,
                       double max) {
  if (value >= min && value <= max) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(Text(prefix), Text(field), ": ", value, " is outside [", min, ", ", max, "]"));
}

absl::Status CheckInteger(std::string_view prefix, std::string_view field, std::int64_t value,
                          std::int64_t min, std::int64_t max) {
  if (value >= min && value <= max) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(Text(prefix), Text(field), ": ", value, " is outside [", min, ", ", max, "]"));
}

absl::Status CheckSize(std::string_view prefix, std::string_view field, std::size_t size,
                       std::size_t max) {
  if (size <= max) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(Text(prefix), Text(field), ": ", size, " elements, the limit is ", max));
}

}  // namespace onesea::wire
