// onesea instruments: readings of virtual gauges as the ticks go by, as CSV.

#include <cmath>
#include <fstream>
#include <ostream>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_replace.h"
#include "client/app/cli_commands.h"
#include "client/app/cli_server.h"
#include "client/app/cli_world.h"
#include "client/app/json_writer.h"
#include "common/base/check.h"
#include "common/base/limits.h"

namespace onesea::app {
namespace {

constexpr double kSecondsMax = 1e7;

struct BodyPoint {
  std::uint32_t body_id = 0;
  Vec3d position_m;
};

absl::StatusOr<BodyPoint> ParseBodyPoint(absl::string_view option, absl::string_view text,
                                         std::uint32_t body_min) {
  ONESEA_ASSIGN_OR_RETURN(const std::vector<double> numbers,
                          InUsage(ParseNumbers(option, "BODY,X,Y,Z", text, kQueryCoordinateMaxM)));
  const double id = numbers[0];
  if (!(id >= body_min) || id != std::floor(id)) {
    return UsageError(absl::StrFormat("BODY of %s is %g, it must be a whole number from %d on",
                                      option, id, body_min));
  }
  return BodyPoint{static_cast<std::uint32_t>(id), {numbers[1], numbers[2], numbers[3]}};
}

// What is asked for, and what its columns are called.
struct Asked {
  wire::InstrumentRequest request;
  std::vector<std::string> columns;
};

void AddColumns(const std::string& where, std::initializer_list<const char*> what, Asked& asked) {
  for (const char* column : what) asked.columns.push_back(absl::StrCat(where, " ", column));
}

std::string Spaced(const std::string& text) { return absl::StrReplaceAll(text, {{",", " "}}); }

absl::StatusOr<Asked> ReadAsked(const Arguments& arguments) {
  Asked asked;
  std::vector<wire::Instrument>& list = asked.request.instruments;
  for (const std::string& text : arguments.GetAll("gauge")) {
    ONESEA_ASSIGN_OR_RETURN(const Vec2d place, InUsage(ParsePlace("--gauge", text)));
    list.push_back(wire::WaveGauge{place});
    AddColumns("gauge " + Spaced(text), {"height [m]"}, asked);
  }
  for (const std::string& text : arguments.GetAll("pressure")) {
    ONESEA_ASSIGN_OR_RETURN(const BodyPoint point, ParseBodyPoint("--pressure", text, 0));
    list.push_back(wire::PressureGauge{point.body_id, point.position_m});
    AddColumns("pressure " + Spaced(text), {"[Pa]"}, asked);
  }
  for (const std::string& text : arguments.GetAll("imu")) {
    ONESEA_ASSIGN_OR_RETURN(const BodyPoint point, ParseBodyPoint("--imu", text, 1));
    list.push_back(wire::Imu{point.body_id, point.position_m});
    AddColumns("imu " + Spaced(text),
               {"force x [m/s2]", "force y [m/s2]", "force z [m/s2]", "spin x [rad/s]",
                "spin y [rad/s]", "spin z [rad/s]", "turn w", "turn x", "turn y", "turn z"},
               asked);
  }
  for (const std::string& text : arguments.GetAll("motion")) {
    ONESEA_ASSIGN_OR_RETURN(const std::uint32_t id, ParseId("--motion", text));
    list.push_back(wire::Motion{id});
    AddColumns("motion " + text,
               {"x [m]", "y [m]", "z [m]", "turn w", "turn x", "turn y", "turn z",
                "velocity x [m/s]", "velocity y [m/s]", "velocity z [m/s]", "spin x [rad/s]",
                "spin y [rad/s]", "spin z [rad/s]"},
               asked);
  }
  if (list.empty()) {
    return UsageError("instruments needs --gauge, --pressure, --imu or --motion, once or more");
  }
  if (const auto text = arguments.Get("every")) {
    ONESEA_ASSIGN_OR_RETURN(const std::int64_t ticks,
                            InUsage(ParseInteger("--every", *text, 1, kTicksPerReadingMax)));
    asked.request.ticks_per_reading = static_cast<int>(ticks);
  }
  return asked;
}

void PrintReading(const client::InstrumentReading& reading, int tick_rate_hz, bool json,
                  std::ostream& out) {
  const double time_s = static_cast<double>(reading.tick) / tick_rate_hz;
  if (json) {
    JsonWriter writer;
    writer.BeginObject().Key("tick").Value(reading.tick).Key("time_s").Value(time_s);
    writer.Key("skipped").Value(reading.skipped_count).Key("values").BeginArray();
    for (const double value : reading.values) writer.Value(value);
    out << writer.EndArray().EndObject().text() << std::endl;
    return;
  }
  out << absl::StreamFormat("%d,%.6f,%d", reading.tick, time_s, reading.skipped_count);
  for (const double value : reading.values) out << absl::StreamFormat(",%.9g", value);
  out << std::endl;  // a line at a time, so that an end by ^C loses none
}

struct Written {
  std::int64_t readings = 0, skipped = 0;
};

absl::StatusOr<Written> WriteReadings(const ChosenSession& chosen, const Asked& asked,
                                      double seconds, bool json, std::ostream& out) {
  const int rate_hz = chosen.info.tick_rate_hz;
  const auto stream = chosen.server->StreamInstruments(asked.request);
  Written written;
  std::optional<Tick> last_tick;
  while (true) {
    ONESEA_ASSIGN_OR_RETURN(const client::InstrumentReading reading, stream->Receive());
    if (written.readings == 0) {
      last_tick = reading.tick + std::llround(seconds * rate_hz);
      if (!json) out << "tick,time [s],skipped," << absl::StrJoin(asked.columns, ",") << '\n';
    }
    if (reading.tick > *last_tick) return written;
    PrintReading(reading, rate_hz, json, out);
    if (!out) return FileError(absl::DataLossError("--csv: the file can't be written"));
    ++written.readings;
    written.skipped += reading.skipped_count;
    if (reading.tick == *last_tick) return written;
  }
}

absl::Status RunInstruments(const CliContext& context, const Arguments& arguments) {
  ONESEA_ASSIGN_OR_RETURN(Asked asked, ReadAsked(arguments));
  double seconds = kSecondsMax;
  if (const auto text = arguments.Get("seconds")) {
    ONESEA_ASSIGN_OR_RETURN(seconds, InUsage(ParseNumber("--seconds", *text, 0.0, kSecondsMax)));
  }
  ONESEA_ASSIGN_OR_RETURN(const ChosenSession chosen, ChooseSession(context));
  asked.request.session = chosen.info.name;
  const std::optional<std::string> path = arguments.Get("csv");
  if (!path) {
    return WriteReadings(chosen, asked, seconds, context.json, context.out).status();
  }
  std::ofstream file(*path);
  if (!file) return FileError(absl::NotFoundError(absl::StrCat(*path, ": can't be written")));
  ONESEA_ASSIGN_OR_RETURN(const Written written,
                          WriteReadings(chosen, asked, seconds, false, file));
  if (context.json) {
    JsonWriter json;
    json.BeginObject().Key("file").Value(*path).Key("readings").Value(written.readings);
    context.out << json.Key("skipped").Value(written.skipped).EndObject().text() << '\n';
  } else {
    context.out << absl::StreamFormat("%d readings in %s, %d left out\n", written.readings, *path,
                                      written.skipped);
  }
  return absl::OkStatus();
}

}  // namespace

CliCommand InstrumentsCommand() {
  return {
      .name = "instruments",
      .operands = "",
      .summary = "readings of wave gauges, pressure gauges and IMUs, as CSV",
      .details =
          "A line for each tick that is a multiple of --every. Body points are in the body's\n"
          "frame: x forward, y to port, z up from its shape's origin; BODY 0 is the world itself.\n"
          "An IMU reads specific force (+9.81 up at rest, 0 in free fall) and spin in body axes.\n"
          "A body that is gone reads nan. 'skipped' counts lines left out just before, because\n"
          "this program or its network was slow. While the session is held there are no lines.",
      .options = {{"gauge", "X,Y", "height of the surface; each may be given many times"},
                  {"pressure", "BODY,X,Y,Z", "above the atmosphere's"},
                  {"imu", "BODY,X,Y,Z", "force, spin, turn"},
                  {"motion", "BODY", "position, turn, velocity, spin; world axes"},
                  {"every", "N", "ticks; default 1"},
                  {"seconds", "N", "of the sea, then end; default until ^C"},
                  {"csv", "FILE", "default: to the standard output"}},
      .examples = {"onesea instruments --gauge 0,0 --gauge 10,0 --seconds 0.5",
                   "onesea instruments --pressure 0,0,0,-5 --every 6 --seconds 0.5 --json"},
      .run = RunInstruments};
}

}  // namespace onesea::app
