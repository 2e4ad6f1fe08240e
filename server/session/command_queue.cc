#include "server/session/command_queue.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"

namespace onesea::server {

std::vector<CommandQueue::Due> CommandQueue::Submit(CommandRequest request, CommandDone done,
                                                    Tick now, std::int64_t ahead_max) {
  const std::string id = request.header.request_id;
  if (const auto found = entries_.find(id); found != entries_.end()) {
    if (found->second.answered) {
      done(found->second.result);
    } else {
      found->second.waiting.push_back(std::move(done));
    }
    return {};
  }
  const Tick tick = request.header.tick.value_or(now + 1);
  if (tick <= now || tick > now + ahead_max) {
    done(absl::FailedPreconditionError(absl::StrCat("tick: ", tick, " is outside [", now + 1, ", ",
                                                    now + ahead_max, "]: now is ", now)));
    return {};
  }
  if (by_ticket_.size() >= kCommandsWaitingMax) {
    done(absl::ResourceExhaustedError(
        absl::StrCat(kCommandsWaitingMax, " commands wait for their tick already")));
    return {};
  }
  Entry& entry = entries_[id];
  entry.ticket = ++tickets_;
  entry.waiting.push_back(std::move(done));
  by_ticket_[entry.ticket] = id;
  Due due{std::move(request), entry.ticket};
  if (tick == now + 1) {
    std::vector<Due> at_once;
    at_once.push_back(std::move(due));
    return at_once;
  }
  waiting_.emplace(tick, std::move(due));
  return {};
}

std::vector<CommandQueue::Due> CommandQueue::TakeDue(Tick tick) {
  std::vector<Due> due;
  while (!waiting_.empty() && waiting_.begin()->first <= tick) {
    due.push_back(std::move(waiting_.begin()->second));
    waiting_.erase(waiting_.begin());
  }
  return due;
}

void CommandQueue::Answer(std::uint64_t ticket, absl::StatusOr<CommandResult> result) {
  const auto found = by_ticket_.find(ticket);
  ONESEA_CHECK(found != by_ticket_.end()) << "ticket " << ticket << " was answered before";
  const std::string id = found->second;
  by_ticket_.erase(found);
  Entry& entry = entries_[id];
  entry.answered = true;
  entry.result = std::move(result);
  const std::vector<CommandDone> waiting = std::exchange(entry.waiting, {});
  const absl::StatusOr<CommandResult> answer = entry.result;
  Remember(id);
  for (const CommandDone& done : waiting) done(answer);
}

void CommandQueue::FailAll(const absl::Status& status) {
  waiting_.clear();
  while (!by_ticket_.empty()) Answer(by_ticket_.begin()->first, status);
}

void CommandQueue::Remember(const std::string& request_id) {
  answered_.push_back(request_id);
  if (answered_.size() <= kRequestsRememberedMax) return;
  entries_.erase(answered_.front());
  answered_.pop_front();
}

}  // namespace onesea::server
