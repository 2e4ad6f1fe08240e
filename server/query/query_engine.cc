#include "server/query/query_engine.h"

#include <algorithm>
#include <array>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/sea/attenuation.h"
#include "common/wire/bounds.h"

namespace onesea::server {
namespace {

using wire::CheckReal;
using wire::QueryAnswer;
using wire::QueryRequest;

// Samples of a block stay in the first-level cache between the evaluation and the writing out.
constexpr std::size_t kBlock = 512;

absl::Status CheckPoints(const std::vector<Vec2d>& points_m) {
  constexpr double kMax = kQueryCoordinateMaxM;
  // The fast pass asks all at once; NaN fails every comparison and so counts as bad.
  const bool all_good = std::all_of(points_m.begin(), points_m.end(), [](Vec2d p) {
    return p.x >= -kMax && p.x <= kMax && p.y >= -kMax && p.y <= kMax;
  });
  if (all_good) return absl::OkStatus();
  for (std::size_t n = 0; n < points_m.size(); ++n) {
    ONESEA_RETURN_IF_ERROR(CheckReal("", absl::StrCat("x_m[", n, "]"), points_m[n].x, -kMax, kMax));
    ONESEA_RETURN_IF_ERROR(CheckReal("", absl::StrCat("y_m[", n, "]"), points_m[n].y, -kMax, kMax));
  }
  return absl::OkStatus();
}

absl::Status CheckDepths(const QueryRequest& request, const sea::Recipe& recipe) {
  if (request.depth_m.empty()) return absl::OkStatus();
  ONESEA_RETURN_IF_ERROR(
      wire::CheckSize("", "depth_m", request.depth_m.size(), kQueryDepthPointsMax));
  if (request.depth_m.size() != request.points_m.size()) {
    return absl::InvalidArgumentError(absl::StrCat(
        "depth_m: ", request.depth_m.size(), " elements for ", request.points_m.size(), " points"));
  }
  const double bottom_m = recipe.depth_m > 0.0 ? recipe.depth_m : kQueryDepthMaxM;
  for (std::size_t n = 0; n < request.depth_m.size(); ++n) {
    ONESEA_RETURN_IF_ERROR(
        CheckReal("", absl::StrCat("depth_m[", n, "]"), request.depth_m[n], 0.0, bottom_m));
  }
  return absl::OkStatus();
}

SimTime TimeOf(const QueryRequest& request, Tick now, int tick_rate_hz) {
  if (request.time_s) return SimTime::FromSeconds(*request.time_s);
  return TimeOfTick(request.tick.value_or(now), tick_rate_hz);
}

void Write(const sea::SurfaceSample& sample, std::size_t n, sea::QueryDetail detail,
           QueryAnswer& answer) {
  answer.height_m[n] = sample.height_m;
  if (sample.folded) answer.folded_indices.push_back(static_cast<std::int32_t>(n));
  if (detail >= sea::QueryDetail::kNormal) {
    answer.normal[3 * n] = sample.normal_x;
    answer.normal[3 * n + 1] = sample.normal_y;
    answer.normal[3 * n + 2] = sample.normal_z;
  }
  if (detail >= sea::QueryDetail::kVelocity) {
    answer.velocity_m_per_s[3 * n] = sample.velocity_x_m_per_s;
    answer.velocity_m_per_s[3 * n + 1] = sample.velocity_y_m_per_s;
    answer.velocity_m_per_s[3 * n + 2] = sample.velocity_z_m_per_s;
  }
}

void SampleSurface(const sea::SeaSnapshot& snapshot, const QueryRequest& request,
                   QueryAnswer& answer) {
  const std::size_t count = request.points_m.size();
  answer.height_m.resize(count);
  if (request.detail >= sea::QueryDetail::kNormal) answer.normal.resize(3 * count);
  if (request.detail >= sea::QueryDetail::kVelocity) answer.velocity_m_per_s.resize(3 * count);
  std::array<sea::SurfaceSample, kBlock> samples;
  const std::span<const Vec2d> points(request.points_m);
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    const std::size_t size = std::min(kBlock, count - begin);
    snapshot.Sample(points.subspan(begin, size), std::span(samples).first(size));
    for (std::size_t n = 0; n < size; ++n) Write(samples[n], begin + n, request.detail, answer);
  }
}

// None where nothing is known of the layer, or there is none.
std::optional<sea::InteractionMoment> MomentOf(SimTime time, int tick_rate_hz, Tick now,
                                               const QueryWorld& world) {
  static const auto& kNone = *new sea::InteractionPast();
  const sea::InteractionSnapshot* interaction = world.interaction;
  if (interaction == nullptr) return std::nullopt;
  const sea::InteractionPast& past = world.past != nullptr ? *world.past : kNone;
  const SimTime tick = TimeOfTick(1, tick_rate_hz), present = TimeOfTick(now, tick_rate_hz);
  // From the present back, exactly, since a time may be a century away.
  const double later =
      static_cast<double>(time.flicks - present.flicks) / static_cast<double>(tick.flicks);
  const auto moment = sea::FindMoment(past, *interaction,
                                      static_cast<double>(interaction->tick) + later, tick_rate_hz);
  if (!moment || (moment->before->fields.empty() && moment->after->fields.empty())) {
    return std::nullopt;
  }
  return moment;
}

// The layers' slopes add as their heights do.
void Tilt(Vec2d slope, float* normal) {
  const Vec3d tilted = sea::Tilted({normal[0], normal[1], normal[2]}, slope);
  normal[0] = static_cast<float>(tilted.x);
  normal[1] = static_cast<float>(tilted.y);
  normal[2] = static_cast<float>(tilted.z);
}

void AddInteraction(const sea::InteractionMoment& interaction, const QueryRequest& request,
                    QueryAnswer& answer) {
  answer.layers |= sea::kLayerInteraction;
  for (std::size_t n = 0; n < request.points_m.size(); ++n) {
    const sea::InteractionSample sample = sea::SampleInteraction(interaction, request.points_m[n]);
    answer.height_m[n] += static_cast<float>(sample.height_m);
    if (!answer.normal.empty()) Tilt(sample.slope, &answer.normal[3 * n]);
    if (answer.velocity_m_per_s.empty()) continue;
    answer.velocity_m_per_s[3 * n] += static_cast<float>(sample.velocity.x);
    answer.velocity_m_per_s[3 * n + 1] += static_cast<float>(sample.velocity.y);
    answer.velocity_m_per_s[3 * n + 2] += static_cast<float>(sample.velocity.z);
  }
}

// Points that no water covers, and those that were asked for above it.
void FindDry(const sea::Terrain* terrain, const QueryRequest& request, QueryAnswer& answer) {
  if (terrain == nullptr && request.depth_m.empty()) return;
  for (std::size_t n = 0; n < request.points_m.size(); ++n) {
    const double height_m = double{answer.height_m[n]};
    const bool land = terrain != nullptr && terrain->IsDry(request.points_m[n], height_m);
    const bool above = !request.depth_m.empty() && -request.depth_m[n] > height_m;
    if (land || above) answer.dry_indices.push_back(static_cast<std::int32_t>(n));
  }
}

void SampleDepth(const sea::Components& components, const sea::SeaSnapshot& snapshot,
                 double level_m, const QueryRequest& request, QueryAnswer& answer) {
  const std::size_t count = request.depth_m.size();
  answer.depth_velocity_m_per_s.resize(3 * count);
  answer.dynamic_pressure_pa.resize(count);
  std::vector<std::size_t> wet;
  std::vector<Vec2d> points;
  std::vector<double> depths;
  auto dry = answer.dry_indices.begin();
  for (std::size_t n = 0; n < count; ++n) {
    if (dry != answer.dry_indices.end() && *dry == static_cast<std::int32_t>(n)) {
      ++dry;
      continue;
    }
    wet.push_back(n);
    points.push_back(request.points_m[n]);
    // Waves fade from the level on.
    depths.push_back(std::max(0.0, request.depth_m[n] + level_m));
  }
  std::vector<sea::DepthSample> samples(wet.size());
  sea::SampleAtDepth(components, snapshot.time(), points, depths, samples,
                     snapshot.attenuation().get());
  for (std::size_t m = 0; m < wet.size(); ++m) {
    const std::size_t n = wet[m];
    answer.depth_velocity_m_per_s[3 * n] = static_cast<float>(samples[m].velocity_m_per_s.x);
    answer.depth_velocity_m_per_s[3 * n + 1] = static_cast<float>(samples[m].velocity_m_per_s.y);
    answer.depth_velocity_m_per_s[3 * n + 2] = static_cast<float>(samples[m].velocity_m_per_s.z);
    answer.dynamic_pressure_pa[n] = static_cast<float>(samples[m].dynamic_pressure_pa);
  }
}

}  // namespace

absl::Status ValidateQuery(const QueryRequest& request, const sea::Recipe& recipe) {
  ONESEA_RETURN_IF_ERROR(wire::CheckSize("", "x_m", request.points_m.size(), kQueryPointsMax));
  if (request.points_m.empty()) {
    return absl::InvalidArgumentError("x_m: 0 elements, at least 1 is needed");
  }
  if (request.time_s) {
    ONESEA_RETURN_IF_ERROR(
        CheckReal("", "time_s", *request.time_s, -kQueryTimeMaxS, kQueryTimeMaxS));
  }
  if (request.tick && !IsTickInRange(*request.tick, recipe.tick_rate_hz)) {
    return absl::InvalidArgumentError(
        absl::StrCat("tick: ", *request.tick, " is more than a century from tick 0"));
  }
  ONESEA_RETURN_IF_ERROR(CheckPoints(request.points_m));
  return CheckDepths(request, recipe);
}

absl::StatusOr<QueryAnswer> QueryEngine::Answer(
    const std::shared_ptr<const sea::Components>& components, Tick now, const QueryRequest& request,
    const QueryWorld& world) {
  ONESEA_RETURN_IF_ERROR(ValidateQuery(request, components->recipe));
  const SimTime time = TimeOf(request, now, components->recipe.tick_rate_hz);
  const std::shared_ptr<const sea::SeaSnapshot> snapshot =
      snapshots_.Get(components, time, request.detail);
  QueryAnswer answer;
  answer.id = request.id;
  answer.time_s = time.Seconds();
  answer.layers = sea::kLayerSpectral;
  answer.height_error_bound_m = snapshot->HeightErrorBound();
  SampleSurface(*snapshot, request, answer);
  const double level_m = wire::WaterLevelAt(world.water_level, time);
  if (level_m != 0.0) {
    answer.layers |= sea::kLayerWaterLevel;
    for (float& height_m : answer.height_m) height_m += static_cast<float>(level_m);
  }
  if (const auto moment = MomentOf(time, components->recipe.tick_rate_hz, now, world)) {
    AddInteraction(*moment, request, answer);
  }
  const sea::Terrain* terrain = nullptr;
  if (components->attenuation != nullptr) {
    answer.layers |= sea::kLayerTerrain;
    terrain = &components->attenuation->terrain();
  }
  FindDry(terrain, request, answer);
  if (!request.depth_m.empty()) SampleDepth(*components, *snapshot, level_m, request, answer);
  return answer;
}

std::optional<Tick> QueryEngine::NoteAsked(Tick now) {
  Tick last = last_asked_.load(std::memory_order_relaxed);
  const Tick stride = now - last;
  if (stride <= 0 || !last_asked_.compare_exchange_strong(last, now)) return std::nullopt;
  if (stride > kStrideMax) return std::nullopt;
  return now + stride;
}

std::shared_ptr<const sea::SeaSnapshot> QueryEngine::SnapshotOf(
    const std::shared_ptr<const sea::Components>& components, Tick tick, sea::QueryDetail detail) {
  return snapshots_.Get(components, TimeOfTick(tick, components->recipe.tick_rate_hz), detail);
}

}  // namespace onesea::server
