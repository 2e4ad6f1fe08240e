#pragma once

#include "onesea/v1/query.pb.h"
#include "server/rpc/answer_stream.h"
#include "server/rpc/query_desk.h"
#include "server/rpc/worker.h"

/// One StreamQueries call: many requests in flight on one stream.
namespace onesea::server {

/// A light request is answered at once, a heavy one on the worker; a bad one's answer carries its
/// error.
class StreamQueriesReactor final
    : public AnswerStream<v1::QueryPointsRequest, v1::QueryPointsResponse> {
 public:
  /// Both outlive it.
  StreamQueriesReactor(QueryDesk& desk, Worker& worker) : desk_(desk), worker_(worker) {}

 private:
  void Take(const v1::QueryPointsRequest& proto) override;
  void Answer(absl::StatusOr<wire::QueryAnswer> answer, std::int64_t id);

  QueryDesk& desk_;
  Worker& worker_;
};

}  // namespace onesea::server
