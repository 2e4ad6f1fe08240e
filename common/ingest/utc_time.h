#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "absl/strings/string_view.h"

/// UTC as text, "2019-02-10T05:40" (seconds only where they are not 0), so that it sorts as it
/// reads.
namespace onesea::ingest {

struct CivilTime {
  int year = 0;  ///< 0..9999
  int month = 0, day = 0, hour = 0, minute = 0, second = 0;
};

/// Nothing for a date or time that does not exist.
std::optional<std::string> FormatUtc(const CivilTime& time);

/// Accepts "2019-02-10T05:40", a blank for the T, seconds, a final Z. Nothing for anything else.
std::optional<CivilTime> ParseUtc(absl::string_view text);

/// Seconds since 1970 of a time that exists.
std::int64_t UnixSeconds(const CivilTime& time);

}  // namespace onesea::ingest
