// onesea watch: joins a session as a game would and shows each second how well this process follows
// it.

#include <atomic>
#include <csignal>
#include <ostream>

#include "absl/strings/str_format.h"
#include "client/app/cli_commands.h"
#include "client/app/cli_server.h"
#include "client/app/json_writer.h"
#include "common/base/check.h"
#include "common/base/clock.h"
#include "onesea/onesea.h"

namespace onesea::app {
namespace {

constexpr double kWatchMaxS = 1e7;

std::atomic<bool> interrupted = false;

struct Reading {
  double time_s = 0.0;
  Tick tick = 0;
  double bytes_per_s = 0.0;
  SessionReport session;
  DriftReport drift;
};

Reading Read(const Sea& sea, std::int64_t bytes_before, double over_s) {
  Reading reading{.time_s = sea.Now(), .session = sea.session(), .drift = sea.drift()};
  reading.tick = TickAtOrBefore(SimTime::FromSeconds(reading.time_s), reading.session.tick_rate_hz);
  reading.bytes_per_s = static_cast<double>(reading.session.bytes_received - bytes_before) / over_s;
  return reading;
}

void PrintJson(const Reading& reading, std::ostream& out) {
  JsonWriter json;
  json.BeginObject().Key("session").Value(reading.session.name);
  json.Key("connected").Value(reading.session.connected);
  json.Key("connection_count").Value(reading.session.connection_count);
  json.Key("tick").Value(reading.tick).Key("time_s").Value(reading.time_s);
  json.Key("clock_error_s");
  if (reading.drift.clock_error_s < 0) {
    json.Null();
  } else {
    json.Value(reading.drift.clock_error_s);
  }
  json.Key("drift_m").Value(reading.drift.last_m);
  json.Key("worst_drift_m").Value(reading.drift.worst_m);
  json.Key("comparisons").Value(reading.drift.comparisons);
  json.Key("bytes_per_s").Value(reading.bytes_per_s);
  json.Key("hs_m").Value(reading.session.hs_m);
  json.Key("component_hash").Value(absl::StrFormat("%016x", reading.session.component_hash));
  out << json.EndObject().text() << std::endl;
}

void PrintText(const Reading& reading, std::ostream& out) {
  out << absl::StreamFormat("%s: tick %d (%.3f s), clock ±%.3f ms, drift ", reading.session.name,
                            reading.tick, reading.time_s, 1e3 * reading.drift.clock_error_s);
  if (reading.drift.comparisons == 0) {
    out << "not compared yet";
  } else {
    out << absl::StreamFormat("%.3f mm (worst %.3f)", 1e3 * reading.drift.last_m,
                              1e3 * reading.drift.worst_m);
  }
  out << absl::StreamFormat(", %.0f bytes/s, Hs %.2f m%s", reading.bytes_per_s,
                            reading.session.hs_m,
                            reading.session.connected ? "" : ", connection lost: trying again")
      << std::endl;
}

absl::Status RunWatch(const CliContext& context, const Arguments& arguments) {
  double seconds = kWatchMaxS;
  if (const auto text = arguments.Get("seconds")) {
    ONESEA_ASSIGN_OR_RETURN(seconds, InUsage(ParseNumber("--seconds", *text, 1.0, kWatchMaxS)));
  }
  ONESEA_ASSIGN_OR_RETURN(const ChosenSession chosen, ChooseSession(context));
  ONESEA_ASSIGN_OR_RETURN(const auto sea, JoinSession(context, chosen.info.name, false));
  std::signal(SIGINT, [](int) { interrupted = true; });
  const Clock& clock = SystemClock();
  const std::int64_t start_ns = clock.MonotonicNs();
  std::int64_t bytes_before = sea->session().bytes_received;
  for (std::int64_t second = 1; static_cast<double>(second) <= seconds; ++second) {
    // Short sleeps, so that ^C ends at once.
    const std::int64_t due_ns = start_ns + second * 1'000'000'000;
    while (!interrupted && clock.MonotonicNs() < due_ns) {
      clock.SleepUntil(std::min(due_ns, clock.MonotonicNs() + 50'000'000));
    }
    if (interrupted) return absl::OkStatus();
    const Reading reading = Read(*sea, bytes_before, 1.0);
    bytes_before = reading.session.bytes_received;
    if (context.json) {
      PrintJson(reading, context.out);
    } else {
      PrintText(reading, context.out);
    }
    ONESEA_RETURN_IF_ERROR(sea->status());
  }
  return absl::OkStatus();
}

}  // namespace

CliCommand WatchCommand() {
  return {
      .name = "watch",
      .operands = "",
      .summary = "follows a session: tick, clock error, drift, bytes a second",
      .details =
          "Joins as a game would that needs the waves alone, computes them here and compares them\n"
          "each second with heights that the server sent. Ends with ^C. A lost connection is "
          "found\n"
          "again by itself.",
      .options = {{"seconds", "N", "end after N seconds, at least 1"}},
      .examples = {"onesea watch --seconds 3", "onesea watch --seconds 2 --json"},
      .run = RunWatch};
}

}  // namespace onesea::app
