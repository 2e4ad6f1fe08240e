#pragma once

#include <grpcpp/support/server_callback.h>

#include <cstdint>
#include <memory>
#include <optional>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "onesea/v1/onesea.pb.h"
#include "server/rpc/query_desk.h"
#include "server/rpc/worker.h"

/// One StepSession call.
namespace onesea::server {

/// Waiting (at the barrier or for its ticks) → answering (the optional query, on the worker) →
/// finished. A cancelled call leaves the barrier. Deletes itself when gRPC is done with it.
class StepReactor final : public grpc::ServerUnaryReactor {
 public:
  StepReactor(const v1::StepSessionRequest* request, v1::StepSessionResponse* response,
              QueryDesk& desk, Worker& worker);

  /// Begins; everything bad is answered through the reactor. Call once, right after construction.
  static void Begin(StepReactor* reactor, Registry& registry);

  void OnCancel() override;
  void OnDone() override { delete this; }

 private:
  // Outlives the reactor: the ticket is known only after the step may be done already.
  struct Ticket {
    absl::Mutex mutex;
    std::uint64_t number ABSL_GUARDED_BY(mutex) = 0;
    bool cancelled ABSL_GUARDED_BY(mutex) = false;
  };

  absl::Status Prepare(Registry& registry);
  void Stepped(const absl::StatusOr<StepResult>& result);
  void FinishWith(absl::StatusOr<wire::QueryAnswer> answer);

  const v1::StepSessionRequest* request_;
  v1::StepSessionResponse* response_;
  QueryDesk& desk_;
  Worker& worker_;
  std::shared_ptr<Ticket> ticket_ = std::make_shared<Ticket>();
  std::shared_ptr<SessionLoop> session_;
  std::optional<wire::QueryRequest> query_;
};

}  // namespace onesea::server
