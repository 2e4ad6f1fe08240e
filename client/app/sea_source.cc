#include "client/app/sea_source.h"

#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "client/embed/joined_session.h"
#include "client/net/remote_server.h"
#include "common/base/check.h"
#include "common/base/clock.h"
#include "common/ingest/terrain_file.h"
#include "common/sea/attenuation.h"
#include "common/wire/session_file.h"

namespace onesea::client {
namespace {

class FileSource : public SeaSource {
 public:
  FileSource(std::string path, const SessionSpec& spec,
             std::shared_ptr<const sea::Components> components)
      : path_(std::move(path)),
        speed_(spec.speed),
        water_level_(spec.world.water_level),
        components_(std::move(components)),
        start_ns_(SystemClock().MonotonicNs()) {}

  std::shared_ptr<const sea::Components> components() const override { return components_; }
  double WaterLevelAt(SimTime time) const override {
    return wire::WaterLevelAt(water_level_, time);
  }
  SimTime Now() override {
    return SimTime::FromSeconds(speed_ * 1e-9 *
                                static_cast<double>(SystemClock().MonotonicNs() - start_ns_));
  }
  SourceReport Report() override {
    SourceReport report;
    report.where = path_;
    report.link = "offline";
    report.tick = TickAtOrBefore(Now(), components_->recipe.tick_rate_hz);
    report.speed = speed_;
    return report;
  }
  absl::Status status() const override { return absl::OkStatus(); }

 private:
  std::string path_;
  double speed_;
  std::vector<wire::WaterLevel> water_level_;
  std::shared_ptr<const sea::Components> components_;
  std::int64_t start_ns_;
};

class ServerSource : public SeaSource {
 public:
  ServerSource(std::string address, const std::string& session)
      : address_(std::move(address)),
        session_(session),
        sender_(session, CommandsTo(ConnectTo(address_))),
        meshes_([server = std::make_shared<RemoteServer>(ConnectTo(address_)),
                 session](std::uint64_t hash) { return server->GetMesh(session, hash); }),
        joined_({.address = address_, .session = session, .client_name = "onesea-view"}) {}

  // OK once a sea is there and its time is known.
  absl::Status WaitForSea(std::int64_t timeout_ns) {
    const std::int64_t end_ns = SystemClock().MonotonicNs() + timeout_ns;
    while (SystemClock().MonotonicNs() < end_ns) {
      ONESEA_RETURN_IF_ERROR(status());
      if (components() != nullptr && joined_.Now().valid) return absl::OkStatus();
      SystemClock().SleepUntil(SystemClock().MonotonicNs() + 2'000'000);
    }
    return absl::DeadlineExceededError(
        absl::StrCat("no sea from ", address_, " within ", timeout_ns / 1'000'000'000, " s"));
  }

  std::shared_ptr<const sea::Components> components() const override {
    const LocalSea* const sea = joined_.sea();
    return sea == nullptr ? nullptr : sea->components();
  }
  double WaterLevelAt(SimTime time) const override { return joined_.sea()->WaterLevelAt(time); }
  std::shared_ptr<const WorldView> world() const override { return joined_.world().view(); }
  CommandSender* commands() override { return &sender_; }
  MeshFetcher* meshes() override { return &meshes_; }
  std::vector<wire::Spray> TakeSpray() override { return joined_.world().TakeSpray(); }
  SimTime Now() override { return joined_.Now().render; }
  SourceReport Report() override {
    const SeaTime now = joined_.Now();
    SourceReport report;
    report.where = absl::StrCat(address_, ", session ", session_);
    report.speed = now.speed;
    report.clock_error_s = now.error_bound_s;
    report.link = LinkText(joined_.link());
    report.trouble = meshes_.trouble();
    const LocalSea* const sea = joined_.sea();
    if (sea == nullptr) return report;
    // Until then the open sea is drawn.
    if (sea->missing_terrain() != 0) absl::StrAppend(&report.link, ", terrain is coming");
    report.tick = TickAtOrBefore(now.render, sea->components()->recipe.tick_rate_hz);
    const Drift drift = sea->drift();
    if (drift.comparisons > 0) report.drift_m = drift.last_m;
    return report;
  }
  absl::Status status() const override { return joined_.status(); }

 private:
  static std::string LinkText(const LinkEvent& link) {
    switch (link.state) {
      case LinkState::kConnecting:
        return "connecting";
      case LinkState::kLive:
        return "live";
      case LinkState::kWaiting:
        return absl::StrCat("waiting: ", link.status.message());
      case LinkState::kStopped:
        return "stopped";
      case LinkState::kFailed:
        return "failed";
    }
    return "";
  }

  const std::string address_, session_;
  CommandSender sender_;
  MeshFetcher meshes_;
  JoinedSession joined_;
};

absl::StatusOr<std::string> OnlySession(const std::string& address) {
  RemoteServer server(ConnectTo(address));
  const absl::StatusOr<std::vector<SessionInfo>> listed = server.ListSessions();
  if (absl::IsUnavailable(listed.status())) {
    return absl::UnavailableError(absl::StrCat(
        "no server at ", address, ": start onesea-server, or draw a session file with ",
        "--offline=FILE (", listed.status().message(), ")"));
  }
  ONESEA_RETURN_IF_ERROR(listed.status());
  const std::vector<SessionInfo>& sessions = *listed;
  if (sessions.empty()) {
    return absl::NotFoundError(
        absl::StrCat(address, " has no session: make one with `onesea create FILE`"));
  }
  if (sessions.size() == 1) return sessions[0].name;
  std::vector<std::string> names;
  names.reserve(sessions.size());
  for (const SessionInfo& session : sessions) names.push_back(session.name);
  return absl::InvalidArgumentError(absl::StrCat(
      address, " has several sessions, choose one with --session: ", absl::StrJoin(names, ", ")));
}

}  // namespace

absl::StatusOr<std::unique_ptr<SeaSource>> OpenSessionFile(const std::string& path) {
  ONESEA_ASSIGN_OR_RETURN(SessionSpec spec, wire::ReadSessionFile(path));
  ONESEA_ASSIGN_OR_RETURN(std::shared_ptr<const sea::Components> components,
                          sea::BuildComponents(spec.recipe));
  if (!spec.world.terrain_path.empty()) {
    ONESEA_ASSIGN_OR_RETURN(sea::Terrain terrain,
                            ingest::ReadTerrainFile(spec.world.terrain_path, {}));
    components = sea::OverTerrain(std::move(components),
                                  std::make_shared<const sea::Terrain>(std::move(terrain)));
  }
  return std::make_unique<FileSource>(path, std::move(spec), std::move(components));
}

absl::StatusOr<std::unique_ptr<SeaSource>> JoinServer(const std::string& address,
                                                      const std::string& session) {
  std::string name = session;
  if (name.empty()) {
    ONESEA_ASSIGN_OR_RETURN(name, OnlySession(address));
  }
  auto source = std::make_unique<ServerSource>(address, name);
  ONESEA_RETURN_IF_ERROR(source->WaitForSea(10'000'000'000));
  return source;
}

}  // namespace onesea::client
