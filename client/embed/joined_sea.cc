#include "client/embed/joined_sea.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "common/base/check.h"
#include "common/base/limits.h"

namespace onesea::client {
namespace {

static_assert(kLayerWaves == sea::kLayerSpectral && kLayerWakes == sea::kLayerInteraction &&
              kLayerTerrain == sea::kLayerTerrain && kLayerWaterLevel == sea::kLayerWaterLevel);

// Of wakes, as onesea.h promises: a game's frame or two, and those who are late.
constexpr SimTime kPast{kFlicksPerSecond};
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

absl::Status CheckRequest(std::span<const Place> places, double time_s, std::size_t out_size) {
  if (out_size != places.size()) {
    return absl::InvalidArgumentError(
        absl::StrFormat("out has size %d, places has %d", out_size, places.size()));
  }
  if (!IsTime(time_s)) {
    return absl::InvalidArgumentError(absl::StrFormat("time_s is %g, it must be in [-%g, %g]",
                                                      time_s, kQueryTimeMaxS, kQueryTimeMaxS));
  }
  for (std::size_t n = 0; n < places.size(); ++n) {
    if (IsPlace(places[n].x_m, places[n].y_m)) continue;
    return absl::InvalidArgumentError(
        absl::StrFormat("places[%d] is (%g, %g), both must be in [-%g, %g]", n, places[n].x_m,
                        places[n].y_m, kQueryCoordinateMaxM, kQueryCoordinateMaxM));
  }
  return absl::OkStatus();
}

std::vector<Vec2d> Points(std::span<const Place> places) {
  std::vector<Vec2d> points;
  points.reserve(places.size());
  for (const Place& place : places) points.push_back({place.x_m, place.y_m});
  return points;
}

// Waves and wakes together; heights are added in single precision, as the server does.
Water WaterOf(const sea::SurfaceSample& waves, const sea::InteractionSample& wakes, Detail detail) {
  Water water{.height_m = waves.height_m + static_cast<float>(wakes.height_m),
              .normal = {waves.normal_x, waves.normal_y, waves.normal_z},
              .velocity_m_per_s = {waves.velocity_x_m_per_s, waves.velocity_y_m_per_s,
                                   waves.velocity_z_m_per_s},
              .wakes_m = wakes.height_m,
              .folded = waves.folded};
  if (detail == Detail::kHeight || wakes.slope == Vec2d{}) return water;
  const Vec3d tilted = sea::Tilted({waves.normal_x, waves.normal_y, waves.normal_z}, wakes.slope);
  water.normal[0] = tilted.x;
  water.normal[1] = tilted.y;
  water.normal[2] = tilted.z;
  return water;
}

}  // namespace

JoinedSea::JoinedSea(const std::string& address, const std::string& session,
                     const JoinOptions& options)
    : session_name_(session),
      owner_(options.client_name.empty() ? "a game" : options.client_name),
      session_({.address = address,
                .session = session,
                .client_name = options.client_name.empty() ? "onesea" : options.client_name,
                .world = options.world,
                .past = kPast,
                .on_event = options.on_event}),
      fleet_(session, CommandsTo(ConnectTo(address)), [this] { return session_.world().view(); }) {}

absl::Status JoinedSea::WaitUntilReady(double timeout_s) {
  const absl::Time deadline = absl::Now() + absl::Seconds(timeout_s);
  // Short looks instead of a condition: three parties (link, waves, clock) must be ready, each
  // under its own lock.
  while (absl::Now() < deadline) {
    ONESEA_RETURN_IF_ERROR(status());
    const LinkEvent link = session_.link();
    if (link.state == LinkState::kWaiting || link.state == LinkState::kFailed) return link.status;
    if (UsableSea() != nullptr && session_.Now().valid) return absl::OkStatus();
    absl::SleepFor(absl::Milliseconds(1));
  }
  if (session_.sea() != nullptr && session_.sea()->missing_terrain() != 0) {
    return absl::UnavailableError(
        absl::StrFormat("the session's terrain did not come within %g s", timeout_s));
  }
  return absl::UnavailableError(
      absl::StrFormat("the server did not complete joining within %g s", timeout_s));
}

absl::Status JoinedSea::status() const { return session_.status(); }

LocalSea* JoinedSea::UsableSea() const {
  LocalSea* const sea = status().ok() ? session_.sea() : nullptr;
  return sea == nullptr || sea->missing_terrain() != 0 ? nullptr : sea;
}

absl::Status JoinedSea::UsableStatus() const {
  ONESEA_RETURN_IF_ERROR(status());
  if (UsableSea() != nullptr) return absl::OkStatus();
  return absl::UnavailableError("the session's terrain has not come yet");
}

double JoinedSea::Now() const { return session_.Now().render.Seconds(); }

double JoinedSea::HeightAt(double x_m, double y_m) const {
  const LocalSea* const sea = UsableSea();
  if (sea == nullptr || !IsPlace(x_m, y_m)) return kNan;
  const SimTime now = session_.Now().render;
  return sea->HeightNear({x_m, y_m}, now) + WakesAt({x_m, y_m}, now);
}

double JoinedSea::HeightAt(double x_m, double y_m, double time_s) const {
  const LocalSea* const sea = UsableSea();
  if (sea == nullptr || !IsPlace(x_m, y_m) || !IsTime(time_s)) return kNan;
  const SimTime time = SimTime::FromSeconds(time_s);
  // In single precision, as the server adds them.
  return static_cast<float>(sea->HeightAt({x_m, y_m}, time)) +
         static_cast<float>(WakesAt({x_m, y_m}, time));
}

double JoinedSea::WakesAt(Vec2d place, SimTime time) const {
  const std::shared_ptr<const WorldView> world = session_.world().view();
  return WakeHistory::SampleAt(world->wakes().MomentAt(time), place).height_m;
}

absl::Status JoinedSea::Sample(std::span<const Place> places, double time_s, Detail detail,
                               std::span<Water> out) const {
  ONESEA_RETURN_IF_ERROR(UsableStatus());
  ONESEA_RETURN_IF_ERROR(CheckRequest(places, time_s, out.size()));
  if (detail < Detail::kHeight || detail > Detail::kVelocity) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "detail is %d, it must be kHeight (1), kNormal (2) or kVelocity (3)", detail));
  }
  const LocalSea& sea = *session_.sea();
  const SimTime time = SimTime::FromSeconds(time_s);
  const std::vector<Vec2d> points = Points(places);
  const std::shared_ptr<const sea::Terrain> terrain = sea.terrain();
  const std::shared_ptr<const WorldView> world = session_.world().view();
  const WakeHistory::Moment wakes = world->wakes().MomentAt(time);
  std::vector<sea::SurfaceSample> samples(places.size());
  std::uint32_t layers = sea.Sample(points, time, static_cast<sea::QueryDetail>(detail), samples);
  if (wakes) layers |= kLayerWakes;
  for (std::size_t n = 0; n < samples.size(); ++n) {
    out[n] = WaterOf(samples[n], WakeHistory::SampleAt(wakes, points[n]), detail);
    out[n].layers = layers;
    out[n].dry = terrain != nullptr && terrain->IsDry(points[n], out[n].height_m);
  }
  return absl::OkStatus();
}

absl::Status JoinedSea::SampleAtDepth(std::span<const Place> places,
                                      std::span<const double> depth_m, double time_s,
                                      std::span<Underwater> out) const {
  ONESEA_RETURN_IF_ERROR(UsableStatus());
  ONESEA_RETURN_IF_ERROR(CheckRequest(places, time_s, out.size()));
  if (depth_m.size() != places.size()) {
    return absl::InvalidArgumentError(
        absl::StrFormat("depth_m has size %d, places has %d", depth_m.size(), places.size()));
  }
  for (std::size_t n = 0; n < depth_m.size(); ++n) {
    if (depth_m[n] >= 0.0 && depth_m[n] <= kQueryDepthMaxM) continue;
    return absl::InvalidArgumentError(absl::StrFormat("depth_m[%d] is %g, it must be in [0, %g]", n,
                                                      depth_m[n], kQueryDepthMaxM));
  }
  const LocalSea& sea = *session_.sea();
  const SimTime time = SimTime::FromSeconds(time_s);
  const std::vector<Vec2d> points = Points(places);
  std::vector<sea::SurfaceSample> surface(points.size());
  std::vector<sea::DepthSample> samples(points.size());
  sea.Sample(points, time, sea::QueryDetail::kHeight, surface);
  sea.SampleAtDepth(points, depth_m, time, samples);
  const std::shared_ptr<const sea::Terrain> terrain = sea.terrain();
  const std::shared_ptr<const WorldView> world = session_.world().view();
  const WakeHistory::Moment wakes = world->wakes().MomentAt(time);
  for (std::size_t n = 0; n < points.size(); ++n) {
    out[n] = {};
    const double height_m =
        surface[n].height_m + static_cast<float>(WakeHistory::SampleAt(wakes, points[n]).height_m);
    out[n].dry =
        -depth_m[n] > height_m || (terrain != nullptr && terrain->IsDry(points[n], height_m));
    if (out[n].dry) continue;
    const Vec3d velocity = samples[n].velocity_m_per_s;
    out[n] = {.velocity_m_per_s = {velocity.x, velocity.y, velocity.z},
              .dynamic_pressure_pa = samples[n].dynamic_pressure_pa};
  }
  return absl::OkStatus();
}

double JoinedSea::HeightErrorBound(double time_s) const {
  const LocalSea* const sea = UsableSea();
  if (sea == nullptr || !IsTime(time_s)) return kNan;
  const SimTime time = SimTime::FromSeconds(time_s);
  return sea->SnapshotAt(time, sea::QueryDetail::kHeight)->HeightErrorBound() +
         session_.world().view()->wakes().MomentAt(time).height_error_m;
}

DriftReport JoinedSea::drift() const {
  const SeaTime now = session_.Now();
  const Drift drift = session_.sea()->drift();
  return {.comparisons = drift.comparisons,
          .last_m = drift.last_m,
          .worst_m = drift.worst_m,
          .clock_error_s = now.valid ? now.error_bound_s : -1.0};
}

SessionReport JoinedSea::session() const {
  const LocalSea& sea = *session_.sea();
  const SessionInfo info = sea.session();
  const LinkStats link = session_.stats();
  const auto components = sea.components();
  SessionReport report;
  report.name = info.name;
  report.sea_name = components->recipe.timeline.back().sea.name;
  report.tick_rate_hz = components->recipe.tick_rate_hz;
  report.hs_m = sea.SignificantWaveHeightAt(session_.Now().render);
  report.component_hash = components->hash;
  report.connected = link.state == LinkState::kLive;
  report.connection_count = link.connections;
  report.bytes_received = link.frame_bytes;
  report.news_time_s = session_.world().view()->time().Seconds();
  for (const Vec2d probe : info.probes_m) report.probes.push_back({probe.x, probe.y});
  return report;
}

}  // namespace onesea::client
