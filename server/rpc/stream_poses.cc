#include "server/rpc/stream_poses.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/wire/proto_world.h"

namespace onesea::server {
namespace {

v1::StreamBodyPosesResponse Response(std::int64_t id, const absl::StatusOr<PosesResult>& result) {
  v1::StreamBodyPosesResponse response;
  response.set_id(id);
  if (!result.ok()) {
    response.set_error_code(static_cast<int>(result.status().code()));
    response.set_error_message(std::string(result.status().message()));
    return response;
  }
  response.set_tick(result->tick);
  for (const wire::BodyWrench& wrench : result->wrenches) {
    wire::ToProto(wrench, response.add_wrenches());
  }
  return response;
}

}  // namespace

void StreamPosesReactor::Take(const v1::StreamBodyPosesRequest& proto) {
  if (const absl::Status status = Bring(proto); !status.ok()) Give(Response(proto.id(), status));
}

// Not OK: there is no answer under way.
absl::Status StreamPosesReactor::Bring(const v1::StreamBodyPosesRequest& proto) {
  ONESEA_ASSIGN_OR_RETURN(wire::PoseBatch batch, wire::FromProto(proto));
  ONESEA_RETURN_IF_ERROR(ChooseSession(batch.session));
  for (wire::BodyPose& pose : batch.poses) FillInLease(pose);
  session_->SetPoses(std::move(batch.poses),
                     [this, id = batch.id](const absl::StatusOr<PosesResult>& result) {
                       Give(Response(id, result));
                     });
  return absl::OkStatus();
}

absl::Status StreamPosesReactor::ChooseSession(const std::string& name) {
  if (session_ == nullptr) {
    ONESEA_ASSIGN_OR_RETURN(session_, registry_.Find(name));
    return absl::OkStatus();
  }
  if (name.empty() || name == session_->name()) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat("session: this stream is of '", session_->name(),
                                                 "'; open another one for '", name, "'"));
}

void StreamPosesReactor::FillInLease(wire::BodyPose& pose) {
  if (pose.lease.empty()) {
    const auto known = leases_.find(pose.body_id);
    if (known != leases_.end()) pose.lease = known->second;
    return;
  }
  leases_[pose.body_id] = pose.lease;
  // Ids ascend with time: the lowest is the one that is most likely gone.
  if (leases_.size() > kBodiesMax) leases_.erase(leases_.begin());
}

}  // namespace onesea::server
