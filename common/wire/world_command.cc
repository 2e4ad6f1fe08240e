#include "common/wire/world_command.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/wire/bounds.h"

namespace onesea::wire {
namespace {

absl::Status CheckId(std::string_view prefix, std::string_view field, std::uint32_t id) {
  if (id != 0) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(Text(prefix), Text(field), ": is missing"));
}

absl::Status CheckShares(std::string_view field, const std::vector<double>& shares, int max) {
  ONESEA_RETURN_IF_ERROR(CheckSize("", field, shares.size(), static_cast<std::size_t>(max)));
  for (const double share : shares) ONESEA_RETURN_IF_ERROR(CheckReal("", field, share, -1.0, 1.0));
  return absl::OkStatus();
}

// Twice the area to the left of a -> b -> c.
double Turning(Vec2d a, Vec2d b, Vec2d c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool Cross(Vec2d a, Vec2d b, Vec2d c, Vec2d d) {
  return (Turning(a, b, c) > 0.0) != (Turning(a, b, d) > 0.0) &&
         (Turning(c, d, a) > 0.0) != (Turning(c, d, b) > 0.0);
}

absl::Status CheckPolygon(const std::vector<Vec2d>& corners_m) {
  const std::size_t size = corners_m.size();
  ONESEA_RETURN_IF_ERROR(
      CheckInteger("", "corners", static_cast<std::int64_t>(size), 3, kObstacleCornersMax));
  double area = 0.0;
  for (std::size_t n = 0; n < size; ++n) {
    const Vec2d corner = corners_m[n], next = corners_m[(n + 1) % size];
    ONESEA_RETURN_IF_ERROR(
        CheckReal("", "corners.x_m", corner.x, -kQueryCoordinateMaxM, kQueryCoordinateMaxM));
    ONESEA_RETURN_IF_ERROR(
        CheckReal("", "corners.y_m", corner.y, -kQueryCoordinateMaxM, kQueryCoordinateMaxM));
    area += Turning(corners_m[0], corner, next);
  }
  if (area == 0.0) return absl::InvalidArgumentError("corners: the polygon has no area");
  for (std::size_t a = 0; a < size; ++a) {
    // Sides that share a corner touch there and don't cross.
    for (std::size_t b = a + 2; b < size; ++b) {
      if (a == 0 && b == size - 1) continue;
      if (!Cross(corners_m[a], corners_m[a + 1], corners_m[b], corners_m[(b + 1) % size])) continue;
      return absl::InvalidArgumentError(
          absl::StrCat("corners: sides ", a, " and ", b, " cross each other"));
    }
  }
  return absl::OkStatus();
}

absl::Status Check(const SpawnBody& command) {
  ONESEA_RETURN_IF_ERROR(ValidateBodyDescription("body.", command.body));
  const std::optional<BodyShape>& shape = command.body.shape;
  if (shape && shape->kind == ShapeKind::kMesh && shape->mesh.empty()) {
    return absl::InvalidArgumentError("body.shape.mesh.file: is empty");
  }
  return ValidateKinematics("start.", command.start);
}
absl::Status Check(const RemoveBody& command) { return CheckId("", "body_id", command.body_id); }
absl::Status Check(const DriveBody& command) {
  ONESEA_RETURN_IF_ERROR(CheckId("", "body_id", command.body_id));
  ONESEA_RETURN_IF_ERROR(CheckShares("throttle", command.throttle, kThrustersMax));
  return CheckShares("rudder", command.rudder, kRuddersMax);
}
absl::Status Check(const ApplyImpulse& command) {
  ONESEA_RETURN_IF_ERROR(CheckId("", "body_id", command.body_id));
  ONESEA_RETURN_IF_ERROR(CheckVector("", "impulse_n_s", command.impulse_n_s, kImpulseMaxNS));
  return command.position_m
             ? CheckVector("", "position_m", *command.position_m, kQueryCoordinateMaxM)
             : absl::OkStatus();
}
absl::Status Check(const Explode& command) {
  ONESEA_RETURN_IF_ERROR(CheckVector("", "position_m", command.position_m, kQueryCoordinateMaxM));
  ONESEA_RETURN_IF_ERROR(
      CheckReal("", "position_m.z", command.position_m.z, -kQueryDepthMaxM, 0.0));
  return CheckReal("", "energy_j", command.energy_j, 1e-3, kExplosionMaxJ);
}
absl::Status Check(const SetObstacle& command) { return CheckPolygon(command.corners_m); }
absl::Status Check(const RemoveObstacle& command) {
  return CheckId("", "obstacle_id", command.obstacle_id);
}
absl::Status Check(const AddRegion& command) {
  return ValidateRegionSpec("region.", command.region);
}
absl::Status Check(const RemoveRegion& command) {
  return CheckId("", "region_id", command.region_id);
}
absl::Status Check(const AddRope& command) { return ValidateRopeSpec("rope.", command.rope); }
absl::Status Check(const RemoveRope& command) { return CheckId("", "rope_id", command.rope_id); }
absl::Status Check(const TakeLease& command) {
  ONESEA_RETURN_IF_ERROR(CheckId("", "body_id", command.body_id));
  ONESEA_RETURN_IF_ERROR(CheckText("", "holder", command.holder, kBodyNameLengthMax));
  return CheckReal("", "duration_s", command.duration_s, 1e-3, kLeaseMaxS);
}
absl::Status Check(const ReleaseLease& command) { return CheckId("", "body_id", command.body_id); }

absl::Status CheckHeader(const CommandHeader& header) {
  ONESEA_RETURN_IF_ERROR(CheckText("command.", "session", header.session, kSessionNameLengthMax));
  ONESEA_RETURN_IF_ERROR(
      CheckText("command.", "request_id", header.request_id, kRequestIdLengthMax));
  if (header.request_id.empty()) {
    return absl::InvalidArgumentError("command.request_id: is empty; any text that is yours alone");
  }
  ONESEA_RETURN_IF_ERROR(CheckText("command.", "lease", header.lease, kLeaseLengthMax));
  if (!header.tick) return absl::OkStatus();
  return CheckInteger("command.", "tick", *header.tick, -kTickMax, kTickMax);
}

}  // namespace

int ValueCount(const Instrument& instrument) {
  if (std::holds_alternative<Motion>(instrument)) return 13;
  return std::holds_alternative<Imu>(instrument) ? 10 : 1;
}

absl::Status ValidateCommand(const CommandHeader& header, const WorldCommand& command) {
  ONESEA_RETURN_IF_ERROR(CheckHeader(header));
  return std::visit([](const auto& one) { return Check(one); }, command);
}

absl::Status ValidatePoses(const PoseBatch& batch) {
  ONESEA_RETURN_IF_ERROR(CheckText("", "session", batch.session, kSessionNameLengthMax));
  ONESEA_RETURN_IF_ERROR(CheckSize("", "poses", batch.poses.size(), kBodiesMax));
  for (std::size_t n = 0; n < batch.poses.size(); ++n) {
    const std::string prefix = absl::StrCat("poses[", n, "].");
    const BodyPose& pose = batch.poses[n];
    ONESEA_RETURN_IF_ERROR(CheckId(prefix, "body_id", pose.body_id));
    ONESEA_RETURN_IF_ERROR(CheckText(prefix, "lease", pose.lease, kLeaseLengthMax));
    ONESEA_RETURN_IF_ERROR(ValidateKinematics(prefix + "state.", pose.state));
  }
  return absl::OkStatus();
}

absl::Status ValidateInstruments(const InstrumentRequest& request) {
  ONESEA_RETURN_IF_ERROR(CheckText("", "session", request.session, kSessionNameLengthMax));
  ONESEA_RETURN_IF_ERROR(CheckInteger("", "instruments",
                                      static_cast<std::int64_t>(request.instruments.size()), 1,
                                      kInstrumentsMax));
  for (std::size_t n = 0; n < request.instruments.size(); ++n) {
    const std::string prefix = absl::StrCat("instruments[", n, "].");
    const Instrument& instrument = request.instruments[n];
    if (const auto* gauge = std::get_if<WaveGauge>(&instrument)) {
      const Vec3d place{gauge->place_m.x, gauge->place_m.y, 0.0};
      ONESEA_RETURN_IF_ERROR(CheckVector(prefix, "place_m", place, kQueryCoordinateMaxM));
    } else if (const auto* motion = std::get_if<Motion>(&instrument)) {
      ONESEA_RETURN_IF_ERROR(CheckId(prefix, "body_id", motion->body_id));
    } else if (const auto* imu = std::get_if<Imu>(&instrument)) {
      ONESEA_RETURN_IF_ERROR(CheckId(prefix, "body_id", imu->body_id));
      ONESEA_RETURN_IF_ERROR(CheckVector(prefix, "position_m", imu->position_m, kHullSizeMaxM));
    } else {
      const auto& pressure = std::get<PressureGauge>(instrument);
      const double max_m = pressure.body_id == 0 ? kQueryCoordinateMaxM : kHullSizeMaxM;
      ONESEA_RETURN_IF_ERROR(CheckVector(prefix, "position_m", pressure.position_m, max_m));
    }
  }
  return CheckInteger("", "ticks_per_reading", request.ticks_per_reading, 1, kTicksPerReadingMax);
}

}  // namespace onesea::wire
