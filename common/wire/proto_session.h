#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "common/wire/session_spec.h"
#include "onesea/v1/session.pb.h"

/// Domain <-> proto of session.proto. Only common/wire, server/rpc and client/net include this.
namespace onesea::wire {

void ToProto(const SessionSpec& spec, v1::SessionSpec* out);
void ToProto(const SessionInfo& info, v1::SessionInfo* out);

/// Fills in every default and validates; `folder` as in proto_sea.h.
absl::StatusOr<SessionSpec> FromProto(const v1::SessionSpec& proto, const std::string& folder = "");
absl::StatusOr<SessionInfo> FromProto(const v1::SessionInfo& proto);

v1::Pace ToProto(Pace pace);
absl::StatusOr<Pace> FromProto(v1::Pace pace);  ///< PACE_UNSPECIFIED is real time

}  // namespace onesea::wire
