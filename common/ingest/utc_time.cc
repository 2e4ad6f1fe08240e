#include "common/ingest/utc_time.h"

#include <chrono>

#include "absl/strings/str_format.h"

namespace onesea::ingest {
namespace {

bool Exists(const CivilTime& time) {
  const std::chrono::year_month_day date{std::chrono::year(time.year),
                                         std::chrono::month(static_cast<unsigned>(time.month)),
                                         std::chrono::day(static_cast<unsigned>(time.day))};
  return time.year >= 0 && time.year <= 9999 && time.month >= 1 && time.month <= 12 &&
         time.day >= 1 && time.day <= 31 && date.ok() && time.hour >= 0 && time.hour <= 23 &&
         time.minute >= 0 && time.minute <= 59 && time.second >= 0 && time.second <= 59;
}

bool TakeDigits(absl::string_view& text, std::size_t count, int& value) {
  if (text.size() < count) return false;
  value = 0;
  for (const char c : text.substr(0, count)) {
    if (c < '0' || c > '9') return false;
    value = 10 * value + (c - '0');
  }
  text.remove_prefix(count);
  return true;
}

bool TakeOneOf(absl::string_view& text, absl::string_view characters) {
  if (text.empty() || characters.find(text.front()) == absl::string_view::npos) return false;
  text.remove_prefix(1);
  return true;
}

}  // namespace

std::optional<std::string> FormatUtc(const CivilTime& time) {
  if (!Exists(time)) return std::nullopt;
  std::string text = absl::StrFormat("%04d-%02d-%02dT%02d:%02d", time.year, time.month, time.day,
                                     time.hour, time.minute);
  if (time.second != 0) absl::StrAppendFormat(&text, ":%02d", time.second);
  return text;
}

std::optional<CivilTime> ParseUtc(absl::string_view text) {
  CivilTime time;
  const bool has_minute =
      TakeDigits(text, 4, time.year) && TakeOneOf(text, "-") && TakeDigits(text, 2, time.month) &&
      TakeOneOf(text, "-") && TakeDigits(text, 2, time.day) && TakeOneOf(text, "T ") &&
      TakeDigits(text, 2, time.hour) && TakeOneOf(text, ":") && TakeDigits(text, 2, time.minute);
  if (!has_minute) return std::nullopt;
  if (TakeOneOf(text, ":") && !TakeDigits(text, 2, time.second)) return std::nullopt;
  TakeOneOf(text, "Z");
  if (!text.empty() || !Exists(time)) return std::nullopt;
  return time;
}

std::int64_t UnixSeconds(const CivilTime& time) {
  const std::chrono::sys_days date = std::chrono::year_month_day{
      std::chrono::year(time.year), std::chrono::month(static_cast<unsigned>(time.month)),
      std::chrono::day(static_cast<unsigned>(time.day))};
  const std::int64_t days = date.time_since_epoch().count();
  return ((days * 24 + time.hour) * 60 + time.minute) * 60 + time.second;
}

}  // namespace onesea::ingest
