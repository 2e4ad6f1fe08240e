#pragma once

#include "absl/status/statusor.h"
#include "common/wire/query.h"
#include "onesea/v1/query.pb.h"

/// Domain <-> proto of query.proto. Only common/wire, server/rpc and client/net include this.
namespace onesea::wire {

void ToProto(const QueryRequest& request, v1::QueryPointsRequest* out);
void ToProto(const QueryAnswer& answer, v1::QueryPointsResponse* out);

/// Checks sizes and enums; server/query checks the numbers.
absl::StatusOr<QueryRequest> FromProto(const v1::QueryPointsRequest& proto);

/// For clients. An answer that carries an error comes back as OK with `QueryAnswer::status` set.
absl::StatusOr<QueryAnswer> FromProto(const v1::QueryPointsResponse& proto);

/// OK if `answer`, without an error of its own, has the sizes that `request` asks for; DataLoss
/// naming the array that hasn't. For clients, before they index it by their points.
absl::Status CheckAnswers(const QueryRequest& request, const QueryAnswer& answer);

}  // namespace onesea::wire
