#include "common/ingest/ndbc_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/strip.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/ingest/spectrum_axis.h"
#include "common/ingest/text_lines.h"
#include "common/ingest/utc_time.h"

namespace onesea::ingest {
namespace {

// Real-time labels are centres rounded to a millihertz: below 0.1 Hz the bands are 5 mHz wide, so
// that .0325 is written 0.033. Wider bands have labels that are exact.
double BandCentre(double label_hz) {
  const long label_mhz = std::lround(label_hz * 1000.0);
  const bool is_rounded = label_mhz < 95 && label_mhz % 5 == 3 &&
                          std::abs(label_hz * 1000.0 - static_cast<double>(label_mhz)) < 1e-6;
  return is_rounded ? label_hz - 0.0005 : label_hz;
}

absl::Status TakeValue(const TextLines& lines, absl::string_view text, std::vector<float>& value) {
  const std::optional<double> number = ParseReal(text);
  if (!number || !(std::abs(*number) <= kDensityMax)) return lines.Bad("value", text, "a number");
  value.push_back(static_cast<float>(*number));
  return absl::OkStatus();
}

// Two-digit years were written until 1998.
int FullYear(int year) {
  if (year >= 100 || year < 0) return year;
  return year >= 70 ? 1900 + year : 2000 + year;
}

absl::Status TakeTime(const TextLines& lines, absl::string_view& rest, bool has_minute,
                      std::string& time_utc) {
  CivilTime time;
  const std::pair<absl::string_view, int*> parts[] = {{"year", &time.year},
                                                      {"month", &time.month},
                                                      {"day", &time.day},
                                                      {"hour", &time.hour},
                                                      {"minute", &time.minute}};
  for (const auto& [field, part] : parts) {
    if (part == &time.minute && !has_minute) break;
    const absl::string_view text = TakeField(rest);
    const std::optional<int> number = ParseInt(text);
    if (!number) return lines.Bad(field, text, "a whole number");
    *part = *number;
  }
  time.year = FullYear(time.year);
  const std::optional<std::string> text = FormatUtc(time);
  if (!text) return lines.Bad("time", lines.line().substr(0, 16), "a date and time that exists");
  time_utc = *text;
  return absl::OkStatus();
}

absl::Status AppendRow(const TextLines& lines, NdbcRow row, NdbcTable& table) {
  if (table.rows.size() == static_cast<std::size_t>(kSpectrumRecordsMax)) {
    return lines.Error("records", absl::StrCat("more than ", kSpectrumRecordsMax));
  }
  table.rows.push_back(std::move(row));
  return absl::OkStatus();
}

// Real-time files begin with the newest. A repeated time keeps the line that stands first.
void SortRows(NdbcTable& table) {
  const auto earlier = [](const NdbcRow& a, const NdbcRow& b) { return a.time_utc < b.time_utc; };
  const auto same = [](const NdbcRow& a, const NdbcRow& b) { return a.time_utc == b.time_utc; };
  std::stable_sort(table.rows.begin(), table.rows.end(), earlier);
  table.rows.erase(std::unique(table.rows.begin(), table.rows.end(), same), table.rows.end());
}

// Takes "0.033)" of "(0.033)", whose bracket may stand apart: "( 0.033)".
absl::StatusOr<double> TakeLabel(const TextLines& lines, absl::string_view& rest) {
  absl::string_view text = TakeField(rest);
  if (text.empty()) return lines.Truncated("frequency");
  if (text == "(") text = TakeField(rest);
  const absl::string_view whole = text;
  absl::ConsumePrefix(&text, "(");
  if (!absl::ConsumeSuffix(&text, ")")) return lines.Bad("frequency", whole, "of the form (0.100)");
  const std::optional<double> label_hz = ParseReal(text);
  if (!label_hz) return lines.Bad("frequency", whole, "of the form (0.100)");
  return *label_hz;
}

absl::StatusOr<NdbcRow> ParseRealtimeRow(const TextLines& lines, bool may_have_separation) {
  NdbcRow row;
  row.line = lines.number();
  absl::string_view rest = lines.line();
  ONESEA_RETURN_IF_ERROR(TakeTime(lines, rest, true, row.time_utc));
  absl::string_view text = TakeField(rest);
  if (may_have_separation && !text.empty()) {
    // The separation frequency is the one value that no label follows.
    absl::string_view after = rest;
    const absl::string_view next = TakeField(after);
    if (!absl::StartsWith(next, "(")) {
      if (!ParseReal(text)) return lines.Bad("Sep_Freq", text, "a number");
      text = TakeField(rest);
    }
  }
  for (; !text.empty(); text = TakeField(rest)) {
    ONESEA_RETURN_IF_ERROR(TakeValue(lines, text, row.value));
    ONESEA_ASSIGN_OR_RETURN(const double label_hz, TakeLabel(lines, rest));
    ONESEA_RETURN_IF_ERROR(AppendFrequency(lines, BandCentre(label_hz), row.frequency_hz));
  }
  if (row.value.empty()) return lines.Truncated("value");
  return row;
}

// Bands may change from line to line, but a line that only lacks the last ones was cut.
bool IsCut(const NdbcRow& row, const NdbcRow& whole) {
  return row.frequency_hz.size() < whole.frequency_hz.size() &&
         std::equal(row.frequency_hz.begin(), row.frequency_hz.end(), whole.frequency_hz.begin());
}

bool TakeDateHeader(absl::string_view& rest, bool& has_minute) {
  absl::string_view year = TakeField(rest);
  absl::ConsumePrefix(&year, "#");
  if (year.empty()) year = TakeField(rest);  // "# YY"
  if (year != "YY" && year != "YYYY") return false;
  if (TakeField(rest) != "MM" || TakeField(rest) != "DD" || TakeField(rest) != "hh") return false;
  absl::string_view after = rest;
  has_minute = TakeField(after) == "mm";
  if (has_minute) rest = after;
  return true;
}

}  // namespace

bool IsNdbcRealtimeHeader(absl::string_view line) {
  bool has_minute = false;
  return TakeDateHeader(line, has_minute) && has_minute && absl::StrContains(line, "(freq_1)");
}

bool IsNdbcHistoryHeader(absl::string_view line) {
  bool has_minute = false;
  return TakeDateHeader(line, has_minute) && ParseReal(TakeField(line)).has_value();
}

absl::StatusOr<NdbcTable> ParseNdbcRealtime(absl::string_view name, absl::string_view text) {
  NdbcTable table{std::string(name), {}};
  TextLines lines(name, text);
  bool may_have_separation = true;
  while (lines.NextNotBlank()) {
    if (absl::StartsWith(lines.line(), "#")) {
      may_have_separation = absl::StrContains(lines.line(), "spec_1");
      continue;
    }
    ONESEA_ASSIGN_OR_RETURN(NdbcRow row, ParseRealtimeRow(lines, may_have_separation));
    if (!table.rows.empty() && IsCut(row, table.rows.front())) {
      return lines.Error("value", absl::StrCat(row.value.size(), " bands, the first line has ",
                                               table.rows.front().value.size()));
    }
    ONESEA_RETURN_IF_ERROR(AppendRow(lines, std::move(row), table));
  }
  SortRows(table);
  return table;
}

absl::StatusOr<NdbcTable> ParseNdbcHistory(absl::string_view name, absl::string_view text) {
  NdbcTable table{std::string(name), {}};
  TextLines lines(name, text);
  bool has_minute = false;
  std::vector<float> frequency_hz;
  if (!lines.NextNotBlank()) return lines.Truncated("header");
  absl::string_view rest = lines.line();
  if (!TakeDateHeader(rest, has_minute)) return lines.Error("header", "lacks YY MM DD hh");
  for (absl::string_view f = TakeField(rest); !f.empty(); f = TakeField(rest)) {
    const std::optional<double> hz = ParseReal(f);
    if (!hz) return lines.Bad("frequency", f, "a number");
    ONESEA_RETURN_IF_ERROR(AppendFrequency(lines, *hz, frequency_hz));
  }
  while (lines.NextNotBlank()) {
    if (absl::StartsWith(lines.line(), "#")) continue;
    NdbcRow row{{}, lines.number(), frequency_hz, {}};
    rest = lines.line();
    ONESEA_RETURN_IF_ERROR(TakeTime(lines, rest, has_minute, row.time_utc));
    for (absl::string_view v = TakeField(rest); !v.empty(); v = TakeField(rest)) {
      if (row.value.size() == frequency_hz.size()) {
        return lines.Bad("value", v, "expected: the header names fewer frequencies");
      }
      ONESEA_RETURN_IF_ERROR(TakeValue(lines, v, row.value));
    }
    if (row.value.size() < frequency_hz.size()) {
      return lines.Error("value", absl::StrCat(row.value.size(), " values for ",
                                               frequency_hz.size(), " frequencies"));
    }
    ONESEA_RETURN_IF_ERROR(AppendRow(lines, std::move(row), table));
  }
  SortRows(table);
  return table;
}

}  // namespace onesea::ingest
