#include "client/model/boat_figures.h"

#include <algorithm>
#include <cmath>

#include "common/sea/constants.h"

namespace onesea::client {
namespace {

// Added mass as shares of the mass, typical of small craft.
constexpr double kSurgeMass = 1.05, kTurnInertia = 1.5;
// What slows drift and turn of a boat that lies still [m/s].
constexpr double kStillM_per_s = 0.5;

// Length and beam.
Vec2d PlanOf(const wire::BodyShape& shape, double mass_kg) {
  switch (shape.kind) {
    case wire::ShapeKind::kBox:
      return {shape.size_m.x, shape.size_m.y};
    case wire::ShapeKind::kSphere:
    case wire::ShapeKind::kCylinder:
      return {2.0 * shape.radius_m, 2.0 * shape.radius_m};
    case wire::ShapeKind::kCapsule:
      return {shape.length_m + 2.0 * shape.radius_m, 2.0 * shape.radius_m};
    case wire::ShapeKind::kMesh:
      break;
  }
  // Boats of 450 kg and of 9 t are 5 and 10 m long: the cube of the length goes with the mass.
  const double length_m = 0.55 * std::cbrt(mass_kg);
  return {length_m, 0.36 * length_m};
}

double TurnInertia(const wire::BodyDescription& body, Vec2d plan_m) {
  const double hull = body.inertia_kg_m2
                          ? (*body.inertia_kg_m2)[8]
                          : *body.mass_kg * (plan_m.x * plan_m.x + plan_m.y * plan_m.y) / 12.0;
  return kTurnInertia * hull;
}

void Follow(double target, double lag_s, double seconds, double& value) {
  value += (lag_s > 0.0 ? 1.0 - std::exp(-seconds / lag_s) : 1.0) * (target - value);
}

}  // namespace

BoatFigures FiguresOf(const wire::BodyDescription& body) {
  constexpr double kRho = sea::kWaterDensityKgPerM3;
  const Vec2d plan_m = PlanOf(*body.shape, *body.mass_kg);
  const wire::Drag drag = body.drag.value_or(wire::Drag{});
  const double mass_kg = kSurgeMass * *body.mass_kg, inertia_kg_m2 = TurnInertia(body, plan_m);
  const Vec3d centre_m = body.centre_of_mass_m.value_or(Vec3d{});
  BoatFigures figures;
  figures.length_m = plan_m.x;
  const double draft_m = *body.mass_kg / (kRho * plan_m.x * plan_m.y);
  figures.drag_per_m = 0.5 * kRho *
                       ((drag.pressure + drag.suction) * plan_m.y * draft_m +
                        drag.friction * plan_m.x * (plan_m.y + 2.0 * draft_m)) /
                       mass_kg;
  if (body.thrusters.empty()) {
    figures.thrust_m_per_s2 = figures.fall_per_s = 0.0;
    return figures;
  }
  // Only the first is driven from here.
  const wire::Thruster& motor = body.thrusters[0];
  const double d = motor.diameter_m, n = motor.turns_per_s_max;
  const double ahead = motor.direction.x / Norm(motor.direction);
  figures.thrust_m_per_s2 = ahead * kRho * d * d * d * d * motor.kt * n * n / mass_kg;
  figures.fall_per_s = kRho * d * d * d * motor.kt_slope * n / mass_kg;
  figures.steer_rad = motor.steer_rad_max;
  figures.throttle_lag_s = figures.steer_lag_s = motor.lag_s;
  figures.turn_by_thrust_rad_per_m = (motor.position_m.x - centre_m.x) * mass_kg / inertia_kg_m2;
  if (body.rudders.empty()) return figures;
  const wire::Rudder& rudder = body.rudders[0];
  const double slope = 6.13 * rudder.aspect_ratio / (rudder.aspect_ratio + 2.25);
  figures.turn_by_flow_rad_per_m2 = (centre_m.x - rudder.position_m.x) * 0.5 * kRho *
                                    rudder.area_m2 * slope * std::sin(rudder.angle_rad_max) /
                                    inertia_kg_m2;
  if (rudder.behind_thruster == 0) figures.race_m = 8.0 * mass_kg / (sea::kPi * kRho * d * d);
  if (motor.steer_rad_max == 0.0) figures.steer_lag_s = rudder.lag_s;
  return figures;
}

void AdvanceDrive(const BoatFigures& figures, double throttle, double rudder, double seconds,
                  BoatDrive& drive) {
  Follow(throttle, figures.throttle_lag_s, seconds, drive.throttle);
  Follow(rudder, figures.steer_lag_s, seconds, drive.rudder);
}

double HeadingOf(const Quaternion& turn) {
  const Vec3d bow = Rotate(turn, {1, 0, 0});
  return std::atan2(bow.y, bow.x);
}

PlaneMotion PlaneMotionOf(const wire::BodyState& state) {
  const double heading = HeadingOf(state.turn), c = std::cos(heading), s = std::sin(heading);
  const Vec3d v = state.velocity_m_per_s;
  return {c * v.x + s * v.y, c * v.y - s * v.x, state.spin_rad_per_s.z};
}

PlaneMotion Acceleration(const BoatFigures& figures, const BoatDrive& drive,
                         const PlaneMotion& motion) {
  const double push = std::abs(drive.throttle) * (figures.thrust_m_per_s2 * drive.throttle -
                                                  figures.fall_per_s * motion.ahead);
  const double steer_rad = figures.steer_rad * drive.rudder;
  const double side = -push * std::sin(steer_rad);  // an outboard to port pushes the stern away
  const double flow_m2_per_s2 =
      motion.ahead * std::abs(motion.ahead) + figures.race_m * std::max(push, 0.0);
  const double fade_per_s = (std::abs(motion.ahead) + kStillM_per_s) / figures.length_m;
  PlaneMotion out;
  out.ahead = push * std::cos(steer_rad) -
              figures.drag_per_m * motion.ahead * std::abs(motion.ahead) +
              motion.turn * motion.port;
  out.port = side - fade_per_s * motion.port - motion.turn * motion.ahead;
  out.turn = figures.turn_by_thrust_rad_per_m * side +
             figures.turn_by_flow_rad_per_m2 * flow_m2_per_s2 * drive.rudder -
             fade_per_s * motion.turn;
  return out;
}

}  // namespace onesea::client
