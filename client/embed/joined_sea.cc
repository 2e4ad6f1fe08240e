#include "client/embed/joined_sea.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "client/model/other_sea.h"
#include "common/base/check.h"
#include "common/base/limits.h"

namespace onesea::client {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

bool IsPlace(double x_m, double y_m) {
  return std::abs(x_m) <= kQueryCoordinateMaxM && std::abs(y_m) <= kQueryCoordinateMaxM;
}

bool IsTime(double time_s) { return std::abs(time_s) <= kQueryTimeMaxS; }

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

}  // namespace

JoinedSea::JoinedSea(const std::string& address, const std::string& session,
                     const JoinOptions& options)
    : on_event_(options.on_event) {
  follower_ = std::make_unique<Follower>(
      Follower::Events{.on_new_sea = [this] { OnNewSea(); },
                       .on_compared =
                           [this](const Drift& drift) {
                             if (SessionClient* const sink = drift_sink_)
                               sink->ReportDrift(drift.last_m);
                           },
                       .on_refused = [this](const absl::Status& status) { Fail(status); }});
  terrain_ = std::make_unique<TerrainFetcher>(
      ConnectTo(address), session,
      TerrainFetcher::Events{.on_terrain =
                                 [this](std::shared_ptr<const sea::Terrain> terrain) {
                                   follower_->sea()->SetTerrain(std::move(terrain));
                                   Tell("the terrain has come");
                                 },
                             .on_failed = [this](const absl::Status& status) { Fail(status); }});
  SessionClientOptions link;
  link.session = session;
  if (!options.client_name.empty()) link.client_name = options.client_name;
  client_ = std::make_unique<SessionClient>(ConnectTo(address), link, *this);
  drift_sink_ = client_.get();
}

// First no more frames and no more terrain for the follower, then no more work on them, which may
// still report to the others; then those.
JoinedSea::~JoinedSea() {
  client_->Stop();
  terrain_->Stop();
  follower_.reset();
}

absl::Status JoinedSea::WaitUntilReady(double timeout_s) {
  const absl::Time deadline = absl::Now() + absl::Seconds(timeout_s);
  // Short looks instead of a condition: three parties (link, waves, clock) must be ready, each
  // under its own lock.
  while (absl::Now() < deadline) {
    ONESEA_RETURN_IF_ERROR(status());
    {
      absl::MutexLock lock(&mutex_);
      if (link_.state == LinkState::kWaiting || link_.state == LinkState::kFailed) {
        return link_.status;
      }
    }
    if (UsableSea() != nullptr && client_->Now().valid) return absl::OkStatus();
    absl::SleepFor(absl::Milliseconds(1));
  }
  if (follower_->sea() != nullptr && follower_->sea()->missing_terrain() != 0) {
    return absl::UnavailableError(
        absl::StrFormat("the session's terrain did not come within %g s", timeout_s));
  }
  return absl::UnavailableError(
      absl::StrFormat("the server did not complete joining within %g s", timeout_s));
}

void JoinedSea::OnFrame(const wire::Frame& frame) { follower_->Offer(frame); }

void JoinedSea::OnNewSea() {
  Tell("the sea is followed");
  terrain_->Want(follower_->sea()->missing_terrain());
}

void JoinedSea::OnLink(const LinkEvent& event) {
  {
    absl::MutexLock lock(&mutex_);
    link_ = event;
    if (event.state == LinkState::kFailed && status_.ok()) status_ = event.status;
  }
  switch (event.state) {
    case LinkState::kLive:
      return Tell("connected");
    case LinkState::kWaiting:
      return Tell(absl::StrCat("connection lost, trying again: ", event.status.message()));
    case LinkState::kFailed:
      return Tell(absl::StrCat("can't follow the session: ", event.status.message()));
    default:
      return;
  }
}

void JoinedSea::Tell(const std::string& line) const {
  if (on_event_) on_event_(line);
}

void JoinedSea::Fail(const absl::Status& status) {
  {
    absl::MutexLock lock(&mutex_);
    if (status_.ok()) status_ = status;
  }
  Tell(absl::StrCat("can't follow the session: ", status.message()));
}

absl::Status JoinedSea::status() const {
  absl::MutexLock lock(&mutex_);
  return status_;
}

LocalSea* JoinedSea::UsableSea() const {
  LocalSea* const sea = status().ok() ? follower_->sea() : nullptr;
  return sea == nullptr || sea->missing_terrain() != 0 ? nullptr : sea;
}

absl::Status JoinedSea::UsableStatus() const {
  ONESEA_RETURN_IF_ERROR(status());
  if (UsableSea() != nullptr) return absl::OkStatus();
  return absl::UnavailableError("the session's terrain has not come yet");
}

double JoinedSea::Now() const { return client_->Now().render.Seconds(); }

double JoinedSea::HeightAt(double x_m, double y_m) const {
  const LocalSea* const sea = UsableSea();
  if (sea == nullptr || !IsPlace(x_m, y_m)) return kNan;
  return sea->HeightNear({x_m, y_m}, client_->Now().render);
}

double JoinedSea::HeightAt(double x_m, double y_m, double time_s) const {
  const LocalSea* const sea = UsableSea();
  if (sea == nullptr || !IsPlace(x_m, y_m) || !IsTime(time_s)) return kNan;
  return sea->HeightAt({x_m, y_m}, SimTime::FromSeconds(time_s));
}

absl::Status JoinedSea::Sample(std::span<const Place> places, double time_s, Detail detail,
                               std::span<Water> out) const {
  ONESEA_RETURN_IF_ERROR(UsableStatus());
  ONESEA_RETURN_IF_ERROR(CheckRequest(places, time_s, out.size()));
  if (detail < Detail::kHeight || detail > Detail::kVelocity) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "detail is %d, it must be kHeight (1), kNormal (2) or kVelocity (3)", detail));
  }
  const LocalSea& sea = *follower_->sea();
  const std::vector<Vec2d> points = Points(places);
  const std::shared_ptr<const sea::Terrain> terrain = sea.terrain();
  std::vector<sea::SurfaceSample> samples(places.size());
  sea.Sample(points, SimTime::FromSeconds(time_s), static_cast<sea::QueryDetail>(detail), samples);
  for (std::size_t n = 0; n < samples.size(); ++n) {
    const sea::SurfaceSample& sample = samples[n];
    out[n] = {.height_m = sample.height_m,
              .normal = {sample.normal_x, sample.normal_y, sample.normal_z},
              .velocity_m_per_s = {sample.velocity_x_m_per_s, sample.velocity_y_m_per_s,
                                   sample.velocity_z_m_per_s},
              .folded = sample.folded,
              .dry = terrain != nullptr && terrain->IsDry(points[n], double{sample.height_m})};
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
  const LocalSea& sea = *follower_->sea();
  const SimTime time = SimTime::FromSeconds(time_s);
  const std::vector<Vec2d> points = Points(places);
  std::vector<sea::SurfaceSample> surface(points.size());
  std::vector<sea::DepthSample> samples(points.size());
  sea.Sample(points, time, sea::QueryDetail::kHeight, surface);
  sea.SampleAtDepth(points, depth_m, time, samples);
  const std::shared_ptr<const sea::Terrain> terrain = sea.terrain();
  for (std::size_t n = 0; n < points.size(); ++n) {
    out[n] = {};
    const double height_m = double{surface[n].height_m};
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
  return sea->SnapshotAt(SimTime::FromSeconds(time_s), sea::QueryDetail::kHeight)
      ->HeightErrorBound();
}

DriftReport JoinedSea::drift() const {
  const SeaTime now = client_->Now();
  const Drift drift = follower_->sea()->drift();
  return {.comparisons = drift.comparisons,
          .last_m = drift.last_m,
          .worst_m = drift.worst_m,
          .clock_error_s = now.valid ? now.error_bound_s : -1.0};
}

SessionReport JoinedSea::session() const {
  const LocalSea& sea = *follower_->sea();
  const SessionInfo info = sea.session();
  const LinkStats link = client_->stats();
  const auto components = sea.components();
  SessionReport report;
  report.name = info.name;
  report.sea_name = components->recipe.timeline.back().sea.name;
  report.tick_rate_hz = components->recipe.tick_rate_hz;
  report.hs_m = sea.SignificantWaveHeightAt(client_->Now().render);
  report.component_hash = components->hash;
  report.connected = link.state == LinkState::kLive;
  report.connection_count = link.connections;
  report.bytes_received = link.frame_bytes;
  for (const Vec2d probe : info.probes_m) report.probes.push_back({probe.x, probe.y});
  return report;
}

}  // namespace onesea::client
