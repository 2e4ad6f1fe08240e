#include "server/rpc/stream_queries.h"

#include <utility>

#include "common/wire/proto_query.h"

namespace onesea::server {

StreamQueriesReactor::StreamQueriesReactor(QueryDesk& desk, Worker& worker)
    : desk_(desk), worker_(worker) {
  StartRead(&request_);
}

void StreamQueriesReactor::OnReadDone(bool ok) {
  if (ok) {
    absl::StatusOr<wire::QueryRequest> request = wire::FromProto(request_);
    if (request.ok()) {
      Take(*std::move(request));
    } else {
      Enqueue(wire::OrError(request.status(), request_.id()), false);
    }
  }
  bool over = false;
  {
    absl::MutexLock lock(&mutex_);
    reading_ = false;
    if (!ok) no_more_requests_ = true;
    over = GoOn();
  }
  FinishIf(over);
}

void StreamQueriesReactor::Take(wire::QueryRequest request) {
  const std::int64_t id = request.id;
  if (!QueryDesk::IsHeavy(request)) {
    Enqueue(wire::OrError(desk_.Answer(request), id), false);
    return;
  }
  {
    absl::MutexLock lock(&mutex_);
    ++posted_;
  }
  const absl::Status posted = worker_.Post([this, request = std::move(request)] {
    Enqueue(wire::OrError(desk_.Answer(request), request.id), true);
  });
  if (!posted.ok()) Enqueue(wire::OrError(posted, id), true);
}

void StreamQueriesReactor::Enqueue(const wire::QueryAnswer& answer, bool was_posted) {
  v1::QueryPointsResponse response;
  ToProto(answer, &response);
  bool over = false;
  {
    absl::MutexLock lock(&mutex_);
    if (was_posted) --posted_;
    if (!broken_) answers_.push_back(std::move(response));
    over = GoOn();
  }
  FinishIf(over);
}

void StreamQueriesReactor::OnWriteDone(bool ok) {
  bool over = false;
  {
    absl::MutexLock lock(&mutex_);
    writing_ = false;
    answers_.pop_front();
    if (!ok) {
      broken_ = true;
      answers_.clear();
    }
    over = GoOn();
  }
  FinishIf(over);
}

void StreamQueriesReactor::OnCancel() {
  bool over = false;
  {
    absl::MutexLock lock(&mutex_);
    broken_ = true;
    while (answers_.size() > (writing_ ? 1 : 0)) answers_.pop_back();
    over = GoOn();
  }
  FinishIf(over);
}

bool StreamQueriesReactor::GoOn() {
  if (finished_) return false;
  if (!writing_ && !answers_.empty()) {
    writing_ = true;
    StartWrite(&answers_.front());
  }
  if (!reading_ && !no_more_requests_ && !broken_ && answers_.size() + posted_ < kInFlightMax) {
    reading_ = true;
    StartRead(&request_);
  }
  const bool idle = !writing_ && !reading_ && posted_ == 0 && answers_.empty();
  finished_ = idle && (no_more_requests_ || broken_);
  return finished_;
}

}  // namespace onesea::server
