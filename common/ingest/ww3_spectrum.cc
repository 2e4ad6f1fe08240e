#include "common/ingest/ww3_spectrum.h"

#include <cmath>
#include <string>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/ingest/direction.h"
#include "common/ingest/field_stream.h"
#include "common/ingest/grid_axes.h"
#include "common/ingest/spectrum_axis.h"
#include "common/ingest/text_lines.h"
#include "common/ingest/utc_time.h"
#include "common/sea/statistics.h"

namespace onesea::ingest {
namespace {

// Directions are printed with three digits: up to 5e-3 rad away from where the model has them.
constexpr double kDirectionRoundingRad = 5.1e-3;

struct Header {
  int frequency_count = 0, direction_count = 0, point_count = 0;
  std::vector<float> frequency_hz;
  DirectionAxis axis;
};

absl::StatusOr<int> TakeCount(const TextLines& lines, absl::string_view& rest,
                              absl::string_view field, int min, int max) {
  const absl::string_view text = TakeField(rest);
  const std::optional<int> count = ParseInt(text);
  if (!count || *count < min || *count > max) {
    return lines.Bad(field, text, absl::StrCat("in [", min, ", ", max, "]"));
  }
  return *count;
}

absl::StatusOr<Header> ParseHeader(TextLines& lines) {
  Header header;
  if (!lines.NextNotBlank()) return lines.Truncated("header");
  absl::string_view rest = lines.line();
  rest.remove_prefix(rest.find('\'', rest.find('\'') + 1) + 1);
  ONESEA_ASSIGN_OR_RETURN(header.frequency_count,
                          TakeCount(lines, rest, "frequencies", 2, kSpectrumFrequenciesMax));
  ONESEA_ASSIGN_OR_RETURN(header.direction_count,
                          TakeCount(lines, rest, "directions", 2, kSpectrumDirectionsMax));
  ONESEA_ASSIGN_OR_RETURN(header.point_count,
                          TakeCount(lines, rest, "points", 1, kSpectrumPlacesMax));
  FieldStream fields(lines);
  for (int i = 0; i < header.frequency_count; ++i) {
    ONESEA_ASSIGN_OR_RETURN(const double hz, fields.TakeReal("frequency"));
    ONESEA_RETURN_IF_ERROR(AppendFrequency(lines, hz, header.frequency_hz));
  }
  std::vector<double> wave_to_rad;
  for (int i = 0; i < header.direction_count; ++i) {
    ONESEA_ASSIGN_OR_RETURN(const double to_rad, fields.TakeReal("direction"));
    if (!(std::abs(to_rad) <= 4.0 * sea::kPi)) return lines.Error("direction", "is not in radians");
    wave_to_rad.push_back(WaveToFromCompass(to_rad));
  }
  auto axis = SortDirections(wave_to_rad, kDirectionRoundingRad);
  if (!axis.ok()) return lines.Error("direction", axis.status().message());
  header.axis = *std::move(axis);
  return header;
}

absl::StatusOr<std::string> ParseTime(const TextLines& lines) {
  absl::string_view rest = lines.line();
  const absl::string_view date_text = TakeField(rest), time_text = TakeField(rest);
  const std::optional<int> date = ParseInt(date_text), time = ParseInt(time_text);
  if (date_text.size() == 8 && date && time && *date > 0 && *time >= 0 && time_text.size() <= 6) {
    const std::optional<std::string> text =
        FormatUtc({*date / 10000, *date / 100 % 100, *date % 100, *time / 10000, *time / 100 % 100,
                   *time % 100});
    if (text) return *text;
  }
  return lines.Bad("time", lines.line(), "yyyymmdd hhmmss");
}

// Columns are seven wide, so that a longitude of -160.00 touches the latitude before it.
std::optional<double> TakeColumn(absl::string_view& rest) {
  absl::string_view field = TakeField(rest);
  const std::size_t minus = field.find('-', 1);
  if (minus != absl::string_view::npos) {
    rest = absl::string_view(field.data() + minus, field.size() - minus + rest.size());
    field = field.substr(0, minus);
  }
  return ParseReal(field);
}

absl::Status ParsePoint(const TextLines& lines, SpectrumRecord& record) {
  absl::string_view rest = lines.line();
  const std::size_t open = rest.find('\''), close = rest.rfind('\'');
  if (open == absl::string_view::npos || close == open) {
    return lines.Bad("point", lines.line(), "'name' latitude longitude depth");
  }
  record.place = std::string(absl::StripAsciiWhitespace(rest.substr(open + 1, close - open - 1)));
  rest.remove_prefix(close + 1);
  const std::optional<double> latitude = TakeColumn(rest), longitude = TakeColumn(rest),
                              depth = TakeColumn(rest);
  if (!latitude || !longitude || !depth) {
    return lines.Bad("point", lines.line(), "'name' latitude longitude depth");
  }
  record.latitude_deg = latitude;
  record.longitude_deg = longitude;
  record.depth_m = depth;
  return absl::OkStatus();
}

absl::StatusOr<sea::GridSpectrum> ParseMatrix(const Header& header, TextLines& lines) {
  const std::size_t n = header.frequency_hz.size();
  const std::size_t m = static_cast<std::size_t>(header.direction_count);
  std::vector<float> by_frequency(n * m);  // the file's order turned round
  FieldStream fields(lines);
  for (std::size_t j = 0; j < m; ++j) {
    for (std::size_t i = 0; i < n; ++i) {
      ONESEA_ASSIGN_OR_RETURN(const double density, fields.TakeDensity("density"));
      by_frequency[i * m + j] = static_cast<float>(density);
    }
  }
  sea::GridSpectrum grid;
  grid.frequency_hz = header.frequency_hz;
  grid.wave_to_rad = header.axis.wave_to_rad;
  for (std::size_t i = 0; i < n; ++i) {
    AppendGridRow(header.axis, std::span(by_frequency).subspan(i * m, m), grid);
  }
  return grid;
}

}  // namespace

bool IsWw3Header(absl::string_view line) {
  return absl::StartsWith(absl::StripLeadingAsciiWhitespace(line), "'WAVEWATCH III SPECTRA'");
}

absl::StatusOr<std::vector<SpectrumRecord>> ParseWw3Spectra(absl::string_view name,
                                                            absl::string_view text) {
  TextLines lines(name, text);
  ONESEA_ASSIGN_OR_RETURN(const Header header, ParseHeader(lines));
  std::vector<SpectrumRecord> records;
  while (lines.NextNotBlank()) {
    ONESEA_ASSIGN_OR_RETURN(const std::string time_utc, ParseTime(lines));
    for (int point = 0; point < header.point_count; ++point) {
      if (!lines.NextNotBlank()) return lines.Truncated("point");
      SpectrumRecord record{time_utc, {}, "WAVEWATCH III point spectrum", {}, {}, {}, {}};
      ONESEA_RETURN_IF_ERROR(ParsePoint(lines, record));
      ONESEA_ASSIGN_OR_RETURN(sea::GridSpectrum grid, ParseMatrix(header, lines));
      const double hs_m = sea::ComputeStatistics(grid).hs_m;
      if (!(hs_m <= kHsMaxM)) {
        return lines.Error("density",
                           absl::StrFormat("gives Hs %.4g m; the limit is %g m", hs_m, kHsMaxM));
      }
      if (!(hs_m > 0.0)) continue;
      if (records.size() == static_cast<std::size_t>(kSpectrumRecordsMax)) {
        return lines.Error("records", absl::StrCat("more than ", kSpectrumRecordsMax));
      }
      record.system = std::move(grid);
      records.push_back(std::move(record));
    }
  }
  return records;
}

}  // namespace onesea::ingest
