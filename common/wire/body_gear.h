#pragma once

#include <string>

#include "absl/status/status.h"
#include "common/base/vec.h"

/// What drives, steers and slows a body: the figures that descriptions carry and that the server
/// computes with. Body frame: x forward, y to port, z up, metres.
namespace onesea::wire {

/// T = rho D⁴ (kt n|n| - slope |n| V/D), V the water's speed into the disc: the straight line
/// K_T = kt - slope J that measured open-water curves follow closely.
struct Thruster {
  Vec3d position_m{};
  Vec3d direction{1.0, 0.0, 0.0};  ///< of positive thrust on the body; any length but 0
  double diameter_m = 0.3;         ///< (0, 20]
  double turns_per_s_max = 20.0;   ///< (0, 200]
  double kt = 0.35;                ///< [0, 1] at the bollard
  double kt_slope = 0.4;           ///< [0, 2] per unit of J = V/(nD); kt/slope: J without thrust
  double lag_s = 0.5;              ///< [0, 60] of the turns behind the throttle, first order
  double steer_rad_max = 0.0;      ///< [0, π] an outboard motor turns with the rudder command
  friend bool operator==(const Thruster&, const Thruster&) = default;
};

/// F = rho/2 A U² 6.13 Λ/(Λ + 2.25) sin(angle of attack), across the blade.
/// Source: Fujii's formula as in the MMG manoeuvring standard; no stall.
struct Rudder {
  Vec3d position_m{};          ///< middle of the blade; its axis is z
  double area_m2 = 0.1;        ///< (0, 1000]
  double aspect_ratio = 1.5;   ///< (0, 10] height over chord
  double angle_rad_max = 0.6;  ///< (0, π/2]
  double lag_s = 0.3;          ///< [0, 60] first order
  int behind_thruster = -1;    ///< in whose race it stands; -1: none
  friend bool operator==(const Rudder&, const Rudder&) = default;
};

/// Wind on what is above the water: F = rho/2 c A |V| V by component, V the apparent wind at the
/// centre in body axes.
struct Windage {
  double frontal_area_m2 = 0.0, lateral_area_m2 = 0.0;  ///< [0, 1e5]
  double frontal_coefficient = 0.8;                     ///< [0, 5]
  double lateral_coefficient = 1.0;                     ///< [0, 5]
  Vec3d centre_m{};
  friend bool operator==(const Windage&, const Windage&) = default;
};

/// Of the velocity of wetted pieces relative to the water's own; all dimensionless, on rho/2.
///   normal      -(c |w_n| + lift |w|) w_n n   per area; c = pressure where the piece moves into
///               the water, suction where it moves away; lift only where it moves in
///   tangential  -friction |w| w_t             per area
struct Drag {
  double friction = 0.004;  ///< [0, 1]; the ITTC line gives 0.002-0.004 for boats
  double pressure = 0.6;    ///< [0, 10]; a flat plate's front has about 0.8
  double suction = 0.4;     ///< [0, 10]; and its back 0.4
  double planing = 0.0;     ///< [0, 10]; flat bottoms at a small angle a: near 0.5 π, lift ~ a V²
  friend bool operator==(const Drag&, const Drag&) = default;
};

/// InvalidArgument naming field, value and limit, each field after `prefix`. A rudder stands behind
/// one of `thrusters`.
absl::Status ValidateThruster(const std::string& prefix, const Thruster& thruster);
absl::Status ValidateRudder(const std::string& prefix, const Rudder& rudder, int thrusters);
absl::Status ValidateWindage(const std::string& prefix, const Windage& windage);
absl::Status ValidateDrag(const std::string& prefix, const Drag& drag);

/// A place that is fixed to a body: each part within ±kHullSizeMaxM.
absl::Status CheckOffset(const std::string& prefix, const std::string& field, Vec3d v);

}  // namespace onesea::wire
