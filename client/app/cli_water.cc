// The commands on the water: explode, obstacle, region.

#include <ostream>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "client/app/cli_commands.h"
#include "client/app/cli_server.h"
#include "client/app/cli_world.h"
#include "common/base/check.h"
#include "common/base/limits.h"

namespace onesea::app {
namespace {

constexpr double kKilogramOfTntJ = 4.2e6;

absl::Status RunExplode(const CliContext& context, const Arguments& arguments) {
  ONESEA_ASSIGN_OR_RETURN(const Vec2d place, PlaceOption(arguments));
  ONESEA_ASSIGN_OR_RETURN(const double tnt_kg, NumberOr(arguments, "tnt", 1.0, 1e-3, 2000.0));
  ONESEA_ASSIGN_OR_RETURN(const double depth_m, NumberOr(arguments, "depth", 1.0, 0.0, 1000.0));
  const wire::Explode explode{{place.x, place.y, -depth_m}, tnt_kg * kKilogramOfTntJ};
  return DoCommand(context, arguments, explode, "an explosion");
}

absl::Status RunObstacle(const CliContext& context, const Arguments& arguments) {
  if (arguments.Has("remove")) {
    if (arguments.Has("corner")) return UsageError("--remove and --corner exclude each other");
    ONESEA_ASSIGN_OR_RETURN(const std::uint32_t id, IdOption(arguments, "remove"));
    return DoCommand(context, arguments, wire::RemoveObstacle{id},
                     absl::StrCat("obstacle ", id, " is gone"));
  }
  wire::SetObstacle obstacle;
  for (const std::string& text : arguments.GetAll("corner")) {
    ONESEA_ASSIGN_OR_RETURN(obstacle.corners_m.emplace_back(),
                            InUsage(ParsePlace("--corner", text)));
  }
  if (obstacle.corners_m.size() < 3) {
    return UsageError("obstacle needs --corner X,Y three times or more, or --remove ID");
  }
  ONESEA_ASSIGN_OR_RETURN(obstacle.obstacle_id, IdOption(arguments, "replace"));
  return DoCommand(context, arguments, obstacle, "obstacle $0");
}

absl::StatusOr<wire::RegionSolver> SolverOption(const Arguments& arguments) {
  const std::string solver = arguments.Get("solver").value_or("iwave");
  if (solver == "iwave") return wire::RegionSolver::kIwave;
  if (solver == "wave-equation") return wire::RegionSolver::kWaveEquation;
  if (solver == "shallow-water") return wire::RegionSolver::kShallowWater;
  return UsageError(
      absl::StrCat("--solver is '", solver, "', it must be iwave, wave-equation or shallow-water"));
}

absl::Status SizeOption(const Arguments& arguments, wire::RegionSpec& region) {
  const std::optional<std::string> text = arguments.Get("cells");
  if (!text) return absl::OkStatus();
  const std::vector<std::string> parts = absl::StrSplit(*text, 'x');
  if (parts.size() > 2) {
    return UsageError(absl::StrCat("--cells is '", *text, "', it must be N or COLUMNSxROWS"));
  }
  ONESEA_ASSIGN_OR_RETURN(
      const std::int64_t columns,
      InUsage(ParseInteger("--cells", parts.front(), kRegionSideMin, kRegionSideMax)));
  ONESEA_ASSIGN_OR_RETURN(
      const std::int64_t rows,
      InUsage(ParseInteger("--cells", parts.back(), kRegionSideMin, kRegionSideMax)));
  region.columns = static_cast<int>(columns);
  region.rows = static_cast<int>(rows);
  return absl::OkStatus();
}

absl::Status RunRegion(const CliContext& context, const Arguments& arguments) {
  if (arguments.Has("remove")) {
    if (arguments.Has("at") || arguments.Has("follow")) {
      return UsageError("--remove excludes --at and --follow");
    }
    ONESEA_ASSIGN_OR_RETURN(const std::uint32_t id, IdOption(arguments, "remove"));
    return DoCommand(context, arguments, wire::RemoveRegion{id},
                     absl::StrCat("region ", id, " is gone"));
  }
  wire::RegionSpec region;
  ONESEA_ASSIGN_OR_RETURN(region.follow_body_id, IdOption(arguments, "follow"));
  if (region.follow_body_id == 0) {
    if (!arguments.Has("at")) {
      return UsageError("region needs --at X,Y or --follow BODY, or --remove ID");
    }
    ONESEA_ASSIGN_OR_RETURN(region.middle_m, PlaceOption(arguments));
  }
  ONESEA_ASSIGN_OR_RETURN(region.solver, SolverOption(arguments));
  ONESEA_RETURN_IF_ERROR(SizeOption(arguments, region));
  ONESEA_ASSIGN_OR_RETURN(
      region.cell_m, NumberOr(arguments, "cell", region.cell_m, kRegionCellMinM, kRegionCellMaxM));
  ONESEA_ASSIGN_OR_RETURN(region.damping_per_s, NumberOr(arguments, "damping", 0.0, 0.0, 10.0));
  ONESEA_ASSIGN_OR_RETURN(region.rest_after_s,
                          NumberOr(arguments, "rest", 0.0, 0.0, kRestAfterMaxS));
  return DoCommand(context, arguments, wire::AddRegion{region}, "region $0");
}

}  // namespace

CliCommand ExplodeCommand() {
  return {.name = "explode",
          .operands = "",
          .summary = "sets off an underwater explosion in a region of the interaction layer",
          .details = "",
          .options = {{"at", "X,Y", "where, metres east and north"},
                      {"tnt", "KG", "default 1"},
                      {"depth", "M", "default 1"}},
          .examples = {"onesea explode --at 10,0 --tnt 2"},
          .run = RunExplode};
}

CliCommand ObstacleCommand() {
  return {
      .name = "obstacle",
      .operands = "",
      .summary = "puts up a wall that waves don't pass, or takes one away",
      .details =
          "A polygon that doesn't cross itself, of 3 to 64 corners, closed by itself. It acts on\n"
          "the interaction layer: wakes and the swell are reflected where a region covers it.",
      .options = {{"corner", "X,Y", "metres east and north; three times or more, in order"},
                  {"replace", "ID", "this obstacle gets the new corners"},
                  {"remove", "ID", "takes this obstacle away"}},
      .examples = {"onesea obstacle --corner 30,-20 --corner 32,-20 --corner 32,20 --corner 30,20",
                   "onesea obstacle --remove 1"},
      .run = RunObstacle};
}

CliCommand RegionCommand() {
  return {
      .name = "region",
      .operands = "",
      .summary = "lets the water answer somewhere: a region of wakes, or takes one away",
      .details =
          "A grid of the interaction layer, which stands at a place or follows a body. Without\n"
          "one there are neither wakes nor reflections nor explosions.",
      .options = {{"at", "X,Y", "its middle, metres east and north"},
                  {"follow", "BODY", "its middle goes with this body"},
                  {"cells", "N", "N or COLUMNSxROWS, multiples of 32 in [64, 1024]; default 256"},
                  {"cell", "M", "metres a cell; default 0.5"},
                  {"solver", "NAME",
                   "iwave (default), wave-equation or shallow-water; these need a depth"},
                  {"damping", "D", "per second, [0, 10]; default 0"},
                  {"rest", "S", "given back once its body was at rest for so long; default never"},
                  {"remove", "ID", "takes this region away"}},
      .examples = {"onesea region --at 200,0 --cells 128x64 --cell 1", "onesea region --follow 1",
                   "onesea region --remove 2"},
      .run = RunRegion};
}

}  // namespace onesea::app
