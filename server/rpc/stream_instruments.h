#pragma once

#include <grpcpp/support/server_callback.h>

#include <memory>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "onesea/v1/command.pb.h"
#include "server/rpc/instrument_feed.h"
#include "server/rpc/query_desk.h"
#include "server/session/registry.h"

/// One StreamInstruments call.
namespace onesea::server {

/// Beginning (on the worker, since it waits for the session's lock) → streaming, one write under
/// way at a time → finished, by the caller's going or the session's end. Deletes itself when gRPC
/// is done.
class StreamInstrumentsReactor final
    : public grpc::ServerWriteReactor<v1::StreamInstrumentsResponse> {
 public:
  /// All outlive it.
  StreamInstrumentsReactor(Registry& registry, QueryDesk& desk, Worker& worker)
      : registry_(registry), desk_(desk), worker_(worker) {}

  /// Call once, right after construction; everything bad is answered through the reactor.
  static void Begin(StreamInstrumentsReactor* reactor, const v1::StreamInstrumentsRequest& request);

  void OnWriteDone(bool ok) override;
  void OnCancel() override;
  void OnDone() override;

 private:
  absl::Status Observe(const wire::InstrumentRequest& request);
  void Start(const wire::InstrumentRequest& request);
  void Advance();
  void End(const absl::Status& status);

  Registry& registry_;
  QueryDesk& desk_;
  Worker& worker_;
  std::shared_ptr<SessionLoop> session_;  // both are set while beginning_
  std::shared_ptr<InstrumentFeed> feed_;
  absl::Mutex mutex_;
  v1::StreamInstrumentsResponse response_ ABSL_GUARDED_BY(mutex_);  // gRPC's while writing_
  bool beginning_ ABSL_GUARDED_BY(mutex_) = true;
  bool writing_ ABSL_GUARDED_BY(mutex_) = false;
  bool cancelled_ ABSL_GUARDED_BY(mutex_) = false;
  bool finished_ ABSL_GUARDED_BY(mutex_) = false;
};

}  // namespace onesea::server
