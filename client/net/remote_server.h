#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "client/net/channel.h"
#include "common/wire/query.h"
#include "common/wire/session_spec.h"
#include "common/wire/world_command.h"

/// The server's methods as plain blocking calls with the domain's types. Errors are those of the
/// server; Unavailable when it can't be reached, DeadlineExceeded when it does not answer in time.
namespace onesea::client {

struct WeatherChange {
  sea::SeaState sea;
  double over_s = 0.0;             ///< length of the change in sea seconds, [0, 86400]
  std::optional<Tick> start_tick;  ///< default: soon
};

struct WeatherSpan {
  Tick start_tick = 0;
  Tick end_tick = 0;
};

struct StepOptions {
  std::int64_t ticks = 1;
  std::string participant;
  std::optional<wire::QueryRequest> query;  ///< answered for the tick reached
  /// How long to wait: the work of the ticks, and in a barrier the other participants.
  std::int64_t timeout_ns = 60'000'000'000;
};

struct StepAnswer {
  Tick tick = 0;  ///< reached
  std::uint64_t state_hash = 0;
  std::optional<wire::QueryAnswer> query;  ///< with a `status` where only the query failed
};

struct CommandAnswer {
  Tick tick = 0;         ///< the first that shows what it did
  std::uint32_t id = 0;  ///< of the body, obstacle or region made or changed, else 0
  std::string lease;     ///< of SpawnBody and TakeLease
  std::optional<wire::BodyDescription>
      body;  ///< of SpawnBody: its preset filled in, no mesh's bytes
};

struct ListedBody {
  wire::BodyInfo info;
  wire::Kinematics state;
  std::string driver;  ///< who holds its lease; empty: nobody
};
struct BodyList {
  Tick tick = 0;
  std::vector<ListedBody> bodies;
  std::vector<wire::TiedRope> ropes;
};

struct ListedPreset {
  std::string name;     ///< for BodyDescription::preset
  std::string summary;  ///< one line for people
};

struct StateHashes {
  Tick tick = 0;
  std::uint64_t state_hash = 0;
  std::uint64_t component_hash = 0;
};

/// Many queries in flight on one stream: lower latency and several times the rate of single calls.
/// One thread may send while another receives.
class QueryStream {
 public:
  struct Impl;
  explicit QueryStream(std::unique_ptr<Impl> impl);
  ~QueryStream();  ///< ends the stream

  /// Blocks while the connection takes no more. Unavailable when the stream is over.
  absl::Status Send(const wire::QueryRequest& request);
  /// The next answer, of whichever request; `QueryAnswer::status` is that request's, and its sizes
  /// are for wire::CheckAnswers() with it. The stream's own end is an error.
  absl::StatusOr<wire::QueryAnswer> Receive();

 private:
  std::unique_ptr<Impl> impl_;
};

struct InstrumentReading {
  Tick tick = 0;
  std::vector<double> values;      ///< of all instruments, in their order
  std::int64_t skipped_count = 0;  ///< readings that were left out just before, for slowness
};

/// Readings of virtual instruments, as the session's ticks go by.
class InstrumentStream {
 public:
  struct Impl;
  explicit InstrumentStream(std::unique_ptr<Impl> impl);
  ~InstrumentStream();  ///< ends the stream

  /// Blocks for the next one, for ever where the session stands still. An error is the stream's
  /// end: what was wrong with the request, or the session's end.
  absl::StatusOr<InstrumentReading> Receive();

 private:
  std::unique_ptr<Impl> impl_;
};

/// Thread-safe.
class RemoteServer {
 public:
  /// Connects at the first call. `timeout_ns` is per call.
  explicit RemoteServer(const ChannelFactory& connect, std::int64_t timeout_ns = 10'000'000'000);
  ~RemoteServer();

  absl::StatusOr<std::vector<SessionInfo>> ListSessions();
  absl::StatusOr<SessionInfo> CreateSession(const SessionSpec& spec);
  absl::Status DeleteSession(const std::string& session);

  absl::StatusOr<wire::QueryAnswer> QueryPoints(const wire::QueryRequest& request);
  std::unique_ptr<QueryStream> StreamQueries();

  absl::StatusOr<WeatherSpan> ChangeWeather(const std::string& session,
                                            const WeatherChange& change);
  /// The tick at which it stands, or goes on.
  absl::StatusOr<Tick> Hold(const std::string& session);
  absl::StatusOr<Tick> Resume(const std::string& session);
  absl::StatusOr<double> SetSpeed(const std::string& session, double speed);
  absl::StatusOr<StepAnswer> Step(const std::string& session, const StepOptions& options);

  /// A command on the world; answered when it has acted. Send it again with the same request id if
  /// the answer was lost.
  absl::StatusOr<CommandAnswer> Command(const wire::CommandHeader& header,
                                        const wire::WorldCommand& command);
  absl::StatusOr<BodyList> ListBodies(const std::string& session);
  /// The file of a hull, by BodyShape::mesh_hash; at most kHullFileBytesMax. NotFound.
  absl::StatusOr<std::string> GetMesh(const std::string& session, std::uint64_t hash);
  std::unique_ptr<InstrumentStream> StreamInstruments(const wire::InstrumentRequest& request);
  /// The bodies that the server knows by name.
  absl::StatusOr<std::vector<ListedPreset>> ListPresets();

  absl::StatusOr<StateHashes> GetStateHash(const std::string& session);
  /// The server's monotonic clock [ns].
  absl::StatusOr<std::int64_t> ServerMonotonicNs();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace onesea::client
