// The commands that steer a session: weather, hold, resume, step, speed, hash.

#include <ostream>

#include "absl/strings/str_format.h"
#include "client/app/cli_commands.h"
#include "client/app/cli_server.h"
#include "client/app/json_writer.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/wire/session_file.h"

namespace onesea::app {
namespace {

// For people; a server's tick may be any number, so not TimeOfTick().
double SecondsAt(Tick tick, int tick_rate_hz) { return static_cast<double>(tick) / tick_rate_hz; }

std::string HexText(std::uint64_t hash) { return absl::StrFormat("%016x", hash); }

absl::Status RunWeather(const CliContext& context, const Arguments& arguments) {
  const std::optional<std::string> path = arguments.Get("to");
  if (!path.has_value()) return UsageError("weather needs --to FILE, a sea file");
  double over_s = 0.0;
  if (const auto text = arguments.Get("over")) {
    ONESEA_ASSIGN_OR_RETURN(over_s, InUsage(ParseSpan("--over", *text, 0.0, kWeatherSpanMaxS)));
  }
  const absl::StatusOr<sea::SeaState> sea = wire::ReadSeaFile(*path);
  if (!sea.ok()) return FileError(sea.status());
  ONESEA_ASSIGN_OR_RETURN(const ChosenSession chosen, ChooseSession(context));
  ONESEA_ASSIGN_OR_RETURN(
      const client::WeatherSpan change,
      chosen.server->ChangeWeather(chosen.info.name,
                                   {.sea = *sea, .over_s = over_s, .start_tick = std::nullopt}));
  if (context.json) {
    JsonWriter json;
    json.BeginObject().Key("session").Value(chosen.info.name);
    json.Key("sea_name").Value(sea->name);
    json.Key("start_tick").Value(change.start_tick).Key("end_tick").Value(change.end_tick);
    context.out << json.EndObject().text() << '\n';
    return absl::OkStatus();
  }
  const int rate_hz = chosen.info.tick_rate_hz;
  context.out << absl::StreamFormat(
      "%s: the sea turns into '%s' from tick %d (%.3f s) to tick %d (%.3f s)\n", chosen.info.name,
      sea->name, change.start_tick, SecondsAt(change.start_tick, rate_hz), change.end_tick,
      SecondsAt(change.end_tick, rate_hz));
  return absl::OkStatus();
}

// hold and resume answer with the tick at which it happened.
absl::Status PrintTick(const CliContext& context, const SessionInfo& info, Tick tick,
                       absl::string_view what) {
  if (context.json) {
    JsonWriter json;
    json.BeginObject().Key("session").Value(info.name).Key("tick").Value(tick);
    context.out << json.EndObject().text() << '\n';
    return absl::OkStatus();
  }
  context.out << absl::StreamFormat("%s: %s at tick %d (%.3f s)\n", info.name, what, tick,
                                    SecondsAt(tick, info.tick_rate_hz));
  return absl::OkStatus();
}

absl::Status RunHold(const CliContext& context, const Arguments&) {
  ONESEA_ASSIGN_OR_RETURN(const ChosenSession chosen, ChooseSession(context));
  ONESEA_ASSIGN_OR_RETURN(const Tick tick, chosen.server->Hold(chosen.info.name));
  return PrintTick(context, chosen.info, tick, "held");
}

absl::Status RunResume(const CliContext& context, const Arguments&) {
  ONESEA_ASSIGN_OR_RETURN(const ChosenSession chosen, ChooseSession(context));
  ONESEA_ASSIGN_OR_RETURN(const Tick tick, chosen.server->Resume(chosen.info.name));
  return PrintTick(context, chosen.info, tick, "goes on");
}

absl::Status RunStep(const CliContext& context, const Arguments& arguments) {
  ONESEA_ASSIGN_OR_RETURN(const std::int64_t ticks,
                          InUsage(ParseInteger("N", arguments.operands()[0], 1, kStepTicksMax)));
  ONESEA_ASSIGN_OR_RETURN(const ChosenSession chosen, ChooseSession(context));
  const client::StepOptions options{.ticks = ticks,
                                    .participant = arguments.Get("participant").value_or("onesea"),
                                    .query = std::nullopt};
  ONESEA_ASSIGN_OR_RETURN(const client::StepAnswer answer,
                          chosen.server->Step(chosen.info.name, options));
  if (context.json) {
    JsonWriter json;
    json.BeginObject().Key("session").Value(chosen.info.name).Key("tick").Value(answer.tick);
    json.Key("state_hash").Value(HexText(answer.state_hash));
    context.out << json.EndObject().text() << '\n';
    return absl::OkStatus();
  }
  context.out << absl::StreamFormat(
      "%s: stepped to tick %d (%.3f s), state hash %016x\n", chosen.info.name, answer.tick,
      SecondsAt(answer.tick, chosen.info.tick_rate_hz), answer.state_hash);
  return absl::OkStatus();
}

absl::Status RunSpeed(const CliContext& context, const Arguments& arguments) {
  ONESEA_ASSIGN_OR_RETURN(const double speed,
                          InUsage(ParseNumber("X", arguments.operands()[0], kSpeedMin, kSpeedMax)));
  ONESEA_ASSIGN_OR_RETURN(const ChosenSession chosen, ChooseSession(context));
  ONESEA_ASSIGN_OR_RETURN(const double reached, chosen.server->SetSpeed(chosen.info.name, speed));
  if (context.json) {
    JsonWriter json;
    json.BeginObject().Key("session").Value(chosen.info.name).Key("speed").Value(reached);
    context.out << json.EndObject().text() << '\n';
    return absl::OkStatus();
  }
  context.out << absl::StreamFormat("%s: %g sea seconds a second\n", chosen.info.name, reached);
  return absl::OkStatus();
}

absl::Status RunHash(const CliContext& context, const Arguments&) {
  ONESEA_ASSIGN_OR_RETURN(const ChosenSession chosen, ChooseSession(context));
  ONESEA_ASSIGN_OR_RETURN(const client::StateHashes hash,
                          chosen.server->GetStateHash(chosen.info.name));
  if (context.json) {
    JsonWriter json;
    json.BeginObject().Key("session").Value(chosen.info.name).Key("tick").Value(hash.tick);
    json.Key("component_hash").Value(HexText(hash.component_hash));
    json.Key("state_hash").Value(HexText(hash.state_hash));
    context.out << json.EndObject().text() << '\n';
    return absl::OkStatus();
  }
  context.out << absl::StreamFormat("%s: tick %d, component hash %016x, state hash %016x\n",
                                    chosen.info.name, hash.tick, hash.component_hash,
                                    hash.state_hash);
  return absl::OkStatus();
}

}  // namespace

CliCommand WeatherCommand() {
  return {
      .name = "weather",
      .operands = "",
      .summary = "changes the sea over a span of time",
      .details =
          "The sea turns from what it is then into the one in FILE (text form of\n"
          "onesea.v1.SeaState, see deploy/seas). Nothing jumps: phases stay, energy moves.",
      .options = {{"to", "FILE", "the sea to reach"},
                  {"over", "SPAN", "how long it takes, in sea time: 60s, 5min; default at once"}},
      .examples = {"onesea weather --over 60s --to deploy/seas/fresh-breeze.textproto",
                   "onesea weather --over 1h --to deploy/seas/swell-and-wind-sea.textproto --json"},
      .run = RunWeather};
}

CliCommand HoldCommand() {
  return {.name = "hold",
          .operands = "",
          .summary = "stops a session's time",
          .details = "",
          .options = {},
          .examples = {"onesea hold", "onesea hold --json"},
          .run = RunHold};
}

CliCommand ResumeCommand() {
  return {.name = "resume",
          .operands = "",
          .summary = "lets a held session's time go on",
          .details = "",
          .options = {},
          .examples = {"onesea resume", "onesea resume --json"},
          .run = RunResume};
}

CliCommand StepCommand() {
  return {.name = "step",
          .operands = "N",
          .operand_count = 1,
          .summary = "advances a held or lock-step session by N ticks",
          .details =
              "Answers when the ticks are complete. In a lock-step session of several\n"
              "participants it waits for the others, up to the session's deadline.",
          .options = {{"participant", "NAME", "who steps; default onesea"}},
          .examples = {"onesea step 60", "onesea step 1 --json"},
          .run = RunStep};
}

CliCommand SpeedCommand() {
  return {.name = "speed",
          .operands = "X",
          .operand_count = 1,
          .summary = "sets sea seconds per real second",
          .details = "",
          .options = {},
          .examples = {"onesea speed 2", "onesea speed 1 --json"},
          .run = RunSpeed};
}

CliCommand HashCommand() {
  return {
      .name = "hash",
      .operands = "",
      .summary = "prints component and state hash, to compare servers",
      .details =
          "The component hash is of the recipe's waves: equal on every server and client of the\n"
          "same sea. The state hash is of the session at its tick.",
      .options = {},
      .examples = {"onesea hash", "onesea hash --json"},
      .run = RunHash};
}

}  // namespace onesea::app
