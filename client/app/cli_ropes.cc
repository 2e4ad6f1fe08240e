// `onesea rope`: moorings and tows.

#include <ostream>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "client/app/cli_commands.h"
#include "client/app/cli_server.h"
#include "client/app/cli_world.h"
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

}  // namespace

CliCommand RopeCommand() {
  return {.name = "rope",
          .operands = "",
          .summary = "moors a body, lets it tow another, or takes such a rope away",
          .details =
              "An end is BODY (its origin), BODY@X,Y,Z (a point of it, body frame: x forward,\n"
              "y to port, z up) or X,Y,Z (a place in the world). A rope only pulls.",
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
