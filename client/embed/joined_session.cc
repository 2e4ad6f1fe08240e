#include "client/embed/joined_session.h"

#include <utility>

#include "absl/strings/str_cat.h"

namespace onesea::client {

JoinedSession::JoinedSession(JoinedSessionOptions options)
    : options_(std::move(options)), world_(options_.past) {
  follower_ = std::make_unique<Follower>(
      Follower::Events{.on_new_sea = [this] { OnNewSea(); },
                       .on_compared =
                           [this](const Drift& drift) {
                             if (SessionClient* const sink = drift_sink_)
                               sink->ReportDrift(drift.last_m);
                           },
                       .on_refused = [this](const absl::Status& status) { Fail(status); }});
  terrain_ = std::make_unique<TerrainFetcher>(
      ConnectTo(options_.address), options_.session,
      TerrainFetcher::Events{.on_terrain =
                                 [this](std::shared_ptr<const sea::Terrain> terrain) {
                                   sea()->SetTerrain(std::move(terrain));
                                   Tell("the terrain has come");
                                 },
                             .on_failed = [this](const absl::Status& status) { Fail(status); }});
  SessionClientOptions link;
  link.session = options_.session;
  link.client_name = options_.client_name;
  link.every_frame = options_.world;
  client_ = std::make_unique<SessionClient>(ConnectTo(options_.address), link,
                                            static_cast<SessionListener&>(*this));
  drift_sink_ = client_.get();
}

// First no more frames and no more terrain for the follower, then no more work on them, which may
// still report to the others; then those.
JoinedSession::~JoinedSession() {
  client_->Stop();
  terrain_->Stop();
  follower_.reset();
}

void JoinedSession::OnFrame(const wire::Frame& frame) {
  follower_->Offer(frame);
  if (!options_.world) return;
  if (frame.welcome.has_value()) tick_rate_hz_ = frame.welcome->recipe.tick_rate_hz;
  // A frame that doesn't fit is made good by the next keyframe.
  if (tick_rate_hz_ > 0) world_.Apply(frame, tick_rate_hz_).IgnoreError();
}

void JoinedSession::OnNewSea() {
  Tell("the sea is followed");
  terrain_->Want(sea()->missing_terrain());
}

void JoinedSession::OnLink(const LinkEvent& event) {
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

void JoinedSession::Tell(const std::string& line) const {
  if (options_.on_event) options_.on_event(line);
}

void JoinedSession::Fail(const absl::Status& status) {
  {
    absl::MutexLock lock(&mutex_);
    if (status_.ok()) status_ = status;
  }
  Tell(absl::StrCat("can't follow the session: ", status.message()));
}

LinkEvent JoinedSession::link() const {
  absl::MutexLock lock(&mutex_);
  return link_;
}

absl::Status JoinedSession::status() const {
  absl::MutexLock lock(&mutex_);
  return status_;
}

}  // namespace onesea::client
