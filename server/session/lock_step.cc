#include "server/session/lock_step.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"

namespace onesea::server {

absl::Status LockStepBarrier::Check(const StepRequest& request) const {
  if (request.ticks < 1 || request.ticks > kStepTicksMax) {
    return absl::InvalidArgumentError(
        absl::StrCat("ticks: ", request.ticks, " is outside [1, ", kStepTicksMax, "]"));
  }
  if (request.participant.size() > kParticipantNameLengthMax) {
    return absl::InvalidArgumentError(absl::StrCat("participant: ", request.participant.size(),
                                                   " characters, the limit is ",
                                                   kParticipantNameLengthMax));
  }
  if (request.participant.empty() && participants_ > 1) {
    return absl::InvalidArgumentError(absl::StrCat("participant: is empty, but ", participants_,
                                                   " participants must be told apart"));
  }
  for (const Waiting& other : waiting_) {
    if (other.request.participant == request.participant) {
      return absl::FailedPreconditionError(absl::StrCat("participant: '", request.participant,
                                                        "' is already waiting at this barrier"));
    }
    if (other.request.ticks != request.ticks) {
      return absl::InvalidArgumentError(absl::StrCat("ticks: ", request.ticks, ", but '",
                                                     other.request.participant, "' asked for ",
                                                     other.request.ticks));
    }
  }
  return absl::OkStatus();
}

absl::StatusOr<std::uint64_t> LockStepBarrier::Arrive(StepRequest request, StepDone done,
                                                      std::int64_t now_ns) {
  ONESEA_RETURN_IF_ERROR(Check(request));
  if (waiting_.empty()) deadline_ns_ = now_ns + deadline_span_ns_;
  waiting_.push_back({next_ticket_, std::move(request), std::move(done)});
  return next_ticket_++;
}

std::vector<LockStepBarrier::Waiting> LockStepBarrier::TakeIfFull() {
  if (waiting_count() < participants_) return {};
  return TakeAll();
}

std::vector<LockStepBarrier::Waiting> LockStepBarrier::TakeExpired(std::int64_t now_ns) {
  if (waiting_.empty() || now_ns < deadline_ns_) return {};
  return TakeAll();
}

std::vector<LockStepBarrier::Waiting> LockStepBarrier::TakeAll() {
  return std::exchange(waiting_, {});
}

std::vector<LockStepBarrier::Waiting> LockStepBarrier::Take(std::uint64_t ticket) {
  const auto found = std::find_if(waiting_.begin(), waiting_.end(),
                                  [&](const Waiting& w) { return w.ticket == ticket; });
  std::vector<Waiting> taken;
  if (found == waiting_.end()) return taken;
  taken.push_back(std::move(*found));
  waiting_.erase(found);
  return taken;
}

}  // namespace onesea::server
