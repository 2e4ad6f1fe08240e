#include "server/rpc/stream_queries.h"

#include <utility>

#include "common/wire/proto_query.h"

namespace onesea::server {

void StreamQueriesReactor::Take(const v1::QueryPointsRequest& proto) {
  const std::int64_t id = proto.id();
  absl::StatusOr<wire::QueryRequest> request = wire::FromProto(proto);
  if (!request.ok()) return Answer(request.status(), id);
  if (!QueryDesk::IsHeavy(*request)) return Answer(desk_.Answer(*request), id);
  const absl::Status posted = worker_.Post(
      [this, request = *std::move(request)] { Answer(desk_.Answer(request), request.id); });
  if (!posted.ok()) Answer(posted, id);
}

void StreamQueriesReactor::Answer(absl::StatusOr<wire::QueryAnswer> answer, std::int64_t id) {
  v1::QueryPointsResponse response;
  ToProto(wire::OrError(std::move(answer), id), &response);
  Give(std::move(response));
}

}  // namespace onesea::server
