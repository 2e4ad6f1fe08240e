#pragma once

#include <vector>

#include "server/world/body_spec.h"

/// What acts on one body now. No Bullet, no state but the body's: also for bodies that others
/// integrate.
namespace onesea::world {

/// Everything that the next step depends on.
struct BodyState {
  Pose pose;
  Vec3d velocity_m_per_s;  ///< of the centre of mass, world
  Vec3d spin_rad_per_s;    ///< world
  DriveCommand command;
  DriveState drive;
  /// Of the step before: how far added mass acted (0 dry .. 1 afloat, 0 afloat .. 1 deep).
  double immersion = 0.0, submersion = 0.0;
  std::vector<double> heave_history_m_per_s;  ///< newest first; only with heave_memory
  friend bool operator==(const BodyState&, const BodyState&) = default;
};

/// Vectors and matrices in body axes about the centre of mass.
struct BodyLoads {
  WetForces wet;
  Vec6 applied{};  ///< gravity, pressure, wind, propulsion, memory of waves made
  Vec6 drag{};     ///< per patch, quadratic
  Mat6 damping{};  ///< linear and linearised quadratic, on the velocity through the water
  Mat6 added{}, added_before{};  ///< added mass now and a step ago
  Vec6 water_velocity{};         ///< of the water around the body
  Vec6 water_rate{};             ///< its acceleration as seen by the turning body
  double immersion = 0.0, submersion = 0.0;
};

/// Air around the body; uniform.
struct Air {
  Vec3d wind_m_per_s;  ///< blowing to
  double density_kg_per_m3 = 1.225;
};

/// Added mass acts on the acceleration relative to the water's; the water's is read off the
/// undisturbed pressure over the wetted volume, so nothing needs the step before. That is the
/// long-wave form of diffraction: right where waves are longer than some five hulls, too large for
/// shorter ones. Rotation of the water is not counted. Cost: hull.Evaluate() and some µs.
BodyLoads ComputeLoads(const BodyModel& model, const BodyState& state, const WaterPatch& water,
                       const Air& air, WetScratch& scratch);

/// For those who integrate a body themselves: all forces but gravity, world axes, about the centre
/// of mass. Whoever can should add `added_mass` to the body's own inertia; else light bodies shake.
struct HydrodynamicWrench {
  Vec3d force_n, torque_n_m;
  Mat6 added_mass{};  ///< body axes
};
HydrodynamicWrench ComputeWrench(const BodyModel& model, const BodyState& state,
                                 const WaterPatch& water, const Air& air, WetScratch& scratch);

/// Mass and added mass of the step before, body axes: what an impulse meets now.
Mat6 MassNow(const BodyModel& model, const BodyState& state);

/// Changes the velocity at once by an impulse at a place, both in the world. False, and nothing
/// changed, where the result is not finite.
bool ApplyImpulse(const BodyModel& model, Vec3d impulse_n_s, Vec3d place_m, BodyState& state);

/// One step of the velocity under `loads` and an external force and torque (world axes, about the
/// centre of mass):
///   d/dt (M v) + d/dt (A v_r) + (0, v_r x P) + D v_r = applied + drag + A dv_w/dt, v_r = v - v_w
/// with 1/2 dA/dt in place of dA/dt where A changes with the wetted volume (energy is kept, none is
/// lost in spray). The turn of M and A with the body (gyroscopic and Munk moments) is split so that
/// it keeps energy, damping is implicit, and the quadratic drag is shortened where it would
/// overshoot: in still water none of them adds energy.
/// A result that is not finite becomes rest, and false is returned; speeds are cut at
/// kBodySpeedMaxMPerS and kBodySpinMaxRadPerS. Advances drive and memory as well.
bool AdvanceVelocity(const BodyModel& model, const BodyLoads& loads, Vec3d force_n,
                     Vec3d torque_n_m, double step_s, BodyState& state);

/// Moves by the velocity, turns by the exact rotation.
void AdvancePose(double step_s, BodyState& state);

/// How many sub-steps a body needs: 1, but up to 8 for bodies so light that a step would carry them
/// deep into the water before it pushes back (a beach ball).
int SubSteps(const BodyModel& model, double step_s);

}  // namespace onesea::world
