#include "common/ingest/swan_spectrum.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/ingest/direction.h"
#include "common/ingest/field_stream.h"
#include "common/ingest/spreading_moments.h"
#include "common/ingest/swan_header.h"
#include "common/ingest/text_lines.h"
#include "common/ingest/utc_time.h"
#include "common/sea/statistics.h"

namespace onesea::ingest {
namespace {

constexpr double kSwanEnergyPerVariance = 1025.0 * 9.81;  // rho g [J/m² per m²]

absl::StatusOr<std::string> ParseTime(const TextLines& lines) {
  absl::string_view rest = lines.line();
  const absl::string_view text = TakeField(rest);
  if (text.size() == 15 && text[8] == '.') {
    const std::optional<int> date = ParseInt(text.substr(0, 8)), time = ParseInt(text.substr(9));
    if (date && time && *date > 0 && *time >= 0) {
      const std::optional<std::string> utc =
          FormatUtc({*date / 10000, *date / 100 % 100, *date % 100, *time / 10000,
                     *time / 100 % 100, *time % 100});
      if (utc) return *utc;
    }
  }
  return lines.Bad("time", text, "yyyymmdd.hhmmss");
}

SpectrumRecord NewRecord(const SwanHeader& header, std::size_t place, const std::string& time_utc) {
  SpectrumRecord record;
  record.time_utc = time_utc;
  record.format = absl::StrCat("SWAN ", header.wave_to_rad.empty() ? "1-D" : "2-D",
                               header.is_relative_frequency ? ", relative frequencies" : "");
  if (place < header.places.size()) {
    const SwanPlace& p = header.places[place];
    record.place = absl::StrFormat("%.10g,%.10g", p.x, p.y);
    if (header.has_lon_lat) {
      record.longitude_deg = p.x;
      record.latitude_deg = p.y;
    }
  }
  return record;
}

double VarianceScale(const SwanColumn& density) {
  return density.quantity == SwanQuantity::kEnergyDensity ? 1.0 / kSwanEnergyPerVariance : 1.0;
}

// What SWAN writes for a cell without value; it prints the value with few digits.
bool IsException(const SwanColumn& column, double value) {
  return std::abs(value - column.exception_value) <= 1e-6 * std::abs(column.exception_value);
}

absl::StatusOr<sea::GridSpectrum> ParseMatrix(const SwanHeader& header, TextLines& lines) {
  const SwanColumn& column = header.columns.front();
  FieldStream fields(lines);
  ONESEA_ASSIGN_OR_RETURN(const double factor, fields.TakeDensity("FACTOR"));
  const double scale = factor * VarianceScale(column) / kRadPerDeg;
  sea::GridSpectrum grid;
  grid.frequency_hz = header.frequency_hz;
  grid.wave_to_rad = header.axis.wave_to_rad;
  std::vector<float> row(header.wave_to_rad.size());
  for (std::size_t i = 0; i < header.frequency_hz.size(); ++i) {
    for (float& cell : row) {
      ONESEA_ASSIGN_OR_RETURN(const double value, fields.TakeReal("density"));
      const double density = IsException(column, value) ? 0.0 : value * scale;
      if (!(density >= 0.0 && density <= kDensityMax)) {
        return lines.Error("density", absl::StrCat(density, " is not in [0, ", kDensityMax, "]"));
      }
      cell = static_cast<float>(density);
    }
    AppendGridRow(header.axis, row, grid);
  }
  return grid;
}

struct SpectrumLine {
  double density = 0.0, wave_to_rad = 0.0, r1 = 0.0;
  bool has_direction = false, has_spread = false;
};

// SWAN's DSPR is the circular width sqrt(2 (1 - r1)); what is wider than r1 = 0 allows is all
// round.
double FirstMomentOfSpread(double spread_deg) {
  const double spread_rad = spread_deg * kRadPerDeg;
  return std::clamp(1.0 - 0.5 * spread_rad * spread_rad, 0.0, 1.0);
}

absl::Status ParseLine(const SwanHeader& header, const TextLines& lines, SpectrumLine& out) {
  absl::string_view rest = lines.line();
  for (const SwanColumn& column : header.columns) {
    const absl::string_view text = TakeField(rest);
    const std::optional<double> value = ParseReal(text);
    if (!value) return lines.Bad("quantity", text, "a number");
    if (IsException(column, *value)) continue;
    switch (column.quantity) {
      case SwanQuantity::kVarianceDensity:
      case SwanQuantity::kEnergyDensity:
        out.density = *value * VarianceScale(column);
        if (!(out.density >= 0.0 && out.density <= kDensityMax)) {
          return lines.Bad("density", text, absl::StrCat("in [0, ", kDensityMax, "]"));
        }
        break;
      case SwanQuantity::kDirection:
        if (!(std::abs(*value) <= 720.0)) return lines.Bad("direction", text, "in [-720, 720]");
        out.has_direction = true;
        out.wave_to_rad =
            column.is_nautical ? WaveToFromNautical(*value) : WrapToTurn(*value * kRadPerDeg);
        break;
      case SwanQuantity::kSpread:
        if (!(*value >= 0.0 && *value <= 360.0)) return lines.Bad("DSPR", text, "in [0, 360]");
        out.has_spread = true;
        out.r1 = FirstMomentOfSpread(*value);
        break;
      case SwanQuantity::kOther:
        break;
    }
  }
  return absl::OkStatus();
}

bool Holds(const SwanHeader& header, SwanQuantity quantity) {
  return std::any_of(header.columns.begin(), header.columns.end(),
                     [=](const SwanColumn& column) { return column.quantity == quantity; });
}

absl::StatusOr<sea::BuoySpectrum> ParseTable(const SwanHeader& header, TextLines& lines) {
  const bool is_directional =
      Holds(header, SwanQuantity::kDirection) && Holds(header, SwanQuantity::kSpread);
  sea::BuoySpectrum spectrum;
  spectrum.frequency_hz = header.frequency_hz;
  for (std::size_t i = 0; i < header.frequency_hz.size(); ++i) {
    if (!NextSwanLine(lines)) return lines.Truncated("density");
    SpectrumLine line;
    ONESEA_RETURN_IF_ERROR(ParseLine(header, lines, line));
    spectrum.density_m2_per_hz.push_back(static_cast<float>(line.density));
    if (!is_directional) continue;
    const double r1 = line.has_direction && line.has_spread ? line.r1 : 0.0;
    spectrum.mean_wave_to_rad.push_back(static_cast<float>(line.wave_to_rad));
    spectrum.principal_wave_to_rad.push_back(static_cast<float>(line.wave_to_rad));
    spectrum.r1.push_back(static_cast<float>(r1));
    spectrum.r2.push_back(static_cast<float>(SecondMomentOfCosine2s(r1)));
  }
  return spectrum;
}

// One block after its keyword; `hs_m` is 0 if there is nothing to keep.
absl::Status ParseBlock(const SwanHeader& header, TextLines& lines, SpectrumRecord& record,
                        double& hs_m) {
  const std::string keyword = SwanKeyword(lines.line());
  hs_m = 0.0;
  if (keyword == "ZERO" || keyword == "NODATA") return absl::OkStatus();
  const bool is_table = header.wave_to_rad.empty();
  if (keyword != (is_table ? "LOCATION" : "FACTOR")) {
    return lines.Bad("keyword", keyword,
                     is_table ? "LOCATION, ZERO or NODATA" : "FACTOR, ZERO or NODATA");
  }
  if (is_table) {
    ONESEA_ASSIGN_OR_RETURN(sea::BuoySpectrum spectrum, ParseTable(header, lines));
    hs_m = sea::ComputeStatistics(spectrum).hs_m;
    record.system = std::move(spectrum);
  } else {
    ONESEA_ASSIGN_OR_RETURN(sea::GridSpectrum grid, ParseMatrix(header, lines));
    hs_m = sea::ComputeStatistics(grid).hs_m;
    record.system = std::move(grid);
  }
  if (!(hs_m <= kHsMaxM)) {
    return lines.Error("density",
                       absl::StrFormat("gives Hs %.4g m; the limit is %g m", hs_m, kHsMaxM));
  }
  return absl::OkStatus();
}

}  // namespace

bool IsSwanHeader(absl::string_view line) { return SwanKeyword(line) == "SWAN"; }

absl::StatusOr<std::vector<SpectrumRecord>> ParseSwanSpectra(absl::string_view name,
                                                             absl::string_view text) {
  TextLines lines(name, text);
  ONESEA_ASSIGN_OR_RETURN(const SwanHeader header, ParseSwanHeader(lines));
  const std::size_t places = std::max<std::size_t>(1, header.places.size());
  std::vector<SpectrumRecord> records;
  bool is_first = true;
  while (NextSwanLine(lines)) {
    std::string time_utc;
    if (header.has_time) {
      ONESEA_ASSIGN_OR_RETURN(time_utc, ParseTime(lines));
      if (!NextSwanLine(lines)) return lines.Truncated("FACTOR");
    } else if (!is_first) {
      return lines.Bad("line", lines.line(), "expected: a stationary file has each place once");
    }
    for (std::size_t place = 0; place < places; ++place) {
      if (place > 0 && !NextSwanLine(lines)) return lines.Truncated("FACTOR");
      SpectrumRecord record = NewRecord(header, place, time_utc);
      double hs_m = 0.0;
      ONESEA_RETURN_IF_ERROR(ParseBlock(header, lines, record, hs_m));
      if (!(hs_m > 0.0)) continue;
      if (records.size() == static_cast<std::size_t>(kSpectrumRecordsMax)) {
        return lines.Error("records", absl::StrCat("more than ", kSpectrumRecordsMax));
      }
      records.push_back(std::move(record));
    }
    is_first = false;
  }
  return records;
}

}  // namespace onesea::ingest
