// `onesea rope` and `onesea ropes`: moorings and tows.

#include <ostream>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_split.h"
#include "client/app/cli_commands.h"
#include "client/app/cli_server.h"
#include "client/app/cli_world.h"
#include "client/app/json_writer.h"
#include "common/base/check.h"
#include "common/base/limits.h"

namespace onesea::app {
namespace {

// "BODY", "BODY@X,Y,Z" or "X,Y,Z".
absl::StatusOr<wire::RopeEnd> EndOption(const Arguments& arguments, const std::string& option) {
  const std::string what = absl::StrCat("--", option);
  const std::optional<std::string> text = arguments.Get(option);
  if (!text) return UsageError(absl::StrCat(what, " is needed: BODY, BODY@X,Y,Z or X,Y,Z"));
  wire::RopeEnd end;
  const std::pair<std::string, std::string> parts = absl::StrSplit(*text, absl::MaxSplits('@', 1));
  const bool in_world = absl::StrContains(parts.first, ',');
  if (!in_world) {
    ONESEA_ASSIGN_OR_RETURN(end.body_id, ParseId(what, parts.first));
  }
  const std::string& point = in_world ? *text : parts.second;
  if (!point.empty()) {
    ONESEA_ASSIGN_OR_RETURN(const std::vector<double> numbers,
                            InUsage(ParseNumbers(what, "X,Y,Z", point, kQueryCoordinateMaxM)));
    end.point_m = {numbers[0], numbers[1], numbers[2]};
  }
  return end;
}

absl::Status RunRope(const CliContext& context, const Arguments& arguments) {
  if (arguments.Has("remove")) {
    ONESEA_ASSIGN_OR_RETURN(const std::uint32_t id, IdOption(arguments, "remove"));
    return DoCommand(context, arguments, wire::RemoveRope{id},
                     absl::StrCat("rope ", id, " is gone"));
  }
  wire::RopeSpec rope;
  ONESEA_ASSIGN_OR_RETURN(rope.from, EndOption(arguments, "from"));
  ONESEA_ASSIGN_OR_RETURN(rope.to, EndOption(arguments, "to"));
  ONESEA_ASSIGN_OR_RETURN(rope.length_m,
                          NumberOr(arguments, "length", rope.length_m, 1e-3, kRopeLengthMaxM));
  ONESEA_ASSIGN_OR_RETURN(
      rope.stiffness_n_per_m,
      NumberOr(arguments, "stiffness", rope.stiffness_n_per_m, 1e-6, kRopeStiffnessMaxNPerM));
  return DoCommand(context, arguments, wire::AddRope{rope}, "rope $0 holds");
}

const client::ListedBody* FindBody(const client::BodyList& list, std::uint32_t id) {
  for (const client::ListedBody& body : list.bodies) {
    if (body.info.id == id) return &body;
  }
  return nullptr;
}

Vec3d PlaceOf(const client::BodyList& list, const wire::RopeEnd& end) {
  const client::ListedBody* body = FindBody(list, end.body_id);
  if (body == nullptr) return end.point_m;
  return body->state.position_m +
         Rotate(body->state.turn, end.point_m - body->info.centre_of_mass_m);
}

double ApartM(const client::BodyList& list, const wire::RopeSpec& rope) {
  return Norm(PlaceOf(list, rope.to) - PlaceOf(list, rope.from));
}

// As --from and --to take it, and the body's name.
std::string EndText(const client::BodyList& list, const wire::RopeEnd& end) {
  std::string point =
      absl::StrFormat("%.6g,%.6g,%.6g", end.point_m.x, end.point_m.y, end.point_m.z);
  if (end.body_id == 0) return point;
  const client::ListedBody* body = FindBody(list, end.body_id);
  return absl::StrCat(end.body_id, "@", point, " ", body != nullptr ? body->info.name : "");
}

void WriteEnd(JsonWriter& json, const wire::RopeEnd& end) {
  json.BeginObject().Key("body").Value(static_cast<std::int64_t>(end.body_id));
  json.Key("x_m").Value(end.point_m.x).Key("y_m").Value(end.point_m.y);
  json.Key("z_m").Value(end.point_m.z).EndObject();
}

absl::Status RunRopes(const CliContext& context, const Arguments&) {
  ONESEA_ASSIGN_OR_RETURN(const ChosenSession chosen, ChooseSession(context));
  ONESEA_ASSIGN_OR_RETURN(const client::BodyList list, chosen.server->ListBodies(chosen.info.name));
  if (context.json) {
    JsonWriter json;
    json.BeginObject().Key("session").Value(chosen.info.name).Key("tick").Value(list.tick);
    json.Key("ropes").BeginArray();
    for (const wire::TiedRope& rope : list.ropes) {
      json.BeginObject().Key("id").Value(static_cast<std::int64_t>(rope.id));
      WriteEnd(json.Key("from"), rope.spec.from);
      WriteEnd(json.Key("to"), rope.spec.to);
      json.Key("length_m").Value(rope.spec.length_m);
      json.Key("apart_m").Value(ApartM(list, rope.spec)).EndObject();
    }
    context.out << json.EndArray().EndObject().text() << '\n';
    return absl::OkStatus();
  }
  context.out << absl::StreamFormat("%s at tick %d: %d ropes\n", chosen.info.name, list.tick,
                                    list.ropes.size());
  for (const wire::TiedRope& rope : list.ropes) {
    const double apart_m = ApartM(list, rope.spec);
    context.out << absl::StreamFormat("%4d  %-28s to  %-28s  %7.2f m, ends %7.2f m apart, %s\n",
                                      rope.id, EndText(list, rope.spec.from),
                                      EndText(list, rope.spec.to), rope.spec.length_m, apart_m,
                                      apart_m > rope.spec.length_m ? "taut" : "slack");
  }
  return absl::OkStatus();
}

}  // namespace

CliCommand RopesCommand() {
  return {.name = "ropes",
          .operands = "",
          .summary = "lists the ropes of a session",
          .details = "Ends are as rope takes them: a point of a body, or a place in the world.",
          .options = {},
          .examples = {"onesea ropes", "onesea ropes --json"},
          .run = RunRopes};
}

CliCommand RopeCommand() {
  return {
      .name = "rope",
      .operands = "",
      .summary = "moors a body, lets it tow another, or takes such a rope away",
      .details =
          "An end is BODY (its origin), BODY@X,Y,Z (a point of it, body frame: x forward,\n"
          "y to port, z up) or X,Y,Z (a place in the world). A rope only pulls. Viewers see it;\n"
          "onesea ropes lists them.",
      .options = {{"from", "END", "one end"},
                  {"to", "END", "the other"},
                  {"length", "M", "slack below it; default 10"},
                  {"stiffness", "N/M", "default 10000"},
                  {"remove", "ROPE", "takes the rope away instead"},
                  {"lease", "TEXT", "of the bodies, if somebody holds them"}},
      .examples = {"onesea rope --from 1@3,0,0.5 --to 20,0,1 --length 20",
                   "onesea rope --from 1@-3,0,0.3 --to 2@0,0,0.3 --length 20",
                   "onesea rope --remove 3"},
      .run = RunRope};
}

}  // namespace onesea::app
