#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "common/wire/world_command.h"
#include "server/world/world.h"

namespace onesea::server {

/// What a command did.
struct CommandResult {
  std::uint32_t id = 0;  ///< of the body, obstacle or region that it made or changed
  std::string lease;     ///< of SpawnBody and TakeLease
  Tick tick = 0;         ///< the first that shows it
  std::shared_ptr<const world::PreparedBody> body{};  ///< of SpawnBody
};
using CommandDone = std::function<void(const absl::StatusOr<CommandResult>&)>;

struct CommandRequest {
  wire::CommandHeader header;
  wire::WorldCommand command;
  std::shared_ptr<const world::PreparedBody> body;  ///< of SpawnBody, made ready
};

/// Commands that wait for their tick, and the answers that retries get. Pure bookkeeping, one
/// thread.
///
/// A request id stands for one command: whoever sends it again (the answer was lost, say) gets the
/// same answer, at once or when the first gets it, and nothing happens twice. The last
/// kRequestsRememberedMax answers are kept.
class CommandQueue {
 public:
  struct Due {
    CommandRequest request;
    std::uint64_t ticket = 0;  ///< for Answer()
  };

  /// Takes a command in. Returns it if it is to be done now; if it waits for a tick after `now`, or
  /// its id was seen before, there is nothing to do (`done` may have been called).
  /// FailedPrecondition through `done`: its tick went by or lies more than `ahead_max` ahead;
  /// ResourceExhausted: kCommandsWaitingMax wait.
  std::vector<Due> Submit(CommandRequest request, CommandDone done, Tick now,
                          std::int64_t ahead_max);

  /// Those whose tick is `tick` or earlier, in order of arrival.
  std::vector<Due> TakeDue(Tick tick);

  /// Calls whoever waits for this command, and remembers. Once per Due.
  void Answer(std::uint64_t ticket, absl::StatusOr<CommandResult> result);

  /// Answers everything that waits.
  void FailAll(const absl::Status& status);

 private:
  struct Entry {
    std::uint64_t ticket = 0;
    bool answered = false;
    absl::StatusOr<CommandResult> result{absl::UnknownError("not yet")};
    std::vector<CommandDone> waiting;
  };
  void Remember(const std::string& request_id);

  std::uint64_t tickets_ = 0;
  std::map<std::string, Entry> entries_;            // by request id
  std::map<std::uint64_t, std::string> by_ticket_;  // of those not answered
  std::deque<std::string> answered_;                // oldest first
  std::multimap<Tick, Due> waiting_;                // equal ticks keep their order of arrival
};

}  // namespace onesea::server
