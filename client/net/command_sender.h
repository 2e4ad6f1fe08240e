#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "client/net/channel.h"
#include "client/net/remote_server.h"
#include "common/wire/world_command.h"

/// Commands for whoever draws pictures and must not wait.
namespace onesea::client {

/// Sends commands from threads of its own, so that no frame waits for the network.
///
/// Several are under way at once: orders come every 50 ms and a round trip may take 200. An order
/// (DriveBody) that has not left yet gives way to a newer one of the same body. Orders may overtake
/// each other on the way; `CommandAnswer::tick` tells. A command that got lost with the connection
/// is sent again, with the same request id and thus harmlessly, for kPatienceNs; then its outcome
/// says so. Every command has exactly one outcome. Thread-safe.
class CommandSender {
 public:
  static constexpr int kUnderWayMax = 6;
  static constexpr std::size_t kWaitingMax = 64;
  static constexpr std::int64_t kPatienceNs = 8'000'000'000;
  static constexpr std::int64_t kPauseNs = 300'000'000;  ///< before sending again

  using Call = std::function<absl::StatusOr<CommandAnswer>(const wire::CommandHeader&,
                                                           const wire::WorldCommand&)>;
  struct Outcome {
    std::int64_t number = 0;
    absl::StatusOr<CommandAnswer> answer;  ///< Cancelled: a newer order took its place
  };

  /// `call` blocks until the answer is there, is called from several threads, and is as
  /// RemoteServer::Command.
  CommandSender(std::string session, Call call);
  /// Waits for what is under way, leaves what isn't.
  ~CommandSender();

  /// Returns its number; they ascend from 1. `lease` of the body that it acts on.
  std::int64_t Send(wire::WorldCommand command, std::string lease = "");
  /// Outcomes since the last call, in order of arrival.
  std::vector<Outcome> Take();
  /// What keeps commands from getting through; empty: nothing.
  std::string trouble() const;
  /// Waits until every command has its outcome. False: not in time.
  bool AwaitAll(std::int64_t timeout_ns);

 private:
  struct Waiting {
    std::int64_t number = 0;
    wire::CommandHeader header;
    wire::WorldCommand command;
    std::int64_t since_ns = 0, not_before_ns = 0;
  };
  void Run();
  bool HasWork() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  bool IsIdle() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return waiting_.empty() && under_way_ == 0;
  }
  void Finish(Waiting command, absl::StatusOr<CommandAnswer> answer)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const std::string session_;
  const Call call_;
  const std::string id_;  // of this sender, in front of every request id
  mutable absl::Mutex mutex_;
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;
  int under_way_ ABSL_GUARDED_BY(mutex_) = 0;
  std::int64_t last_number_ ABSL_GUARDED_BY(mutex_) = 0;
  std::deque<Waiting> waiting_ ABSL_GUARDED_BY(mutex_);
  std::map<std::uint32_t, std::int64_t> newest_order_ ABSL_GUARDED_BY(mutex_);  // by body
  std::vector<Outcome> outcomes_ ABSL_GUARDED_BY(mutex_);
  std::string trouble_ ABSL_GUARDED_BY(mutex_);
  std::vector<std::thread> threads_;
};

/// RemoteServer::Command on a connection that is made anew when it is lost.
CommandSender::Call CommandsTo(ChannelFactory connect);

}  // namespace onesea::client
