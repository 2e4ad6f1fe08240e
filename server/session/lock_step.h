#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "common/base/sim_time.h"

/// The barrier of lock-step: ticks are made when every participant has asked for them.
namespace onesea::server {

struct StepRequest {
  std::int64_t ticks = 1;   ///< [1, kStepTicksMax]; the same from every participant of a barrier
  std::string participant;  ///< told apart by name; may be empty when there is only one
};

struct StepResult {
  Tick tick = 0;  ///< reached
  std::uint64_t state_hash = 0;
};
using StepDone = std::function<void(absl::StatusOr<StepResult>)>;

/// Pure bookkeeping: no thread, no clock; the time is an argument. Empty → filling (the first came;
/// the deadline runs) → full, which TakeIfFull() empties again, or expired, which TakeExpired()
/// empties.
class LockStepBarrier {
 public:
  struct Waiting {
    std::uint64_t ticket = 0;
    StepRequest request;
    StepDone done;
  };

  LockStepBarrier(int participants, std::int64_t deadline_ns)
      : participants_(participants), deadline_span_ns_(deadline_ns) {}

  /// Takes the request in and returns its ticket (> 0). InvalidArgument: ticks out of range or
  /// unlike the others', no name where there are several participants. FailedPrecondition: this
  /// participant is already waiting.
  absl::StatusOr<std::uint64_t> Arrive(StepRequest request, StepDone done, std::int64_t now_ns);

  /// Everybody, in order of arrival, if all have come; else nobody.
  std::vector<Waiting> TakeIfFull();
  /// Everybody if the deadline has passed at `now_ns`; else nobody.
  std::vector<Waiting> TakeExpired(std::int64_t now_ns);
  std::vector<Waiting> TakeAll();
  /// The one with this ticket, or none.
  std::vector<Waiting> Take(std::uint64_t ticket);

  bool empty() const { return waiting_.empty(); }
  int waiting_count() const { return static_cast<int>(waiting_.size()); }
  int participants() const { return participants_; }
  /// When the barrier expires. Pre: !empty().
  std::int64_t deadline_ns() const { return deadline_ns_; }

 private:
  absl::Status Check(const StepRequest& request) const;

  int participants_;
  std::int64_t deadline_span_ns_;
  std::int64_t deadline_ns_ = 0;
  std::uint64_t next_ticket_ = 1;
  std::vector<Waiting> waiting_;
};

}  // namespace onesea::server
