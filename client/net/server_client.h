#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "client/net/channel.h"
#include "common/wire/query.h"
#include "common/wire/session_spec.h"

/// Every call of the service but the stream, blocking, in the domain's own words.
namespace onesea::client {

struct WeatherChange {
  Tick start_tick = 0;
  Tick end_tick = 0;
};

struct StepAnswer {
  Tick tick = 0;  ///< reached
  std::uint64_t state_hash = 0;
};

struct StateHash {
  Tick tick = 0;
  std::uint64_t state_hash = 0;
  std::uint64_t component_hash = 0;
};

/// Errors are the server's, or Unavailable with the address, or DeadlineExceeded. Thread-safe.
class ServerClient {
 public:
  static constexpr double kDefaultTimeoutS = 10.0;

  explicit ServerClient(const std::string& address, double timeout_s = kDefaultTimeoutS);
  ServerClient(std::shared_ptr<grpc::Channel> channel, std::string address,
               double timeout_s = kDefaultTimeoutS);
  ~ServerClient();

  const std::string& address() const { return address_; }

  absl::StatusOr<std::vector<SessionInfo>> ListSessions();
  absl::StatusOr<SessionInfo> CreateSession(const SessionSpec& spec);
  absl::Status DeleteSession(const std::string& session);

  absl::StatusOr<wire::QueryAnswer> QueryPoints(const wire::QueryRequest& request);

  absl::StatusOr<WeatherChange> ChangeWeather(const std::string& session, const sea::SeaState& sea,
                                              double over_s);
  /// Answer the tick at which the session stands or goes on.
  absl::StatusOr<Tick> HoldSession(const std::string& session);
  absl::StatusOr<Tick> ResumeSession(const std::string& session);
  absl::StatusOr<double> SetSpeed(const std::string& session, double speed);
  /// Waits for the ticks and for other participants of the barrier: as long as the server does,
  /// an hour at most, whatever the timeout is.
  absl::StatusOr<StepAnswer> StepSession(const std::string& session, std::int64_t ticks,
                                         const std::string& participant);
  absl::StatusOr<StateHash> GetStateHash(const std::string& session);

 private:
  struct Impl;
  std::string address_;
  std::unique_ptr<Impl> impl_;
};

/// Queries without a call set-up each; match answers to requests by id.
class QueryStream {
 public:
  explicit QueryStream(std::shared_ptr<grpc::Channel> channel, std::string address);
  ~QueryStream();

  /// Sends without waiting for the answer. Unavailable when the stream broke.
  absl::Status Send(const wire::QueryRequest& request);
  /// Waits for the next answer; its `status` says if that request was refused. Unavailable when
  /// the stream broke. May run beside Send() in another thread.
  absl::StatusOr<wire::QueryAnswer> Receive();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace onesea::client
