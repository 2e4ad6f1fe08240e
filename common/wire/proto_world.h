#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "common/wire/world_command.h"
#include "onesea/v1/command.pb.h"
#include "onesea/v1/world.pb.h"

/// Domain <-> proto of the world's beginnings and of its commands. Only common/wire, server/rpc and
/// client/net include this.
namespace onesea::wire {

void ToProto(const WorldSpec& world, v1::WorldSpec* out);
/// Not validated (ValidateSessionSpec does). `folder` is where paths begin; empty: paths are
/// refused.
absl::StatusOr<WorldSpec> FromProto(const v1::WorldSpec& proto, const std::string& folder);

void ToProto(const RegionSpec& region, v1::RegionSpec* out);
absl::StatusOr<RegionSpec> FromProto(const v1::RegionSpec& proto);
void ToProto(const RopeSpec& rope, v1::Rope* out);
RopeSpec FromProto(const v1::Rope& proto);
void ToProto(const WaterLevel& level, v1::WaterLevel* out);
WaterLevel FromProto(const v1::WaterLevel& proto);
void ToProto(const TiedRope& rope, v1::TiedRope* out);
/// At most kRopesMax, their ids ascending, each of them valid; whether there are such bodies is not
/// asked.
absl::StatusOr<std::vector<TiedRope>> RopesFromProto(
    const std::string& prefix, const google::protobuf::RepeatedPtrField<v1::TiedRope>& ropes);

/// A command with its header, validated.
struct HeadedCommand {
  CommandHeader header;
  WorldCommand command;
};
absl::StatusOr<HeadedCommand> FromProto(const v1::SpawnBodyRequest& proto);
absl::StatusOr<HeadedCommand> FromProto(const v1::RemoveBodyRequest& proto);
absl::StatusOr<HeadedCommand> FromProto(const v1::DriveBodyRequest& proto);
absl::StatusOr<HeadedCommand> FromProto(const v1::ApplyImpulseRequest& proto);
absl::StatusOr<HeadedCommand> FromProto(const v1::ExplodeRequest& proto);
absl::StatusOr<HeadedCommand> FromProto(const v1::SetObstacleRequest& proto);
absl::StatusOr<HeadedCommand> FromProto(const v1::RemoveObstacleRequest& proto);
absl::StatusOr<HeadedCommand> FromProto(const v1::AddRegionRequest& proto);
absl::StatusOr<HeadedCommand> FromProto(const v1::RemoveRegionRequest& proto);
absl::StatusOr<HeadedCommand> FromProto(const v1::AddRopeRequest& proto);
absl::StatusOr<HeadedCommand> FromProto(const v1::RemoveRopeRequest& proto);
absl::StatusOr<HeadedCommand> FromProto(const v1::TakeLeaseRequest& proto);
absl::StatusOr<HeadedCommand> FromProto(const v1::ReleaseLeaseRequest& proto);

void ToProto(const CommandHeader& header, v1::Command* out);
// Everything of the request but its header.
void ToProto(const SpawnBody& command, v1::SpawnBodyRequest* out);
void ToProto(const RemoveBody& command, v1::RemoveBodyRequest* out);
void ToProto(const DriveBody& command, v1::DriveBodyRequest* out);
void ToProto(const ApplyImpulse& command, v1::ApplyImpulseRequest* out);
void ToProto(const Explode& command, v1::ExplodeRequest* out);
void ToProto(const SetObstacle& command, v1::SetObstacleRequest* out);
void ToProto(const RemoveObstacle& command, v1::RemoveObstacleRequest* out);
void ToProto(const AddRegion& command, v1::AddRegionRequest* out);
void ToProto(const RemoveRegion& command, v1::RemoveRegionRequest* out);
void ToProto(const AddRope& command, v1::AddRopeRequest* out);
void ToProto(const RemoveRope& command, v1::RemoveRopeRequest* out);
void ToProto(const TakeLease& command, v1::TakeLeaseRequest* out);
void ToProto(const ReleaseLease& command, v1::ReleaseLeaseRequest* out);

/// Validated.
absl::StatusOr<PoseBatch> FromProto(const v1::StreamBodyPosesRequest& proto);
void ToProto(const PoseBatch& batch, v1::StreamBodyPosesRequest* out);
void ToProto(const BodyWrench& wrench, v1::StreamBodyPosesResponse::Wrench* out);
absl::StatusOr<InstrumentRequest> FromProto(const v1::StreamInstrumentsRequest& proto);
void ToProto(const InstrumentRequest& request, v1::StreamInstrumentsRequest* out);

}  // namespace onesea::wire
