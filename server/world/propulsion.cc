#include "server/world/propulsion.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "common/sea/constants.h"

namespace onesea::world {
namespace {

// Exact for a command that stands still during the step, and stable for any lag.
void Follow(double target, double lag_s, double step_s, double& value) {
  const double share = lag_s > 0.0 ? 1.0 - real::Exp(-step_s / lag_s) : 1.0;
  value += share * (target - value);
}

Vec3d TurnedAboutZ(Vec3d v, double angle_rad) {
  const real::SinCosPair turn = real::SinCos(angle_rad);
  return {turn.cos * v.x - turn.sin * v.y, turn.sin * v.x + turn.cos * v.y, v.z};
}

// 0 in the air, 1 from `size` / 2 under water.
double Wetted(const WaterPoint& water, double size_m) {
  return std::clamp(water.depth_m / size_m + 0.5, 0.0, 1.0);
}

}  // namespace

absl::Status ValidateDrive(const DriveCommand& command) {
  for (double value : command.throttle) {
    if (!std::isfinite(value)) return absl::InvalidArgumentError("drive.throttle is not a number");
  }
  for (double value : command.rudder) {
    if (!std::isfinite(value)) return absl::InvalidArgumentError("drive.rudder is not a number");
  }
  return absl::OkStatus();
}

void AdvanceDrive(std::span<const wire::Thruster> thrusters, std::span<const wire::Rudder> rudders,
                  const DriveCommand& command, double step_s, DriveState& state) {
  const auto cut = [](double value) { return std::clamp(value, -1.0, 1.0); };
  for (std::size_t n = 0; n < thrusters.size(); ++n) {
    const wire::Thruster& t = thrusters[n];
    Follow(cut(command.throttle[n]) * t.turns_per_s_max, t.lag_s, step_s, state.turns_per_s[n]);
    Follow(-cut(command.rudder[0]) * t.steer_rad_max, t.lag_s, step_s, state.steer_rad[n]);
  }
  for (std::size_t n = 0; n < rudders.size(); ++n) {
    Follow(cut(command.rudder[n]) * rudders[n].angle_rad_max, rudders[n].lag_s, step_s,
           state.rudder_rad[n]);
  }
}

PropulsionForces Propel(std::span<const wire::Thruster> thrusters,
                        std::span<const wire::Rudder> rudders, const DriveState& state,
                        Vec3d centre_of_mass_m, const Pose& pose, Vec3d velocity_m_per_s,
                        Vec3d spin_rad_per_s, const WaterSampler& water, double density_kg_per_m3) {
  const Mat3d turn = ToMatrix(pose.turn);
  const Vec3d velocity = turn.TransposeTimes(velocity_m_per_s);
  const Vec3d spin = turn.TransposeTimes(spin_rad_per_s);
  PropulsionForces out;
  const auto add = [&](Vec3d at, Vec3d force) {
    out.force_n = out.force_n + force;
    out.torque_n_m = out.torque_n_m + Cross(at, force);
  };
  // The body's velocity at a place relative to the water there, body axes.
  const auto relative = [&](Vec3d at, const WaterPoint& point) {
    return velocity + Cross(spin, at) - turn.TransposeTimes(point.velocity_m_per_s);
  };

  std::array<double, kThrustersMax> race_m_per_s{};  // added to the flow behind the disc
  for (std::size_t n = 0; n < thrusters.size(); ++n) {
    const wire::Thruster& t = thrusters[n];
    const Vec3d at = t.position_m - centre_of_mass_m;
    const WaterPoint point = SampleWater(water, pose.centre_m + turn * at);
    const Vec3d direction = TurnedAboutZ(t.direction, state.steer_rad[n]);
    const double into = Dot(relative(at, point), direction);
    const double turns = state.turns_per_s[n], d = t.diameter_m;
    const double thrust = Wetted(point, d) * density_kg_per_m3 * d * d * d * std::abs(turns) *
                          (t.kt * turns * d - t.kt_slope * into);
    add(at, thrust * direction);
    // Actuator disc: far behind, V² grows by 8 T / (π rho D²).
    if (thrust > 0.0) {
      const double gain = 8.0 * thrust / (sea::kPi * density_kg_per_m3 * d * d);
      race_m_per_s[n] = std::sqrt(into * into + gain) - std::abs(into);
    }
  }
  for (std::size_t n = 0; n < rudders.size(); ++n) {
    const wire::Rudder& r = rudders[n];
    const Vec3d at = r.position_m - centre_of_mass_m;
    const WaterPoint point = SampleWater(water, pose.centre_m + turn * at);
    Vec3d flow = -1.0 * relative(at, point);  // of the water past the blade
    if (r.behind_thruster >= 0) flow.x -= race_m_per_s[r.behind_thruster];
    const double speed = std::sqrt(flow.x * flow.x + flow.y * flow.y);
    if (!(speed > 0.0)) continue;
    // Positive angle: the trailing edge goes to port and pushes the stern to starboard.
    const real::SinCosPair blade = real::SinCos(state.rudder_rad[n]);
    const Vec3d across{blade.sin, blade.cos, 0.0};  // normal of the blade, to port
    const double sin_attack = (flow.x * across.x + flow.y * across.y) / speed;
    const double slope = 6.13 * r.aspect_ratio / (r.aspect_ratio + 2.25);
    const double force = 0.5 * density_kg_per_m3 * r.area_m2 * speed * speed * slope * sin_attack *
                         Wetted(point, std::sqrt(r.area_m2 * r.aspect_ratio));
    add(at, force * across);
  }
  return out;
}

}  // namespace onesea::world
