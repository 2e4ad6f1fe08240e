#pragma once

#include "common/wire/body_description.h"
#include "common/wire/body_state.h"

/// How a boat answers throttle and rudder, in the plane: enough to know a fifth of a second ahead
/// what the server will say, and wrong in nothing that a driver would notice until it says it.
namespace onesea::client {

/// What the server's propulsion and hull amount to for one boat.
///
///   u' = thrust s|s| - fall |s| u - drag u|u| + r v          u ahead, v to port [m/s]
///   v' = side thrust - (|u| + v_still) v / length - r u       r yaw rate [rad/s]
///   r' = turn (thrust and flow past the rudder) - (|u| + u_still) r / length
///   s, d: throttle and rudder behind the order, first order   [-1, 1]
struct BoatFigures {
  double thrust_m_per_s2 = 2.0;  ///< full ahead, at rest
  double fall_per_s = 0.15;      ///< lost per m/s of speed at full turns
  double drag_per_m = 0.02;
  double steer_rad = 0.5;                  ///< of a motor that turns with the rudder
  double turn_by_thrust_rad_per_m = -0.6;  ///< yaw acceleration per side thrust; negative: astern
  double turn_by_flow_rad_per_m2 = 0.0;    ///< per square of the flow past rudders hard over
  double race_m = 0.0;  ///< square of the flow past rudders gains this times thrust
  double length_m = 5.0;
  double throttle_lag_s = 0.6, steer_lag_s = 0.6;
};

/// From masses, gear and size; added mass by rules of thumb. Pre: valid description, with shape and
/// mass.
BoatFigures FiguresOf(const wire::BodyDescription& body);

/// What lags behind the orders.
struct BoatDrive {
  double throttle = 0.0, rudder = 0.0;
};
/// Exact for an order that stands still meanwhile.
void AdvanceDrive(const BoatFigures& figures, double throttle, double rudder, double seconds,
                  BoatDrive& drive);

/// Along and across the heading, and its turn.
struct PlaneMotion {
  double ahead = 0.0, port = 0.0;  ///< m/s, or m/s²
  double turn = 0.0;               ///< rad/s, or rad/s²
};
PlaneMotion PlaneMotionOf(const wire::BodyState& state);
/// Angle of the bow, counter-clockwise from east.
double HeadingOf(const Quaternion& turn);

/// Its acceleration as seen from the hull.
PlaneMotion Acceleration(const BoatFigures& figures, const BoatDrive& drive,
                         const PlaneMotion& motion);

}  // namespace onesea::client
