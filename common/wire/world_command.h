#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "absl/status/status.h"
#include "common/base/sim_time.h"
#include "common/wire/world_spec.h"

/// Commands on a session's world in the domain's own words (proto onesea.v1, command.proto).
namespace onesea::wire {

/// What every command says of itself.
struct CommandHeader {
  std::string session;
  std::string request_id;    ///< 1..kRequestIdLengthMax bytes; a retry with the same is harmless
  std::optional<Tick> tick;  ///< when it shall act; none: the next
  std::string lease;         ///< of the body that it acts on, where one is needed
};

struct SpawnBody {
  BodyDescription body;
  Kinematics start;
};
struct RemoveBody {
  std::uint32_t body_id = 0;
};
/// Holds until the next one.
struct DriveBody {
  std::uint32_t body_id = 0;
  std::vector<double> throttle;  ///< one per thruster, [-1, 1]; missing ones are 0
  std::vector<double> rudder;    ///< one per rudder, [-1, 1], positive turns to port
};
struct ApplyImpulse {
  std::uint32_t body_id = 0;
  Vec3d impulse_n_s;                ///< world frame
  std::optional<Vec3d> position_m;  ///< world frame; none: at the centre of mass
};
struct Explode {
  Vec3d position_m;       ///< z <= 0
  double energy_j = 0.0;  ///< (0, kExplosionMaxJ]
};
/// A wall that waves don't pass.
struct SetObstacle {
  std::uint32_t obstacle_id = 0;  ///< 0: a new one
  std::vector<Vec2d> corners_m;   ///< 3..kObstacleCornersMax, a polygon that doesn't cross itself
};
struct RemoveObstacle {
  std::uint32_t obstacle_id = 0;
};
struct AddRegion {
  RegionSpec region;
};
struct RemoveRegion {
  std::uint32_t region_id = 0;
};
/// Between bodies, or a body and the world.
struct AddRope {
  RopeSpec rope;
};
struct RemoveRope {
  std::uint32_t rope_id = 0;
};
struct TakeLease {
  std::uint32_t body_id = 0;
  std::string holder;        ///< for people
  double duration_s = 60.0;  ///< real seconds; every command with the lease prolongs it by as much
};
struct ReleaseLease {
  std::uint32_t body_id = 0;
};

using WorldCommand = std::variant<SpawnBody, RemoveBody, DriveBody, ApplyImpulse, Explode,
                                  SetObstacle, RemoveObstacle, AddRegion, RemoveRegion, AddRope,
                                  RemoveRope, TakeLease, ReleaseLease>;

/// Of a body that its owner integrates, in a stream of poses.
struct BodyPose {
  std::uint32_t body_id = 0;
  std::string lease;
  Kinematics state;
};
/// What the water does to it: world frame, about the centre of mass, without its weight.
struct BodyWrench {
  std::uint32_t body_id = 0;
  Vec3d force_n, torque_n_m;
  Matrix6 added_mass{};  ///< body axes; not in the force: for the body's own inertia
};
struct PoseBatch {
  std::string session;
  std::int64_t id = 0;  ///< echoed
  std::vector<BodyPose> poses;
};

/// Instruments.
struct WaveGauge {
  Vec2d place_m;
};
struct PressureGauge {
  std::uint32_t body_id = 0;  ///< 0: fixed to the world
  Vec3d position_m;           ///< in that frame
};
struct Imu {
  std::uint32_t body_id = 0;
  Vec3d position_m;  ///< body frame
};
struct Motion {
  std::uint32_t body_id = 0;
};
using Instrument = std::variant<WaveGauge, PressureGauge, Imu, Motion>;
/// How many numbers a reading of it has: 1, 1, 10, 13.
int ValueCount(const Instrument& instrument);

struct InstrumentRequest {
  std::string session;
  std::vector<Instrument> instruments;
  int ticks_per_reading = 1;
};

/// Every number, text and array within its limits; whether ids exist is the session's to say.
/// InvalidArgument naming field, value and limit; NaN is refused.
absl::Status ValidateCommand(const CommandHeader& header, const WorldCommand& command);
absl::Status ValidatePoses(const PoseBatch& batch);
absl::Status ValidateInstruments(const InstrumentRequest& request);

}  // namespace onesea::wire
