// onesea query: the sea at places and a time, as the server answers and as this process computes
// it.

#include <algorithm>
#include <cmath>
#include <ostream>

#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "client/app/cli_commands.h"
#include "client/app/cli_server.h"
#include "client/app/json_writer.h"
#include "common/base/check.h"
#include "common/base/clock.h"
#include "common/base/limits.h"
#include "common/wire/query.h"
#include "onesea/onesea.h"

namespace onesea::app {
namespace {

absl::StatusOr<sea::QueryDetail> ParseDetail(absl::string_view text) {
  if (text == "height") return sea::QueryDetail::kHeight;
  if (text == "normal") return sea::QueryDetail::kNormal;
  if (text == "velocity") return sea::QueryDetail::kVelocity;
  return UsageError(
      absl::StrFormat("--detail is '%s', it must be height, normal or velocity", text));
}

absl::StatusOr<wire::QueryRequest> ReadRequest(const Arguments& arguments) {
  wire::QueryRequest request;
  for (const std::string& text : arguments.GetAll("at")) {
    ONESEA_ASSIGN_OR_RETURN(request.points_m.emplace_back(), InUsage(ParsePlace("--at", text)));
  }
  if (request.points_m.empty()) return UsageError("query needs --at X,Y, once or several times");
  if (const auto text = arguments.Get("time")) {
    ONESEA_ASSIGN_OR_RETURN(request.time_s,
                            InUsage(ParseNumber("--time", *text, -kQueryTimeMaxS, kQueryTimeMaxS)));
  }
  if (const auto text = arguments.Get("depth")) {
    ONESEA_ASSIGN_OR_RETURN(const double depth_m,
                            InUsage(ParseNumber("--depth", *text, 0.0, kQueryDepthMaxM)));
    request.depth_m.assign(request.points_m.size(), depth_m);
  }
  ONESEA_ASSIGN_OR_RETURN(request.detail, ParseDetail(arguments.Get("detail").value_or("height")));
  return request;
}

// The server's answer may be about a moment that news here have yet to come of. A session that
// streams slowly, or whose time is far away, isn't waited for.
void AwaitNews(const Sea& sea, double time_s) {
  constexpr std::int64_t kPatienceNs = 200'000'000;
  if (time_s > sea.Now() || sea.session().news_time_s == 0.0) return;
  const Clock& clock = SystemClock();
  const std::int64_t end_ns = clock.MonotonicNs() + kPatienceNs;
  while (sea.session().news_time_s < time_s && clock.MonotonicNs() < end_ns) {
    clock.SleepUntil(clock.MonotonicNs() + 2'000'000);
  }
}

// The same question to the sea of this process, as an answer of the same form.
absl::StatusOr<wire::QueryAnswer> AskLocally(const Sea& sea, const wire::QueryRequest& request,
                                             const wire::QueryAnswer& server) {
  const double time_s = server.time_s;
  AwaitNews(sea, time_s);
  std::vector<Place> places;
  for (const Vec2d point : request.points_m) places.push_back({point.x, point.y});
  std::vector<Water> water(places.size());
  ONESEA_RETURN_IF_ERROR(sea.Sample(places, time_s, static_cast<Detail>(request.detail), water));
  wire::QueryAnswer answer;
  answer.time_s = time_s;
  answer.height_error_bound_m = sea.HeightErrorBound(time_s);
  answer.layers = water.front().layers;  // the same for every place
  for (std::size_t n = 0; n < water.size(); ++n) {
    if (water[n].dry) answer.dry_indices.push_back(static_cast<std::int32_t>(n));
    answer.height_m.push_back(static_cast<float>(water[n].height_m));
    if (water[n].folded) answer.folded_indices.push_back(static_cast<std::int32_t>(n));
    for (int axis = 0; axis < 3; ++axis) {
      if (request.detail >= sea::QueryDetail::kNormal)
        answer.normal.push_back(static_cast<float>(water[n].normal[axis]));
      if (request.detail >= sea::QueryDetail::kVelocity)
        answer.velocity_m_per_s.push_back(static_cast<float>(water[n].velocity_m_per_s[axis]));
    }
  }
  if (request.depth_m.empty()) return answer;
  std::vector<Underwater> under(places.size());
  ONESEA_RETURN_IF_ERROR(sea.SampleAtDepth(places, request.depth_m, time_s, under));
  answer.dry_indices.clear();  // land and what lies above the water
  for (std::size_t n = 0; n < under.size(); ++n) {
    if (under[n].dry) answer.dry_indices.push_back(static_cast<std::int32_t>(n));
    for (const double v : under[n].velocity_m_per_s)
      answer.depth_velocity_m_per_s.push_back(static_cast<float>(v));
    answer.dynamic_pressure_pa.push_back(static_cast<float>(under[n].dynamic_pressure_pa));
  }
  return answer;
}

bool Contains(const std::vector<std::int32_t>& indices, std::size_t n) {
  return std::ranges::find(indices, static_cast<std::int32_t>(n)) != indices.end();
}

void WriteTriple(absl::string_view key, const std::vector<float>& values, std::size_t n,
                 JsonWriter& json) {
  if (values.empty()) return;
  json.Key(key).BeginArray();
  for (std::size_t axis = 0; axis < 3; ++axis) json.Value(values[3 * n + axis]);
  json.EndArray();
}

// One question with the answer that is shown and, after --local, the server's to compare it with.
struct Reply {
  std::string session;
  wire::QueryRequest request;
  wire::QueryAnswer shown;
  std::optional<wire::QueryAnswer> server;

  double DifferenceM(std::size_t n) const {
    return double{shown.height_m[n]} - double{server->height_m[n]};
  }
};

// What the heights are made of.
std::vector<const char*> LayerNames(std::uint32_t layers) {
  std::vector<const char*> names = {"spectral"};
  if ((layers & sea::kLayerTerrain) != 0) names.push_back("terrain");
  if ((layers & sea::kLayerWaterLevel) != 0) names.push_back("water_level");
  if ((layers & sea::kLayerInteraction) != 0) names.push_back("interaction");
  return names;
}

void PrintJson(const Reply& reply, std::ostream& out) {
  JsonWriter json;
  json.BeginObject().Key("session").Value(reply.session);
  json.Key("time_s").Value(reply.shown.time_s);
  json.Key("computed").Value(reply.server ? "here" : "by the server");
  json.Key("height_error_bound_m").Value(reply.shown.height_error_bound_m);
  json.Key("layers").BeginArray();
  for (const char* name : LayerNames(reply.shown.layers)) json.Value(name);
  json.EndArray();
  json.Key("points").BeginArray();
  for (std::size_t n = 0; n < reply.request.points_m.size(); ++n) {
    json.BeginObject().Key("x_m").Value(reply.request.points_m[n].x);
    json.Key("y_m").Value(reply.request.points_m[n].y);
    json.Key("height_m").Value(reply.shown.height_m[n]);
    json.Key("folded").Value(Contains(reply.shown.folded_indices, n));
    json.Key("dry").Value(Contains(reply.shown.dry_indices, n));
    WriteTriple("normal", reply.shown.normal, n, json);
    WriteTriple("velocity_m_per_s", reply.shown.velocity_m_per_s, n, json);
    if (!reply.request.depth_m.empty()) {
      json.Key("depth_m").Value(reply.request.depth_m[n]);
      WriteTriple("depth_velocity_m_per_s", reply.shown.depth_velocity_m_per_s, n, json);
      json.Key("dynamic_pressure_pa").Value(reply.shown.dynamic_pressure_pa[n]);
    }
    if (reply.server) {
      json.Key("server_height_m").Value(reply.server->height_m[n]);
      json.Key("difference_m").Value(reply.DifferenceM(n));
    }
    json.EndObject();
  }
  out << json.EndArray().EndObject().text() << '\n';
}

void PrintTriple(absl::string_view name, const std::vector<float>& values, std::size_t n,
                 std::ostream& out) {
  if (values.empty()) return;
  out << absl::StreamFormat(", %s (%+.3f, %+.3f, %+.3f)", name, values[3 * n], values[3 * n + 1],
                            values[3 * n + 2]);
}

void PrintText(const Reply& reply, std::ostream& out) {
  out << absl::StreamFormat(
      "%s at %.3f s, computed %s, error bound %.1f mm, layers: %s\n", reply.session,
      reply.shown.time_s, reply.server ? "here" : "by the server",
      1e3 * reply.shown.height_error_bound_m, absl::StrJoin(LayerNames(reply.shown.layers), ", "));
  for (std::size_t n = 0; n < reply.request.points_m.size(); ++n) {
    const Vec2d point = reply.request.points_m[n];
    out << absl::StreamFormat("(%g, %g): height %+.4f m", point.x, point.y,
                              reply.shown.height_m[n]);
    if (reply.server) {
      out << absl::StreamFormat(", server %+.4f m, difference %.4f mm", reply.server->height_m[n],
                                1e3 * reply.DifferenceM(n));
    }
    PrintTriple("normal", reply.shown.normal, n, out);
    PrintTriple("velocity m/s", reply.shown.velocity_m_per_s, n, out);
    if (Contains(reply.shown.folded_indices, n)) out << ", folded";
    const bool dry = Contains(reply.shown.dry_indices, n);
    if (dry && reply.request.depth_m.empty()) out << ", dry land";
    if (!reply.request.depth_m.empty()) {
      out << absl::StreamFormat("; at %g m depth", reply.request.depth_m[n]);
      if (dry) {
        out << " dry";
      } else {
        out << absl::StreamFormat(" dynamic pressure %.1f Pa", reply.shown.dynamic_pressure_pa[n]);
        PrintTriple("velocity m/s", reply.shown.depth_velocity_m_per_s, n, out);
      }
    }
    out << '\n';
  }
}

absl::Status RunQuery(const CliContext& context, const Arguments& arguments) {
  Reply reply;
  ONESEA_ASSIGN_OR_RETURN(reply.request, ReadRequest(arguments));
  if (arguments.Has("local") && arguments.Has("remote")) {
    return UsageError("--local and --remote exclude each other");
  }
  ONESEA_ASSIGN_OR_RETURN(const ChosenSession chosen, ChooseSession(context));
  reply.session = reply.request.session = chosen.info.name;
  std::unique_ptr<Sea> sea;  // before the question: of wakes it knows no earlier moment
  if (arguments.Has("local")) {
    ONESEA_ASSIGN_OR_RETURN(sea, JoinSession(context, chosen.info.name, true));
  }
  ONESEA_ASSIGN_OR_RETURN(reply.shown, chosen.server->QueryPoints(reply.request));
  if (sea != nullptr) {
    reply.server = std::move(reply.shown);
    ONESEA_ASSIGN_OR_RETURN(reply.shown, AskLocally(*sea, reply.request, *reply.server));
  }
  if (context.json) {
    PrintJson(reply, context.out);
  } else {
    PrintText(reply, context.out);
  }
  return absl::OkStatus();
}

}  // namespace

CliCommand QueryCommand() {
  return {
      .name = "query",
      .operands = "",
      .summary = "heights at places, now or at any time",
      .details =
          "Metres east and north of the origin; sea time in seconds since tick 0. The server\n"
          "answers; with --local this program joins, computes the waves itself, adds the wakes\n"
          "that are streamed to it and shows the difference.",
      .options = {{"at", "X,Y", "a place, metres east and north; may be given many times"},
                  {"time", "T", "sea time in seconds, past or future; default now"},
                  {"depth", "D", "also velocity and pressure D metres below mean water level"},
                  {"detail", "WHAT", "height (default), normal, or velocity (with the normal)"},
                  {"local", "", "compute here and compare with the server"},
                  {"remote", "", "let the server compute; the default"}},
      .examples = {"onesea query --at 0,0", "onesea query --at 0,0 --at -25,100 --time 3600",
                   "onesea query --at 12.5,-7 --depth 5 --detail velocity --local",
                   "onesea query --at 0,0 --json"},
      .run = RunQuery};
}

}  // namespace onesea::app
