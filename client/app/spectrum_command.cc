#include "client/app/spectrum_command.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <ostream>
#include <span>
#include <variant>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_replace.h"
#include "client/app/json_writer.h"
#include "client/app/polar_plot.h"
#include "common/base/check.h"
#include "common/ingest/direction.h"
#include "common/ingest/spectrum_file.h"
#include "common/ingest/utc_time.h"
#include "common/sea/statistics.h"

namespace onesea::app {
namespace {

using ingest::SpectrumRecord;

sea::SpectrumStatistics StatisticsOf(const SpectrumRecord& record) {
  if (const auto* buoy = std::get_if<sea::BuoySpectrum>(&record.system)) {
    return sea::ComputeStatistics(*buoy);
  }
  return sea::ComputeStatistics(std::get<sea::GridSpectrum>(record.system));
}

double FromDeg(const sea::SpectrumStatistics& s) {
  return ingest::NauticalFromWaveTo(s.mean_wave_to_rad);
}

double SpreadDeg(const sea::SpectrumStatistics& s) { return s.spread_rad / ingest::kRadPerDeg; }

// 359.7 is written 0, not 360.
int WholeDeg(double deg) { return static_cast<int>(std::lround(deg)) % 360; }

const char* CompassPoint(double from_deg) {
  static constexpr const char* kPoints[] = {"N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE",
                                            "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW"};
  return kPoints[std::lround(from_deg / 22.5) % 16];
}

void WriteJson(const SpectrumRecord& record, JsonWriter& json) {
  const sea::SpectrumStatistics s = StatisticsOf(record);
  json.BeginObject().Key("time");
  if (record.time_utc.empty()) {
    json.Null();
  } else {
    json.Value(record.time_utc);
  }
  json.Key("place").Value(record.place).Key("format").Value(record.format);
  json.Key("hs_m").Value(s.hs_m).Key("tp_s").Value(s.tp_s).Key("tm02_s").Value(s.tm02_s);
  json.Key("mean_direction_deg").Value(s.has_direction ? FromDeg(s) : NAN);
  json.Key("spread_deg").Value(s.has_direction ? SpreadDeg(s) : NAN);
  json.EndObject();
}

std::string Heading(const SpectrumRecord& record) {
  std::string heading = record.place;
  if (!record.time_utc.empty()) {
    absl::StrAppend(&heading, heading.empty() ? "" : "   ",
                    absl::StrReplaceAll(record.time_utc, {{"T", " "}}), " UTC");
  }
  return heading.empty() ? "spectrum" : heading;
}

void PrintOne(const SpectrumRecord& record, std::ostream& out) {
  const sea::SpectrumStatistics s = StatisticsOf(record);
  out << Heading(record) << "   (" << record.format << ")\n"
      << absl::StrFormat("  Hs      %6.2f m\n  Tp      %6.2f s\n  Tm02    %6.2f s\n", s.hs_m,
                         s.tp_s, s.tm02_s);
  if (!s.has_direction) {
    out << "  no directions: the file is 1-D\n";
    return;
  }
  out << absl::StrFormat("  from    %6d °  (%s)\n  spread  %6.0f °\n", WholeDeg(FromDeg(s)),
                         CompassPoint(FromDeg(s)), SpreadDeg(s));
}

void PrintTable(std::span<const SpectrumRecord> records, std::ostream& out) {
  std::size_t place_width = 5;
  for (const SpectrumRecord& record : records) {
    place_width = std::max(place_width, record.place.size());
  }
  const int width = static_cast<int>(place_width);
  out << absl::StrFormat("%-16s  %-*s  Hs [m]  Tp [s]  Tm02 [s]  from [°]  spread [°]\n",
                         "time [UTC]", width, "place");
  for (const SpectrumRecord& record : records) {
    const sea::SpectrumStatistics s = StatisticsOf(record);
    out << absl::StrFormat("%-16s  %-*s  %6.2f  %6.2f  %8.2f", record.time_utc, width, record.place,
                           s.hs_m, s.tp_s, s.tm02_s);
    if (s.has_direction) {
      out << absl::StrFormat("  %8d  %10.0f\n", WholeDeg(FromDeg(s)), SpreadDeg(s));
    } else {
      out << "         -           -\n";
    }
  }
}

PolarPlotText TextOf(const SpectrumRecord& record) {
  const sea::SpectrumStatistics s = StatisticsOf(record);
  PolarPlotText text{Heading(record), {}, {}};
  text.subtitle = {absl::StrFormat("Hs %.2f m", s.hs_m), absl::StrFormat("Tp %.1f s", s.tp_s)};
  if (s.has_direction) {
    text.subtitle.push_back(absl::StrFormat("from %d°", WholeDeg(FromDeg(s))));
    text.subtitle.push_back(absl::StrFormat("spread %.0f°", SpreadDeg(s)));
    text.mean_from_deg = FromDeg(s);
  } else {
    text.subtitle.push_back("direction assumed");
  }
  return text;
}

absl::Status ShowOne(const SpectrumRecord& record, const SpectrumOptions& options,
                     std::ostream& out) {
  if (!options.png_path.empty()) {
    ONESEA_RETURN_IF_ERROR(WritePolarPlotPng(record.system, TextOf(record), options.png_path));
  }
  if (options.json) {
    JsonWriter json;
    WriteJson(record, json);
    out << json.text() << "\n";
    return absl::OkStatus();
  }
  PrintOne(record, out);
  if (!options.png_path.empty()) out << "  drawn   " << options.png_path << "\n";
  return absl::OkStatus();
}

void ShowAll(std::span<const SpectrumRecord> records, bool json, std::ostream& out) {
  if (!json) return PrintTable(records, out);
  JsonWriter writer;
  writer.BeginArray();
  for (const SpectrumRecord& record : records) WriteJson(record, writer);
  writer.EndArray();
  out << writer.text() << "\n";
}

// The records at the given time and place, where empty means any.
std::vector<SpectrumRecord> Select(std::span<const SpectrumRecord> records,
                                   const std::string& time_utc, const std::string& place) {
  std::vector<SpectrumRecord> selected;
  for (const SpectrumRecord& record : records) {
    const bool is_time = time_utc.empty() || record.time_utc == time_utc;
    if (is_time && (place.empty() || record.place == place)) selected.push_back(record);
  }
  return selected;
}

}  // namespace

absl::Status RunSpectrum(const SpectrumOptions& options, std::ostream& out) {
  ONESEA_ASSIGN_OR_RETURN(const std::vector<SpectrumRecord> records,
                          ingest::ReadSpectrumFile(options.path));
  const auto one = ingest::FindRecord(records, options.time, options.place);
  if (one.ok()) return ShowOne(**one, options, out);
  if (!options.png_path.empty()) return one.status();
  // Several records are an answer, unless a time or a place was named that the file lacks.
  const std::optional<ingest::CivilTime> time = ingest::ParseUtc(options.time);
  if (!time && !options.time.empty()) return one.status();
  const std::string time_utc = time ? ingest::FormatUtc(*time).value() : "";
  const std::vector<SpectrumRecord> several = Select(records, time_utc, options.place);
  if (several.empty()) return one.status();
  ShowAll(several, options.json, out);
  return absl::OkStatus();
}

}  // namespace onesea::app
