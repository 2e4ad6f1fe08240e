#pragma once

#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/string_view.h"
#include "common/ingest/spectrum_axis.h"
#include "common/ingest/text_lines.h"

namespace onesea::ingest {

/// Numbers that run on over line ends, as Fortran writes arrays.
class FieldStream {
 public:
  explicit FieldStream(TextLines& lines) : lines_(lines) {}

  /// The next field, from the next line if this one is used up; Truncated at the end of the file.
  absl::StatusOr<absl::string_view> Take(absl::string_view name) {
    absl::string_view field = TakeField(rest_);
    while (field.empty()) {
      if (!lines_.Next()) return lines_.Truncated(name);
      rest_ = lines_.line();
      field = TakeField(rest_);
    }
    return field;
  }

  absl::StatusOr<double> TakeReal(absl::string_view name) {
    const absl::StatusOr<absl::string_view> field = Take(name);
    if (!field.ok()) return field.status();
    const std::optional<double> value = ParseReal(*field);
    if (!value) return lines_.Bad(name, *field, "a number");
    return *value;
  }

  /// In [0, kDensityMax].
  absl::StatusOr<double> TakeDensity(absl::string_view name) {
    absl::StatusOr<double> value = TakeReal(name);
    if (value.ok() && !(*value >= 0.0 && *value <= kDensityMax)) {
      return lines_.Error(name, absl::StrCat(*value, " is not in [0, ", kDensityMax, "]"));
    }
    return value;
  }

 private:
  TextLines& lines_;
  absl::string_view rest_;
};

}  // namespace onesea::ingest
