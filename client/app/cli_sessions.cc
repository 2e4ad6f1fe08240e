// The commands that list, create and delete sessions.

#include <ostream>

#include "absl/strings/str_format.h"
#include "client/app/cli_commands.h"
#include "client/app/cli_server.h"
#include "client/app/json_writer.h"
#include "common/base/check.h"
#include "common/wire/session_file.h"

namespace onesea::app {
namespace {

absl::string_view PaceText(Pace pace) {
  switch (pace) {
    case Pace::kRealTime:
      return "real time";
    case Pace::kHeld:
      return "held";
    case Pace::kLockStep:
      return "lock-step";
  }
  return "unknown";
}

double TimeS(const SessionInfo& info) { return TimeOfTick(info.tick, info.tick_rate_hz).Seconds(); }

void WriteSession(const SessionInfo& info, JsonWriter& json) {
  json.BeginObject().Key("name").Value(info.name).Key("sea_name").Value(info.sea_name);
  json.Key("pace").Value(std::string(PaceText(info.pace)));
  json.Key("speed").Value(info.speed).Key("actual_speed").Value(info.actual_speed);
  json.Key("tick").Value(info.tick).Key("time_s").Value(TimeS(info));
  json.Key("tick_rate_hz").Value(info.tick_rate_hz).Key("hs_m").Value(info.hs_m);
  json.Key("viewer_count").Value(info.viewer_count);
  json.Key("component_hash").Value(absl::StrFormat("%016x", info.component_hash));
  if (info.terrain_hash != 0) {
    json.Key("terrain_hash").Value(absl::StrFormat("%016x", info.terrain_hash));
  }
  json.Key("transform").Value(info.transform);
  json.EndObject();
}

void PrintSession(const CliContext& context, const SessionInfo& info) {
  if (context.json) {
    JsonWriter json;
    WriteSession(info, json);
    context.out << json.text() << '\n';
    return;
  }
  context.out << absl::StreamFormat(
      "%s: %s, Hs %.2f m, tick %d (%.3f s), %s at %g x, %d viewers, component hash %016x%s\n",
      info.name, info.sea_name, info.hs_m, info.tick, TimeS(info), PaceText(info.pace), info.speed,
      info.viewer_count, info.component_hash,
      info.terrain_hash == 0 ? "" : absl::StrFormat(", terrain hash %016x", info.terrain_hash));
}

absl::Status RunSessions(const CliContext& context, const Arguments&) {
  ONESEA_ASSIGN_OR_RETURN(const auto server, ConnectTo(context));
  ONESEA_ASSIGN_OR_RETURN(const std::vector<SessionInfo> sessions, server->ListSessions());
  if (context.json) {
    JsonWriter json;
    json.BeginObject().Key("sessions").BeginArray();
    for (const SessionInfo& info : sessions) WriteSession(info, json);
    context.out << json.EndArray().EndObject().text() << '\n';
    return absl::OkStatus();
  }
  if (sessions.empty()) context.out << "no session; create one with: onesea create FILE\n";
  for (const SessionInfo& info : sessions) PrintSession(context, info);
  return absl::OkStatus();
}

absl::Status RunCreate(const CliContext& context, const Arguments& arguments) {
  absl::StatusOr<SessionSpec> spec = wire::ReadSessionFile(arguments.operands()[0]);
  if (!spec.ok()) return FileError(spec.status());
  if (!context.session.empty()) spec->name = context.session;
  ONESEA_ASSIGN_OR_RETURN(const auto server, ConnectTo(context));
  ONESEA_ASSIGN_OR_RETURN(const SessionInfo info, server->CreateSession(*spec));
  PrintSession(context, info);
  return absl::OkStatus();
}

absl::Status RunDelete(const CliContext& context, const Arguments& arguments) {
  const std::string& name = arguments.operands()[0];
  ONESEA_ASSIGN_OR_RETURN(const auto server, ConnectTo(context));
  ONESEA_RETURN_IF_ERROR(server->DeleteSession(name));
  if (context.json) {
    JsonWriter json;
    context.out << json.BeginObject().Key("deleted").Value(name).EndObject().text() << '\n';
  } else {
    context.out << name << ": deleted\n";
  }
  return absl::OkStatus();
}

}  // namespace

CliCommand SessionsCommand() {
  return {.name = "sessions",
          .operands = "",
          .summary = "lists the server's sessions",
          .details = "",
          .options = {},
          .examples = {"onesea sessions", "onesea sessions --json"},
          .run = RunSessions};
}

CliCommand CreateCommand() {
  return {
      .name = "create",
      .operands = "FILE",
      .operand_count = 1,
      .summary = "creates a session from a session file",
      .details =
          "FILE is the text form of onesea.v1.SessionSpec, see deploy/sessions; spectrum files\n"
          "that it names are read here. --session gives it another name.",
      .options = {},
      .examples = {"onesea create deploy/sessions/tank.textproto",
                   "onesea create deploy/sessions/tank.textproto --session tank-2 --json"},
      .run = RunCreate};
}

CliCommand DeleteCommand() {
  return {.name = "delete",
          .operands = "NAME",
          .operand_count = 1,
          .summary = "deletes a session; its viewers are told",
          .details = "",
          .options = {},
          .examples = {"onesea delete tank", "onesea delete tank-2 --json"},
          .run = RunDelete};
}

}  // namespace onesea::app
