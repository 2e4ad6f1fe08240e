#pragma once

#include <cmath>
#include <functional>
#include <memory>

#include "common/base/check.h"
#include "server/world/body_loads.h"

namespace onesea::world {

inline std::shared_ptr<const BodyModel> Model(const BodySpec& spec, double density = 1000.0) {
  auto model = MakeBodyModel(spec, density);
  ONESEA_CHECK(model.ok()) << model.status().ToString();
  return *model;
}

/// At rest, upright, in calm water at the origin.
inline BodyState Afloat(const BodyModel& model) {
  BodyState state;
  state.pose.centre_m.z = model.rest.centre_height_m;
  state.immersion = 1.0;
  return state;
}

/// One body alone, without Bullet.
struct BodyRun {
  std::shared_ptr<const BodyModel> model;
  BodyState state;
  double step_s = 1.0 / 60.0;
  WaterPatch water{};
  Air air{};
  std::function<void(const BodyState&, double time_s, WaterPatch&)> sea{};
  Vec3d force_n{}, torque_n_m{};
  double time_s = 0.0;
  WetScratch scratch{};

  explicit BodyRun(const BodySpec& spec, double density = 1000.0)
      : model(Model(spec, density)), state(Afloat(*model)) {}

  bool Step() {
    if (sea) sea(state, time_s, water);
    const int parts = SubSteps(*model, step_s);
    bool good = true;
    for (int n = 0; n < parts; ++n) {
      const BodyLoads loads = ComputeLoads(*model, state, water, air, scratch);
      good &= AdvanceVelocity(*model, loads, force_n, torque_n_m, step_s / parts, state);
      AdvancePose(step_s / parts, state);
    }
    time_s += step_s;
    return good;
  }
  void Run(double seconds) {
    for (int n = 0; n < std::lround(seconds / step_s); ++n) Step();
  }
  Vec3d Up() const { return ToMatrix(state.pose.turn) * Vec3d{0, 0, 1}; }
};

/// No damping, no drag, no added mass: for closed forms.
inline BodySpec Bare(BodySpec spec) {
  spec.added_mass = spec.radiation_damping = spec.viscous_damping = Mat6{};
  spec.drag = {0, 0, 0, 0};
  return spec;
}

/// Seconds between the first and third zero crossing of what `read` gives, by linear interpolation.
inline double Period(BodyRun& run, const std::function<double(const BodyState&)>& read) {
  double crossings[3] = {};
  int found = 0;
  double before = read(run.state);
  for (int n = 0; n < 100'000 && found < 3; ++n) {
    run.Step();
    const double now = read(run.state);
    if (before * now < 0) {
      crossings[found++] = run.time_s - run.step_s * std::abs(now / (now - before));
    }
    before = now;
  }
  return found == 3 ? crossings[2] - crossings[0] : NAN;
}

}  // namespace onesea::world
