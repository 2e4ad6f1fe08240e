#include "server/rpc/step_session.h"

#include <utility>

#include "common/base/check.h"
#include "common/wire/proto_query.h"
#include "server/rpc/status_map.h"

namespace onesea::server {

StepReactor::StepReactor(const v1::StepSessionRequest* request, v1::StepSessionResponse* response,
                         QueryDesk& desk, Worker& worker)
    : request_(request), response_(response), desk_(desk), worker_(worker) {}

// Checks all before anything moves: a step with a bad query is not made.
absl::Status StepReactor::Prepare(Registry& registry) {
  ONESEA_ASSIGN_OR_RETURN(session_, registry.Find(request_->session()));
  if (!request_->has_query()) return absl::OkStatus();
  ONESEA_ASSIGN_OR_RETURN(query_, wire::FromProto(request_->query()));
  return ValidateQuery(*query_, session_->View().components->recipe);
}

void StepReactor::Begin(StepReactor* reactor, Registry& registry) {
  if (const absl::Status status = reactor->Prepare(registry); !status.ok()) {
    reactor->Finish(ToGrpc(status));
    return;
  }
  // From Step() on the reactor may be gone at any moment; what is used after it is kept here.
  const std::shared_ptr<SessionLoop> session = reactor->session_;
  const std::shared_ptr<Ticket> ticket = reactor->ticket_;
  const std::uint64_t number = session->Step(
      {reactor->request_->ticks(), reactor->request_->participant()},
      [reactor](const absl::StatusOr<StepResult>& result) { reactor->Stepped(result); });
  bool cancelled = false;
  {
    absl::MutexLock lock(&ticket->mutex);
    ticket->number = number;
    cancelled = ticket->cancelled;
  }
  if (cancelled) session->CancelStep(number);
}

void StepReactor::OnCancel() {
  const std::shared_ptr<SessionLoop> session = session_;
  std::uint64_t number = 0;
  {
    absl::MutexLock lock(&ticket_->mutex);
    ticket_->cancelled = true;
    number = ticket_->number;
  }
  if (session != nullptr && number != 0) session->CancelStep(number);
}

void StepReactor::Stepped(const absl::StatusOr<StepResult>& result) {
  if (!result.ok()) {
    Finish(ToGrpc(result.status()));
    return;
  }
  response_->set_tick(result->tick);
  response_->set_state_hash(result->state_hash);
  if (!query_) {
    Finish(grpc::Status::OK);
    return;
  }
  const absl::Status posted = worker_.Post([this, tick = result->tick] {
    if (!query_->tick && !query_->time_s) query_->tick = tick;
    FinishWith(desk_.Answer(session_, *query_));
  });
  if (!posted.ok()) FinishWith(posted);
}

// The step is made: whoever asked learns of it, whatever became of the query.
void StepReactor::FinishWith(absl::StatusOr<wire::QueryAnswer> answer) {
  ToProto(wire::OrError(std::move(answer), query_->id), response_->mutable_query());
  Finish(grpc::Status::OK);
}

}  // namespace onesea::server
