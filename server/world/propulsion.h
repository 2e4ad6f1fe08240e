#pragma once

#include <array>
#include <span>

#include "absl/status/status.h"
#include "common/base/limits.h"
#include "common/wire/body_gear.h"
#include "server/world/rigid_math.h"
#include "server/world/water_patch.h"

/// Propellers and rudders: enough to drive.
namespace onesea::world {

/// [-1, 1] each; what lies outside is cut, NaN is refused before (ValidateDrive).
struct DriveCommand {
  std::array<double, kThrustersMax> throttle{};
  std::array<double, kRuddersMax> rudder{};  ///< positive turns the boat to port; [0] also steers
                                             ///< outboard motors
  friend bool operator==(const DriveCommand&, const DriveCommand&) = default;
};
/// InvalidArgument for numbers that are not finite.
absl::Status ValidateDrive(const DriveCommand& command);

/// What lags behind the command.
struct DriveState {
  std::array<double, kThrustersMax> turns_per_s{};
  std::array<double, kThrustersMax> steer_rad{};
  std::array<double, kRuddersMax> rudder_rad{};
  friend bool operator==(const DriveState&, const DriveState&) = default;
};

struct PropulsionForces {
  Vec3d force_n, torque_n_m;  ///< body axes, about the centre of mass
};

void AdvanceDrive(std::span<const wire::Thruster> thrusters, std::span<const wire::Rudder> rudders,
                  const DriveCommand& command, double step_s, DriveState& state);

/// `centre_of_mass_m` in the body frame; motion in the world. In the air nothing acts.
PropulsionForces Propel(std::span<const wire::Thruster> thrusters,
                        std::span<const wire::Rudder> rudders, const DriveState& state,
                        Vec3d centre_of_mass_m, const Pose& pose, Vec3d velocity_m_per_s,
                        Vec3d spin_rad_per_s, const WaterSampler& water, double density_kg_per_m3);

}  // namespace onesea::world
