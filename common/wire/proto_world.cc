#include "common/wire/proto_world.h"

#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/wire/bounds.h"
#include "common/wire/proto_body.h"

namespace onesea::wire {
namespace {

CommandHeader ReadHeader(const v1::Command& proto) {
  CommandHeader header;
  header.session = proto.session();
  header.request_id = proto.request_id();
  if (proto.has_tick()) header.tick = proto.tick();
  header.lease = proto.lease();
  return header;
}

absl::StatusOr<HeadedCommand> Headed(const v1::Command& header, WorldCommand command) {
  HeadedCommand headed{ReadHeader(header), std::move(command)};
  ONESEA_RETURN_IF_ERROR(ValidateCommand(headed.header, headed.command));
  return headed;
}

std::vector<double> ToVector(const google::protobuf::RepeatedField<double>& from) {
  return {from.begin(), from.end()};
}

Instrument ReadInstrument(const v1::Instrument& proto) {
  switch (proto.kind_case()) {
    case v1::Instrument::kPressureGauge:
      return PressureGauge{proto.pressure_gauge().body_id(),
                           FromProto(proto.pressure_gauge().position_m())};
    case v1::Instrument::kImu:
      return Imu{proto.imu().body_id(), FromProto(proto.imu().position_m())};
    case v1::Instrument::kMotion:
      return Motion{proto.motion().body_id()};
    case v1::Instrument::kWaveGauge:
    case v1::Instrument::KIND_NOT_SET:
      break;
  }
  return WaveGauge{{proto.wave_gauge().x_m(), proto.wave_gauge().y_m()}};
}

void SetInstrument(const Instrument& instrument, v1::Instrument* out) {
  if (const auto* gauge = std::get_if<WaveGauge>(&instrument)) {
    out->mutable_wave_gauge()->set_x_m(gauge->place_m.x);
    out->mutable_wave_gauge()->set_y_m(gauge->place_m.y);
  } else if (const auto* pressure = std::get_if<PressureGauge>(&instrument)) {
    out->mutable_pressure_gauge()->set_body_id(pressure->body_id);
    ToProto(pressure->position_m, out->mutable_pressure_gauge()->mutable_position_m());
  } else if (const auto* imu = std::get_if<Imu>(&instrument)) {
    out->mutable_imu()->set_body_id(imu->body_id);
    ToProto(imu->position_m, out->mutable_imu()->mutable_position_m());
  } else {
    out->mutable_motion()->set_body_id(std::get<Motion>(instrument).body_id);
  }
}

// Elsewhere turns are normalised; here a length that drifts away is an integrator's fault, and it
// should hear of it.
absl::Status CheckTurn(const v1::StreamBodyPosesRequest::Pose& pose, int index) {
  const v1::Turn& turn = pose.state().turn();
  const Quaternion given{turn.w(), turn.x(), turn.y(), turn.z()};
  if (given == Quaternion{0, 0, 0, 0}) return absl::OkStatus();
  return CheckReal(absl::StrCat("poses[", index, "].state."), "turn (its length)",
                   std::sqrt(Dot(given, given)), 0.99, 1.01);
}

}  // namespace

absl::StatusOr<HeadedCommand> FromProto(const v1::SpawnBodyRequest& proto) {
  SpawnBody spawn;
  ONESEA_ASSIGN_OR_RETURN(spawn.body, FromProto(proto.body(), ""));
  spawn.start = FromProto(proto.start());
  return Headed(proto.command(), std::move(spawn));
}
absl::StatusOr<HeadedCommand> FromProto(const v1::RemoveBodyRequest& proto) {
  return Headed(proto.command(), RemoveBody{proto.body_id()});
}
absl::StatusOr<HeadedCommand> FromProto(const v1::DriveBodyRequest& proto) {
  return Headed(proto.command(),
                DriveBody{proto.body_id(), ToVector(proto.throttle()), ToVector(proto.rudder())});
}
absl::StatusOr<HeadedCommand> FromProto(const v1::ApplyImpulseRequest& proto) {
  ApplyImpulse impulse{proto.body_id(), FromProto(proto.impulse_n_s()), std::nullopt};
  if (proto.has_position_m()) impulse.position_m = FromProto(proto.position_m());
  return Headed(proto.command(), impulse);
}
absl::StatusOr<HeadedCommand> FromProto(const v1::ExplodeRequest& proto) {
  return Headed(proto.command(), Explode{FromProto(proto.position_m()), proto.energy_j()});
}
absl::StatusOr<HeadedCommand> FromProto(const v1::SetObstacleRequest& proto) {
  if (proto.x_m_size() != proto.y_m_size()) {
    return absl::InvalidArgumentError(
        absl::StrCat("y_m: ", proto.y_m_size(), " elements, but x_m has ", proto.x_m_size()));
  }
  ONESEA_RETURN_IF_ERROR(
      CheckSize("", "x_m", static_cast<std::size_t>(proto.x_m_size()), kObstacleCornersMax));
  SetObstacle obstacle{proto.obstacle_id(), {}};
  for (int n = 0; n < proto.x_m_size(); ++n) {
    obstacle.corners_m.push_back({proto.x_m(n), proto.y_m(n)});
  }
  return Headed(proto.command(), std::move(obstacle));
}
absl::StatusOr<HeadedCommand> FromProto(const v1::RemoveObstacleRequest& proto) {
  return Headed(proto.command(), RemoveObstacle{proto.obstacle_id()});
}
absl::StatusOr<HeadedCommand> FromProto(const v1::AddRegionRequest& proto) {
  ONESEA_ASSIGN_OR_RETURN(RegionSpec region, FromProto(proto.region()));
  return Headed(proto.command(), AddRegion{region});
}
absl::StatusOr<HeadedCommand> FromProto(const v1::RemoveRegionRequest& proto) {
  return Headed(proto.command(), RemoveRegion{proto.region_id()});
}
absl::StatusOr<HeadedCommand> FromProto(const v1::AddRopeRequest& proto) {
  return Headed(proto.command(), AddRope{FromProto(proto.rope())});
}
absl::StatusOr<HeadedCommand> FromProto(const v1::RemoveRopeRequest& proto) {
  return Headed(proto.command(), RemoveRope{proto.rope_id()});
}
absl::StatusOr<HeadedCommand> FromProto(const v1::TakeLeaseRequest& proto) {
  TakeLease lease{proto.body_id(), proto.holder()};
  // Not `!= 0`: NaN must go on to the validation, which refuses it.
  if (!(proto.duration_s() == 0.0)) lease.duration_s = proto.duration_s();
  return Headed(proto.command(), std::move(lease));
}
absl::StatusOr<HeadedCommand> FromProto(const v1::ReleaseLeaseRequest& proto) {
  return Headed(proto.command(), ReleaseLease{proto.body_id()});
}

void ToProto(const CommandHeader& header, v1::Command* out) {
  out->set_session(header.session);
  out->set_request_id(header.request_id);
  if (header.tick) out->set_tick(*header.tick);
  out->set_lease(header.lease);
}
void ToProto(const SpawnBody& command, v1::SpawnBodyRequest* out) {
  ToProto(command.body, out->mutable_body());
  ToProto(command.start, out->mutable_start());
}
void ToProto(const RemoveBody& command, v1::RemoveBodyRequest* out) {
  out->set_body_id(command.body_id);
}
void ToProto(const DriveBody& command, v1::DriveBodyRequest* out) {
  out->set_body_id(command.body_id);
  out->mutable_throttle()->Assign(command.throttle.begin(), command.throttle.end());
  out->mutable_rudder()->Assign(command.rudder.begin(), command.rudder.end());
}
void ToProto(const ApplyImpulse& command, v1::ApplyImpulseRequest* out) {
  out->set_body_id(command.body_id);
  ToProto(command.impulse_n_s, out->mutable_impulse_n_s());
  if (command.position_m) ToProto(*command.position_m, out->mutable_position_m());
}
void ToProto(const Explode& command, v1::ExplodeRequest* out) {
  ToProto(command.position_m, out->mutable_position_m());
  out->set_energy_j(command.energy_j);
}
void ToProto(const SetObstacle& command, v1::SetObstacleRequest* out) {
  out->set_obstacle_id(command.obstacle_id);
  for (const Vec2d corner : command.corners_m) {
    out->add_x_m(corner.x);
    out->add_y_m(corner.y);
  }
}
void ToProto(const RemoveObstacle& command, v1::RemoveObstacleRequest* out) {
  out->set_obstacle_id(command.obstacle_id);
}
void ToProto(const AddRegion& command, v1::AddRegionRequest* out) {
  ToProto(command.region, out->mutable_region());
}
void ToProto(const RemoveRegion& command, v1::RemoveRegionRequest* out) {
  out->set_region_id(command.region_id);
}
void ToProto(const AddRope& command, v1::AddRopeRequest* out) {
  ToProto(command.rope, out->mutable_rope());
}
void ToProto(const RemoveRope& command, v1::RemoveRopeRequest* out) {
  out->set_rope_id(command.rope_id);
}
void ToProto(const TakeLease& command, v1::TakeLeaseRequest* out) {
  out->set_body_id(command.body_id);
  out->set_holder(command.holder);
  out->set_duration_s(command.duration_s);
}
void ToProto(const ReleaseLease& command, v1::ReleaseLeaseRequest* out) {
  out->set_body_id(command.body_id);
}

absl::StatusOr<PoseBatch> FromProto(const v1::StreamBodyPosesRequest& proto) {
  ONESEA_RETURN_IF_ERROR(
      CheckSize("", "poses", static_cast<std::size_t>(proto.poses_size()), kBodiesMax));
  PoseBatch batch{proto.session(), proto.id(), {}};
  for (const auto& pose : proto.poses()) {
    ONESEA_RETURN_IF_ERROR(CheckTurn(pose, static_cast<int>(batch.poses.size())));
    batch.poses.push_back({pose.body_id(), pose.lease(), FromProto(pose.state())});
  }
  ONESEA_RETURN_IF_ERROR(ValidatePoses(batch));
  return batch;
}

void ToProto(const PoseBatch& batch, v1::StreamBodyPosesRequest* out) {
  out->set_session(batch.session);
  out->set_id(batch.id);
  for (const BodyPose& pose : batch.poses) {
    auto* to = out->add_poses();
    to->set_body_id(pose.body_id);
    to->set_lease(pose.lease);
    ToProto(pose.state, to->mutable_state());
  }
}

void ToProto(const BodyWrench& wrench, v1::StreamBodyPosesResponse::Wrench* out) {
  out->set_body_id(wrench.body_id);
  ToProto(wrench.force_n, out->mutable_force_n());
  ToProto(wrench.torque_n_m, out->mutable_torque_n_m());
  out->mutable_added_mass()->Assign(wrench.added_mass.begin(), wrench.added_mass.end());
}

absl::StatusOr<InstrumentRequest> FromProto(const v1::StreamInstrumentsRequest& proto) {
  ONESEA_RETURN_IF_ERROR(CheckSize(
      "", "instruments", static_cast<std::size_t>(proto.instruments_size()), kInstrumentsMax));
  InstrumentRequest request;
  request.session = proto.session();
  for (const v1::Instrument& instrument : proto.instruments()) {
    if (instrument.kind_case() == v1::Instrument::KIND_NOT_SET) {
      return absl::InvalidArgumentError(
          "instruments: one is none of wave_gauge, pressure_gauge, imu, motion");
    }
    request.instruments.push_back(ReadInstrument(instrument));
  }
  if (proto.ticks_per_reading() != 0) request.ticks_per_reading = proto.ticks_per_reading();
  ONESEA_RETURN_IF_ERROR(ValidateInstruments(request));
  return request;
}

void ToProto(const InstrumentRequest& request, v1::StreamInstrumentsRequest* out) {
  out->set_session(request.session);
  for (const Instrument& instrument : request.instruments) {
    SetInstrument(instrument, out->add_instruments());
  }
  out->set_ticks_per_reading(request.ticks_per_reading);
}

}  // namespace onesea::wire
