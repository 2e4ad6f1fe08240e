// The commands on bodies: spawn, presets, bodies, drive, impulse, remove.

#include <cmath>
#include <numbers>
#include <ostream>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "client/app/cli_commands.h"
#include "client/app/cli_server.h"
#include "client/app/cli_world.h"
#include "client/app/json_writer.h"
#include "common/base/check.h"
#include "common/base/limits.h"

namespace onesea::app {
namespace {

absl::Status RunSpawn(const CliContext& context, const Arguments& arguments) {
  wire::SpawnBody spawn;
  spawn.body.preset = arguments.operands()[0];
  ONESEA_ASSIGN_OR_RETURN(const Vec2d place, PlaceOption(arguments));
  ONESEA_ASSIGN_OR_RETURN(const double heading_deg,
                          NumberOr(arguments, "heading", 90.0, -360.0, 360.0));
  if (const auto name = arguments.Get("name")) spawn.body.name = *name;
  spawn.start.position_m = {place.x, place.y, 0.0};
  // Headings count clockwise from north, turns counter-clockwise from east.
  spawn.start.turn = TurnBy({0, 0, (90.0 - heading_deg) * std::numbers::pi / 180.0});
  ONESEA_ASSIGN_OR_RETURN(const ChosenSession chosen, ChooseSession(context));
  ONESEA_ASSIGN_OR_RETURN(const client::CommandAnswer answer,
                          chosen.server->Command(HeaderFor(chosen.info, arguments), spawn));
  if (!arguments.Has("keep")) {
    wire::CommandHeader header = HeaderFor(chosen.info, arguments);
    header.lease = answer.lease;
    ONESEA_RETURN_IF_ERROR(chosen.server->Command(header, wire::ReleaseLease{answer.id}).status());
  }
  if (!arguments.Has("no-wake")) {
    wire::RegionSpec region;
    region.middle_m = place;
    region.follow_body_id = answer.id;
    region.rest_after_s = wire::kRestAfterS;
    const absl::Status added =
        chosen.server->Command(HeaderFor(chosen.info, arguments), wire::AddRegion{region}).status();
    if (!added.ok()) {
      return absl::Status(
          added.code(),
          absl::StrCat("body ", answer.id, " is afloat, without wake: ", added.message()));
    }
  }
  PrintDone(context, chosen.info, answer,
            arguments.Has("keep") ? absl::StrCat("body ", answer.id, ", lease ", answer.lease, ",")
                                  : absl::StrCat("body ", answer.id));
  return absl::OkStatus();
}

absl::Status RunPresets(const CliContext& context, const Arguments&) {
  ONESEA_ASSIGN_OR_RETURN(const auto server, ConnectTo(context));
  ONESEA_ASSIGN_OR_RETURN(const std::vector<client::ListedPreset> presets, server->ListPresets());
  if (!context.json) {
    for (const client::ListedPreset& preset : presets) {
      context.out << absl::StreamFormat("%-10s  %s\n", preset.name, preset.summary);
    }
    return absl::OkStatus();
  }
  JsonWriter json;
  json.BeginObject().Key("presets").BeginArray();
  for (const client::ListedPreset& preset : presets) {
    json.BeginObject().Key("name").Value(preset.name).Key("summary").Value(preset.summary);
    json.EndObject();
  }
  context.out << json.EndArray().EndObject().text() << '\n';
  return absl::OkStatus();
}

absl::Status RunBodies(const CliContext& context, const Arguments&) {
  ONESEA_ASSIGN_OR_RETURN(const ChosenSession chosen, ChooseSession(context));
  ONESEA_ASSIGN_OR_RETURN(const client::BodyList list, chosen.server->ListBodies(chosen.info.name));
  if (context.json) {
    JsonWriter json;
    json.BeginObject().Key("session").Value(chosen.info.name).Key("tick").Value(list.tick);
    json.Key("bodies").BeginArray();
    for (const client::ListedBody& body : list.bodies) {
      json.BeginObject().Key("id").Value(static_cast<std::int64_t>(body.info.id));
      json.Key("name").Value(body.info.name).Key("driver").Value(body.driver);
      json.Key("x_m").Value(body.state.position_m.x).Key("y_m").Value(body.state.position_m.y);
      json.Key("z_m").Value(body.state.position_m.z);
      json.Key("speed_m_per_s").Value(Norm(body.state.velocity_m_per_s));
      json.EndObject();
    }
    context.out << json.EndArray().EndObject().text() << '\n';
    return absl::OkStatus();
  }
  context.out << absl::StreamFormat("%s at tick %d: %d bodies\n", chosen.info.name, list.tick,
                                    list.bodies.size());
  for (const client::ListedBody& body : list.bodies) {
    const Vec3d at = body.state.position_m;
    context.out << absl::StreamFormat("%4d  %-12s  at %9.2f, %9.2f, %6.2f m  %5.2f m/s  %s\n",
                                      body.info.id, body.info.name, at.x, at.y, at.z,
                                      Norm(body.state.velocity_m_per_s), body.driver);
  }
  return absl::OkStatus();
}

absl::Status RunDrive(const CliContext& context, const Arguments& arguments) {
  ONESEA_ASSIGN_OR_RETURN(const std::uint32_t body, BodyOperand(arguments));
  ONESEA_ASSIGN_OR_RETURN(const double throttle, NumberOr(arguments, "throttle", 0.0, -1.0, 1.0));
  ONESEA_ASSIGN_OR_RETURN(const double rudder, NumberOr(arguments, "rudder", 0.0, -1.0, 1.0));
  return DoCommand(context, arguments, wire::DriveBody{body, {throttle}, {rudder}},
                   absl::StrFormat("body %d: throttle %.2f, rudder %.2f", body, throttle, rudder));
}

absl::Status RunImpulse(const CliContext& context, const Arguments& arguments) {
  wire::ApplyImpulse impulse;
  ONESEA_ASSIGN_OR_RETURN(impulse.body_id, BodyOperand(arguments));
  const std::optional<std::string> by = arguments.Get("by");
  if (!by) return UsageError("--by X,Y,Z is needed, newton seconds east, north and up");
  ONESEA_ASSIGN_OR_RETURN(const std::vector<double> parts,
                          InUsage(ParseNumbers("--by", "X,Y,Z", *by, kImpulseMaxNS)));
  impulse.impulse_n_s = {parts[0], parts[1], parts[2]};
  if (const std::optional<std::string> at = arguments.Get("at")) {
    ONESEA_ASSIGN_OR_RETURN(const std::vector<double> place,
                            InUsage(ParseNumbers("--at", "X,Y,Z", *at, kQueryCoordinateMaxM)));
    impulse.position_m = Vec3d{place[0], place[1], place[2]};
  }
  return DoCommand(context, arguments, impulse,
                   absl::StrCat("body ", impulse.body_id, " is pushed"));
}

absl::Status RunRemove(const CliContext& context, const Arguments& arguments) {
  ONESEA_ASSIGN_OR_RETURN(const std::uint32_t body, BodyOperand(arguments));
  return DoCommand(context, arguments, wire::RemoveBody{body},
                   absl::StrCat("body ", body, " is gone"));
}

}  // namespace

CliCommand SpawnCommand() {
  return {
      .name = "spawn",
      .operands = "PRESET",
      .operand_count = 1,
      .summary = "puts a ready-made body afloat: a boat, a buoy, a crate, ...",
      .details =
          "onesea presets lists the bodies that the server has.\n"
          "A region of the interaction layer follows the body, so that it leaves a wake; it is\n"
          "given back while the body has been at rest for more than a minute.\n"
          "Anybody may drive it afterwards, unless --keep.",
      .options = {{"at", "X,Y", "where, metres east and north"},
                  {"heading", "DEG", "of its bow, clockwise from north; default 90"},
                  {"name", "TEXT", "default the preset's"},
                  {"no-wake", "", "no region follows it"},
                  {"keep", "", "keep and print the lease: only who shows it may drive"}},
      .examples = {"onesea spawn boat --at 0,0", "onesea spawn crate --at 12,3 --no-wake"},
      .run = RunSpawn};
}

CliCommand PresetsCommand() {
  return {.name = "presets",
          .operands = "",
          .summary = "lists the bodies that spawn knows",
          .details = "",
          .options = {},
          .examples = {"onesea presets", "onesea presets --json"},
          .run = RunPresets};
}

CliCommand BodiesCommand() {
  return {.name = "bodies",
          .operands = "",
          .summary = "lists the bodies of a session",
          .details = "",
          .options = {},
          .examples = {"onesea bodies", "onesea bodies --json"},
          .run = RunBodies};
}

CliCommand DriveCommand() {
  return {.name = "drive",
          .operands = "BODY",
          .operand_count = 1,
          .summary = "sets throttle and rudder of a body",
          .details = "They hold until the next drive.",
          .options = {{"throttle", "T", "[-1, 1], default 0"},
                      {"rudder", "R", "[-1, 1], positive turns to port; default 0"},
                      {"lease", "TEXT", "of the body, if somebody holds it"}},
          .examples = {"onesea drive 1 --throttle 1 --rudder 0.3"},
          .run = RunDrive};
}

CliCommand ImpulseCommand() {
  return {.name = "impulse",
          .operands = "BODY",
          .operand_count = 1,
          .summary = "pushes a body at once, as a blow does",
          .details = "Mass times change of velocity; the water that moves along counts too.",
          .options = {{"by", "X,Y,Z", "newton seconds east, north and up"},
                      {"at", "X,Y,Z", "where it hits, metres; default the centre of mass"},
                      {"lease", "TEXT", "of the body, if somebody holds it"}},
          .examples = {"onesea impulse 1 --by 500,0,0", "onesea impulse 1 --by 0,0,200 --at 2,0,0"},
          .run = RunImpulse};
}

CliCommand RemoveCommand() {
  return {.name = "remove",
          .operands = "BODY",
          .operand_count = 1,
          .summary = "takes a body out of a session",
          .details = "",
          .options = {{"lease", "TEXT", "of the body, if somebody holds it"}},
          .examples = {"onesea remove 1"},
          .run = RunRemove};
}

}  // namespace onesea::app
