#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "common/wire/world_spec.h"
#include "onesea/v1/body.pb.h"

/// Domain <-> proto of bodies. Only common/wire, server/rpc and client/net include this.
///
/// FromProto fills in defaults and checks shapes of arrays and enums; numbers are checked by
/// ValidateBodyDescription and its like, which the callers that accept a whole message call.
namespace onesea::wire {

void ToProto(Vec3d v, v1::Vector3* out);
Vec3d FromProto(const v1::Vector3& proto);
/// Normalised; all zero is no turn. NaN stays, for the validation to refuse.
Quaternion FromProto(const v1::Turn& proto);
void ToProto(const Kinematics& kinematics, v1::Kinematics* out);
Kinematics FromProto(const v1::Kinematics& proto);

void ToProto(const BodyDescription& body, v1::BodyDescription* out);
/// `folder` is where a mesh's path begins; empty: paths are refused.
absl::StatusOr<BodyDescription> FromProto(const v1::BodyDescription& proto,
                                          const std::string& folder);

void ToProto(const BodyInfo& info, v1::BodyInfo* out);
/// Validated.
absl::StatusOr<BodyInfo> FromProto(const v1::BodyInfo& proto);

}  // namespace onesea::wire
