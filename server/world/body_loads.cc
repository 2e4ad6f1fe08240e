#include "server/world/body_loads.h"

#include <algorithm>
#include <cmath>

#include "common/base/limits.h"

namespace onesea::world {
namespace {

// Share of the water's acceleration that is believed: more is a sliver's rounding.
constexpr double kWaterAccelerationMax = 2.0 * sea::kGravity;

// The map v -> p x v.
Mat3d Skew(Vec3d p) { return {{0, -p.z, p.y, p.z, 0, -p.x, -p.y, p.x, 0}}; }
Mat3d Block(const Mat6& a, int row, int column) {
  Mat3d out;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) out(i, j) = a[row + i][column + j];
  }
  return out;
}

// A mass matrix fixed in a turning body, seen from axes that don't turn: with momentum
// (P, L) = A v,
//   d/dt (A v) + (0, v x P) = A dv/dt + 1/2 A' v + S v,  A' by the turn alone.
// S is skew, and the half of A' goes into the mean mass of the step: neither makes energy.
//   S = (0, T; -T', Q),  T = (A11 [v] - [P]) / 2,  Q = ([v] A12 + A21 [v] - [L]) / 2
Mat6 TurnCoupling(const Mat6& mass, const Vec6& velocity) {
  const Vec6 momentum = mass * velocity;
  const Mat3d v = Skew(Linear(velocity)), p = Skew(Linear(momentum)), l = Skew(Angular(momentum));
  const Mat3d t = Block(mass, 0, 0) * v;
  const Mat3d q = v * Block(mass, 0, 3), r = Block(mass, 3, 0) * v;
  Mat6 out{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      out[i][3 + j] = 0.5 * (t(i, j) - p(i, j));
      out[3 + j][i] = -out[i][3 + j];
      out[3 + i][3 + j] = 0.5 * (q(i, j) + r(i, j) - l(i, j));
    }
  }
  return out;
}

// R a R' for both halves.
Mat6 Turned(const Mat6& a, const Mat3d& r) {
  Mat3d back;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) back(i, j) = r(j, i);
  }
  Mat6 out{};
  for (int row : {0, 3}) {
    for (int column : {0, 3}) {
      const Mat3d block = r * (Block(a, row, column) * back);
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) out[row + i][column + j] = block(i, j);
      }
    }
  }
  return out;
}

Mat3d TurnInAStep(Vec3d spin_rad_per_s, double step_s) {
  const double rate = Norm(spin_rad_per_s);
  if (!(rate > 0.0)) return ToMatrix({});
  return ToMatrix(AboutAxis((1.0 / rate) * spin_rad_per_s, rate * step_s));
}

Mat6 Added(const BodyModel& model, double immersion, double submersion) {
  Mat6 out{};
  AddTo(out, immersion * (1.0 - submersion), model.added_at_rest);
  AddTo(out, immersion * submersion, model.added_submerged);
  return out;
}

Vec6 WindForce(const BodyModel& model, const Mat3d& turn, const BodyState& state, const Air& air) {
  const wire::Windage& w = model.spec.windage;
  const Vec3d at = w.centre_m - model.centre_of_mass_m;
  const Vec3d apparent = turn.TransposeTimes(air.wind_m_per_s - state.velocity_m_per_s) -
                         Cross(turn.TransposeTimes(state.spin_rad_per_s), at);
  const double half =
      0.5 * air.density_kg_per_m3 * std::sqrt(apparent.x * apparent.x + apparent.y * apparent.y);
  const Vec3d force{half * w.frontal_coefficient * w.frontal_area_m2 * apparent.x,
                    half * w.lateral_coefficient * w.lateral_area_m2 * apparent.y, 0.0};
  return Join(force, Cross(at, force));
}

// Linear damping fades when the body leaves the water, waves made also when it goes deep.
Mat6 Damping(const BodyModel& model, const BodyLoads& loads, const Vec6& relative) {
  Mat6 out{};
  if (model.spec.radiation == Radiation::kCoefficients) {
    const double share = loads.immersion * (1.0 - loads.submersion);
    AddTo(out, share, model.radiation_damping);
    out[2][2] += share * model.memory_damping;
  }
  AddTo(out, loads.immersion, model.viscous_damping);
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      out[i][j] += loads.immersion * model.spec.quadratic_damping[i][j] *
                   std::sqrt(std::abs(relative[i] * relative[j]));
    }
  }
  return out;
}

void Cut(double limit, Vec3d& v) {
  const double norm = Norm(v);
  if (norm > limit) v = (limit / norm) * v;
}

}  // namespace

BodyLoads ComputeLoads(const BodyModel& model, const BodyState& state, const WaterPatch& water,
                       const Air& air, WetScratch& scratch) {
  const BodySpec& spec = model.spec;
  const Mat3d turn = ToMatrix(state.pose.turn);
  const Vec3d velocity = turn.TransposeTimes(state.velocity_m_per_s);
  const Vec3d spin = turn.TransposeTimes(state.spin_rad_per_s);
  BodyLoads out;
  out.wet = model.hull.Evaluate({state.pose, state.velocity_m_per_s, state.spin_rad_per_s}, water,
                                model.density_kg_per_m3, spec.drag, scratch);
  const WetForces& wet = out.wet;

  // Half of the displacement at rest already moves the water of the floating body.
  const double rest_m3 = model.rest.volume_m3, whole_m3 = model.solid.volume_m3;
  out.immersion = std::clamp(2.0 * wet.volume_m3 / rest_m3, 0.0, 1.0);
  out.submersion = whole_m3 > 1.001 * rest_m3
                       ? std::clamp((wet.volume_m3 - rest_m3) / (whole_m3 - rest_m3), 0.0, 1.0)
                       : 0.0;
  out.added = Added(model, out.immersion, out.submersion);
  out.added_before = Added(model, state.immersion, state.submersion);

  const Vec3d gravity = turn.TransposeTimes({0.0, 0.0, -sea::kGravity});
  out.water_velocity = Join(wet.water_velocity_m_per_s, {});
  if (wet.volume_m3 > 1e-4 * rest_m3) {
    Vec3d rate = (1.0 / (model.density_kg_per_m3 * wet.volume_m3)) * wet.pressure_force_n + gravity;
    Cut(kWaterAccelerationMax, rate);
    out.water_rate = Join(rate, {});
  }

  const Vec6 relative = Join(velocity, spin) - out.water_velocity;
  out.damping = Damping(model, out, relative);
  AddTo(out.damping, 1.0,
        SternDamping(model.stern, model.rest.wet_high_m.x - model.rest.wet_low_m.x, out.added,
                     relative[0]));
  out.drag = Join(wet.drag_force_n, wet.drag_torque_n_m);
  out.applied = Join(wet.pressure_force_n + spec.mass_kg * gravity, wet.pressure_torque_n_m) +
                WindForce(model, turn, state, air);
  if (!spec.heave_memory.kernel.empty() && spec.radiation == Radiation::kCoefficients) {
    out.applied[2] += out.immersion * spec.heave_memory.Force(state.heave_history_m_per_s);
  }
  if (!spec.thrusters.empty() || !spec.rudders.empty()) {
    const PropulsionForces drive = Propel(
        spec.thrusters, spec.rudders, state.drive, model.centre_of_mass_m, state.pose,
        state.velocity_m_per_s, state.spin_rad_per_s, WaterSampler(water), model.density_kg_per_m3);
    out.applied = out.applied + Join(drive.force_n, drive.torque_n_m);
  }
  return out;
}

HydrodynamicWrench ComputeWrench(const BodyModel& model, const BodyState& state,
                                 const WaterPatch& water, const Air& air, WetScratch& scratch) {
  const BodyLoads loads = ComputeLoads(model, state, water, air, scratch);
  const Mat3d turn = ToMatrix(state.pose.turn);
  const Vec6 velocity =
      Join(turn.TransposeTimes(state.velocity_m_per_s), turn.TransposeTimes(state.spin_rad_per_s));
  const Vec6 relative = velocity - loads.water_velocity;
  // What the added mass's turning with the body asks for, beside its product with acceleration.
  const Vec3d v = Linear(relative), spin = Angular(velocity);
  const Vec6 momentum = loads.added * relative;
  const Vec6 turning = Join(Cross(spin, Linear(momentum)),
                            Cross(spin, Angular(momentum)) + Cross(v, Linear(momentum))) -
                       loads.added * Join(Cross(spin, v), {});
  const Vec6 wrench = loads.applied + loads.drag + loads.added * loads.water_rate -
                      loads.damping * relative - turning;
  const Vec3d gravity{0.0, 0.0, -sea::kGravity * model.spec.mass_kg};
  return {turn * Linear(wrench) - gravity, turn * Angular(wrench), loads.added};
}

Mat6 MassNow(const BodyModel& model, const BodyState& state) {
  Mat6 out = model.rigid_mass;
  AddTo(out, 1.0, Added(model, state.immersion, state.submersion));
  return out;
}

bool ApplyImpulse(const BodyModel& model, Vec3d impulse_n_s, Vec3d place_m, BodyState& state) {
  const Mat3d turn = ToMatrix(state.pose.turn);
  const Vec3d arm = place_m - state.pose.centre_m;
  Vec6 change =
      Join(turn.TransposeTimes(impulse_n_s), turn.TransposeTimes(Cross(arm, impulse_n_s)));
  if (!SolveInPlace(MassNow(model, state), change)) return false;
  Vec3d linear = state.velocity_m_per_s + turn * Linear(change);
  Vec3d angular = state.spin_rad_per_s + turn * Angular(change);
  if (!IsFinite(linear) || !IsFinite(angular)) return false;
  Cut(kBodySpeedMaxMPerS, linear);
  Cut(kBodySpinMaxRadPerS, angular);
  state.velocity_m_per_s = linear;
  state.spin_rad_per_s = angular;
  return true;
}

bool AdvanceVelocity(const BodyModel& model, const BodyLoads& loads, Vec3d force_n,
                     Vec3d torque_n_m, double step_s, BodyState& state) {
  const Mat3d turn = ToMatrix(state.pose.turn);
  const Vec6 velocity =
      Join(turn.TransposeTimes(state.velocity_m_per_s), turn.TransposeTimes(state.spin_rad_per_s));
  const Vec6 relative = velocity - loads.water_velocity;
  const Vec6 external = Join(turn.TransposeTimes(force_n), turn.TransposeTimes(torque_n_m));

  // Mean masses of the step; the body turns by about spin · step in it.
  const Mat3d step_turn = TurnInAStep(Angular(velocity), step_s);
  Mat6 rigid = Turned(model.rigid_mass, step_turn), added = Turned(loads.added, step_turn);
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      rigid[i][j] = 0.5 * (rigid[i][j] + model.rigid_mass[i][j]);
      added[i][j] = 0.5 * (added[i][j] + loads.added_before[i][j]);
    }
  }
  Mat6 on_relative = TurnCoupling(loads.added_before, relative);
  AddTo(on_relative, 1.0, loads.damping);
  Mat6 left = rigid;
  AddTo(left, 1.0, added);
  AddTo(left, step_s, TurnCoupling(model.rigid_mass, velocity));
  AddTo(left, step_s, on_relative);

  // Along the drag's own direction implicitly: it can stop the body, not turn it back.
  Vec6 drag = step_s * loads.drag;
  Vec6 answer = drag;
  const Elimination mass(left);
  bool good = mass.Solve(answer);
  const double taken = -Dot(relative, drag), overshoot = Dot(answer, drag);
  if (good && overshoot > 0.0) {
    const double room = taken > 0.0 ? taken : Dot(relative, left * relative);
    drag = (room / (room + overshoot)) * drag;
  }

  Vec6 right = model.rigid_mass * velocity + loads.added_before * relative +
               added * (loads.water_velocity + step_s * loads.water_rate) +
               step_s * (on_relative * loads.water_velocity) + step_s * (loads.applied + external) +
               drag;
  good = good && mass.Solve(right);

  Vec3d linear = turn * Linear(right), angular = turn * Angular(right);
  Cut(kBodySpeedMaxMPerS, linear);
  Cut(kBodySpinMaxRadPerS, angular);
  good = good && IsFinite(linear) && IsFinite(angular);
  if (!good) linear = angular = {};
  state.velocity_m_per_s = linear;
  state.spin_rad_per_s = angular;
  state.immersion = loads.immersion;
  state.submersion = loads.submersion;
  AdvanceDrive(model.spec.thrusters, model.spec.rudders, state.command, step_s, state.drive);
  if (!model.spec.heave_memory.kernel.empty()) {
    auto& history = state.heave_history_m_per_s;
    history.resize(model.spec.heave_memory.kernel.size() - 1, 0.0);
    std::shift_right(history.begin(), history.end(), 1);
    if (!history.empty()) history[0] = good ? right[2] - loads.water_velocity[2] : 0.0;
  }
  return good;
}

void AdvancePose(double step_s, BodyState& state) {
  state.pose.centre_m = state.pose.centre_m + step_s * state.velocity_m_per_s;
  const double rate = Norm(state.spin_rad_per_s);
  if (!(rate > 0.0)) return;
  const Quaternion turned =
      AboutAxis((1.0 / rate) * state.spin_rad_per_s, rate * step_s) * state.pose.turn;
  state.pose.turn = Normalised(turned);
}

int SubSteps(const BodyModel& model, double step_s) {
  constexpr double kPhaseMax = 0.5;  // of the bare body's heave in one sub-step
  constexpr int kSubStepsMax = 8;
  const double phase = step_s * model.bare_heave_rad_per_s;
  return std::clamp(static_cast<int>(std::ceil(phase / kPhaseMax)), 1, kSubStepsMax);
}

}  // namespace onesea::world
