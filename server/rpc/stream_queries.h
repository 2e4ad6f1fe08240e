#pragma once

#include <grpcpp/support/server_callback.h>

#include <deque>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "onesea/v1/query.pb.h"
#include "server/rpc/query_desk.h"
#include "server/rpc/worker.h"

/// One StreamQueries call: many requests in flight on one stream.
namespace onesea::server {

/// 1. A request is read; a light one is answered at once, a heavy one goes to the worker.
/// 2. Answers queue up and are written one at a time; a bad request's answer carries its error.
/// 3. With kInFlightMax answers owed the next request is not read: the client feels the
///    back-pressure of HTTP/2.
/// 4. When the client has closed its half and all is answered, or when the call is cancelled and
///    the worker gave everything back, the call is finished. Deletes itself when gRPC is done.
class StreamQueriesReactor final
    : public grpc::ServerBidiReactor<v1::QueryPointsRequest, v1::QueryPointsResponse> {
 public:
  static constexpr std::size_t kInFlightMax = 16;

  StreamQueriesReactor(QueryDesk& desk, Worker& worker);

  void OnReadDone(bool ok) override;
  void OnWriteDone(bool ok) override;
  void OnCancel() override;
  void OnDone() override { delete this; }

 private:
  void Take(wire::QueryRequest request);
  void Enqueue(const wire::QueryAnswer& answer, bool was_posted);
  // Starts what can be started. True: the call is over, and the caller is to Finish() it after
  // giving the lock back, since the reactor may be deleted from then on.
  [[nodiscard]] bool GoOn() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void FinishIf(bool over) {
    if (over) Finish(grpc::Status::OK);
  }

  QueryDesk& desk_;
  Worker& worker_;
  v1::QueryPointsRequest request_;  // owned by gRPC while reading_
  absl::Mutex mutex_;
  std::deque<v1::QueryPointsResponse> answers_ ABSL_GUARDED_BY(mutex_);  // front: being written
  std::size_t posted_ ABSL_GUARDED_BY(mutex_) = 0;                       // at the worker
  bool reading_ ABSL_GUARDED_BY(mutex_) = true;  // a read is under way or its request in hand
  bool writing_ ABSL_GUARDED_BY(mutex_) = false;
  bool no_more_requests_ ABSL_GUARDED_BY(mutex_) = false;
  bool broken_ ABSL_GUARDED_BY(mutex_) = false;
  bool finished_ ABSL_GUARDED_BY(mutex_) = false;
};

}  // namespace onesea::server
