#pragma once

#include <array>
#include <span>

#include "absl/status/status.h"
#include "common/base/limits.h"
#include "server/world/rigid_math.h"
#include "server/world/water_patch.h"

/// Propellers and rudders: enough to drive.
namespace onesea::world {

/// T = rho D⁴ (kt n|n| - slope |n| V/D), V the water's speed into the disc: the straight line
/// K_T = kt - slope J that measured open-water curves follow closely.
struct ThrusterSpec {
  Vec3d position_m{};              ///< body frame
  Vec3d direction{1.0, 0.0, 0.0};  ///< of positive thrust on the body; unit length
  double diameter_m = 0.3;         ///< (0, 20]
  double turns_per_s_max = 20.0;   ///< (0, 200]
  double kt = 0.35;                ///< [0, 1] at the bollard
  double kt_slope = 0.4;           ///< [0, 2] per unit of J = V/(nD); kt/slope: J without thrust
  double lag_s = 0.5;              ///< [0, 60] of the turns behind the throttle, first order
  double steer_rad_max = 0.0;      ///< [0, π] an outboard motor turns with the rudder command
};

/// F = rho/2 A U² 6.13 Λ/(Λ + 2.25) sin(angle of attack), across the blade.
/// Source: Fujii's formula as in the MMG manoeuvring standard; no stall.
struct RudderSpec {
  Vec3d position_m{};          ///< body frame, middle of the blade; its axis is the body's z
  double area_m2 = 0.1;        ///< (0, 1000]
  double aspect_ratio = 1.5;   ///< (0, 10] height over chord
  double angle_rad_max = 0.6;  ///< (0, π/2]
  double lag_s = 0.3;          ///< [0, 60] first order
  int behind_thruster = -1;    ///< whose race it stands in; -1: none
};

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

void AdvanceDrive(std::span<const ThrusterSpec> thrusters, std::span<const RudderSpec> rudders,
                  const DriveCommand& command, double step_s, DriveState& state);

/// `centre_of_mass_m` in the body frame; motion in the world. In the air nothing acts.
PropulsionForces Propel(std::span<const ThrusterSpec> thrusters,
                        std::span<const RudderSpec> rudders, const DriveState& state,
                        Vec3d centre_of_mass_m, const Pose& pose, Vec3d velocity_m_per_s,
                        Vec3d spin_rad_per_s, const WaterSampler& water, double density_kg_per_m3);

}  // namespace onesea::world
