#include "common/ingest/swan_header.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/ingest/direction.h"
#include "common/ingest/spectrum_axis.h"

namespace onesea::ingest {
namespace {

constexpr int kQuantitiesMax = 16;
constexpr int kIsoTimeCoding = 1;

absl::StatusOr<int> ReadCount(TextLines& lines, absl::string_view field, int min, int max) {
  if (!NextSwanLine(lines)) return lines.Truncated(field);
  absl::string_view rest = lines.line();
  const absl::string_view text = TakeField(rest);
  const std::optional<int> count = ParseInt(text);
  if (!count || *count < min || *count > max) {
    return lines.Bad(field, text, absl::StrCat("in [", min, ", ", max, "]"));
  }
  return *count;
}

absl::StatusOr<double> ReadReal(TextLines& lines, absl::string_view field) {
  if (!NextSwanLine(lines)) return lines.Truncated(field);
  absl::string_view rest = lines.line();
  const absl::string_view text = TakeField(rest);
  const std::optional<double> value = ParseReal(text);
  if (!value) return lines.Bad(field, text, "a number");
  return *value;
}

absl::Status ReadPlaces(TextLines& lines, SwanHeader& header) {
  header.places.clear();
  ONESEA_ASSIGN_OR_RETURN(const int count, ReadCount(lines, "locations", 1, kSpectrumPlacesMax));
  for (int i = 0; i < count; ++i) {
    if (!NextSwanLine(lines)) return lines.Truncated("location");
    absl::string_view rest = lines.line();
    const std::optional<double> x = ParseReal(TakeField(rest)), y = ParseReal(TakeField(rest));
    if (!x || !y) return lines.Bad("location", lines.line(), "two numbers");
    header.places.push_back({*x, *y});
  }
  return absl::OkStatus();
}

absl::Status ReadFrequencies(TextLines& lines, SwanHeader& header) {
  header.frequency_hz.clear();
  ONESEA_ASSIGN_OR_RETURN(const int count,
                          ReadCount(lines, "frequencies", 2, kSpectrumFrequenciesMax));
  for (int i = 0; i < count; ++i) {
    ONESEA_ASSIGN_OR_RETURN(const double hz, ReadReal(lines, "frequency"));
    ONESEA_RETURN_IF_ERROR(AppendFrequency(lines, hz, header.frequency_hz));
  }
  return absl::OkStatus();
}

absl::Status ReadDirections(TextLines& lines, bool is_nautical, SwanHeader& header) {
  header.wave_to_rad.clear();
  ONESEA_ASSIGN_OR_RETURN(const int count,
                          ReadCount(lines, "directions", 0, kSpectrumDirectionsMax));
  for (int i = 0; i < count; ++i) {
    ONESEA_ASSIGN_OR_RETURN(const double deg, ReadReal(lines, "direction"));
    if (!(std::abs(deg) <= 720.0)) return lines.Error("direction", "is not in [-720, 720] degrees");
    header.wave_to_rad.push_back(is_nautical ? WaveToFromNautical(deg)
                                             : WrapToTurn(deg * kRadPerDeg));
  }
  if (count == 0) return absl::OkStatus();
  constexpr double kRoundingRad = 1e-4;  // four decimals of a degree, and then some
  auto axis = SortDirections(header.wave_to_rad, kRoundingRad);
  if (!axis.ok()) return lines.Error("direction", axis.status().message());
  header.axis = *std::move(axis);
  return absl::OkStatus();
}

absl::StatusOr<SwanColumn> ReadQuantity(TextLines& lines) {
  SwanColumn column;
  if (!NextSwanLine(lines)) return lines.Truncated("quantity");
  const std::string name = SwanKeyword(lines.line());
  if (name == "VADENS") column.quantity = SwanQuantity::kVarianceDensity;
  if (name == "ENDENS") column.quantity = SwanQuantity::kEnergyDensity;
  if (name == "CDIR" || name == "NDIR") column.quantity = SwanQuantity::kDirection;
  if (name == "DSPR" || name == "DSPRDEGR") column.quantity = SwanQuantity::kSpread;
  column.is_nautical = name == "NDIR";
  if (!NextSwanLine(lines)) return lines.Truncated("unit");
  const std::string unit = SwanKeyword(lines.line());
  // DSPR may also be given as the power m of cos^m.
  if (column.quantity == SwanQuantity::kSpread && !absl::StartsWith(unit, "DEG")) {
    return lines.Bad("unit of DSPR", unit, "degr");
  }
  ONESEA_ASSIGN_OR_RETURN(column.exception_value, ReadReal(lines, "exception value"));
  return column;
}

bool IsDensity(const SwanColumn& column) {
  return column.quantity == SwanQuantity::kVarianceDensity ||
         column.quantity == SwanQuantity::kEnergyDensity;
}

absl::Status ReadQuantities(TextLines& lines, SwanHeader& header) {
  ONESEA_ASSIGN_OR_RETURN(const int count, ReadCount(lines, "quantities", 1, kQuantitiesMax));
  for (int i = 0; i < count; ++i) {
    ONESEA_ASSIGN_OR_RETURN(const SwanColumn column, ReadQuantity(lines));
    header.columns.push_back(column);
  }
  if (std::count_if(header.columns.begin(), header.columns.end(), IsDensity) != 1) {
    return lines.Error("quantities", "hold no VaDens or EnDens, or several; action is not read");
  }
  if (!header.wave_to_rad.empty() && count != 1) {
    return lines.Error("quantities", absl::StrCat(count, "; a 2-D spectrum has 1"));
  }
  return absl::OkStatus();
}

absl::Status ReadTimeCoding(TextLines& lines, SwanHeader& header) {
  header.has_time = true;
  ONESEA_ASSIGN_OR_RETURN(const int coding, ReadCount(lines, "time coding", 0, 100));
  if (coding != kIsoTimeCoding) {
    return lines.Error("time coding", absl::StrCat(coding, "; only 1 (yyyymmdd.hhmmss) is read"));
  }
  return absl::OkStatus();
}

}  // namespace

bool NextSwanLine(TextLines& lines) {
  while (lines.NextNotBlank()) {
    if (!absl::StartsWith(lines.line(), "$")) return true;
  }
  return false;
}

std::string SwanKeyword(absl::string_view line) { return absl::AsciiStrToUpper(TakeField(line)); }

absl::StatusOr<SwanHeader> ParseSwanHeader(TextLines& lines) {
  SwanHeader header;
  while (NextSwanLine(lines)) {
    const std::string keyword = SwanKeyword(lines.line());
    absl::Status status;
    if (keyword == "SWAN") continue;
    if (keyword == "TIME") {
      status = ReadTimeCoding(lines, header);
    } else if (keyword == "LONLAT" || keyword == "LOCATIONS") {
      header.has_lon_lat = keyword == "LONLAT";
      status = ReadPlaces(lines, header);
    } else if (keyword == "AFREQ" || keyword == "RFREQ") {
      header.is_relative_frequency = keyword == "RFREQ";
      status = ReadFrequencies(lines, header);
    } else if (keyword == "NDIR" || keyword == "CDIR") {
      status = ReadDirections(lines, keyword == "NDIR", header);
    } else if (keyword == "QUANT") {
      status = ReadQuantities(lines, header);
      if (status.ok() && header.frequency_hz.empty()) return lines.Error("AFREQ", "is missing");
      if (status.ok()) return header;
    } else {
      return lines.Bad("keyword", keyword, "one of SWAN's spectral files");
    }
    ONESEA_RETURN_IF_ERROR(status);
  }
  return lines.Truncated("QUANT");
}

}  // namespace onesea::ingest
