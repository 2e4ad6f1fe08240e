#include "server/world/body_presets.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "server/world/hull_shapes.h"

namespace onesea::world {
namespace {

// Slender hulls: little form drag, some lift of the bottom.
constexpr wire::Drag kBoatDrag{
    .friction = 0.004, .pressure = 0.25, .suction = 0.15, .planing = 0.5};

// Cross-flow drag of a slender hull in sway and yaw, which the coefficients along it leave out:
//   rho/2 c L T,  rho/2 c T ∫|x|³ dx.
Mat6 CrossFlow(double length_m, double draft_m) {
  constexpr double kCoefficient = 0.8;
  const double line = 0.5 * sea::kWaterDensityKgPerM3 * kCoefficient * draft_m;
  const double half = 0.5 * length_m;
  Mat6 out{};
  out[1][1] = line * length_m;
  out[5][5] = line * 0.5 * half * half * half * half;
  return out;
}

BodySpec MotorBoat() {
  BodySpec spec;
  spec.shape.kind = ShapeKind::kMesh;
  spec.shape.mesh = BoatMesh({});
  spec.mass_kg = 450.0;
  spec.centre_of_mass_m = Vec3d{-0.6, 0.0, 0.5};
  spec.drag = kBoatDrag;
  spec.quadratic_damping = CrossFlow(4.6, 0.25);
  spec.windage = {.frontal_area_m2 = 1.5, .lateral_area_m2 = 3.5, .centre_m = {-0.3, 0.0, 1.0}};
  spec.thrusters = {{.position_m = {-2.55, 0.0, -0.1},
                     .diameter_m = 0.28,
                     .turns_per_s_max = 40.0,
                     .kt = 0.35,
                     .kt_slope = 0.4,
                     .lag_s = 0.6,
                     .steer_rad_max = 0.5}};
  // The motor's leg: it steers without thrust too, and keeps the boat on its course.
  spec.rudders = {{.position_m = {-2.55, 0.0, 0.0},
                   .area_m2 = 0.08,
                   .aspect_ratio = 2.0,
                   .angle_rad_max = 0.5,
                   .lag_s = 0.6,
                   .behind_thruster = -1}};
  return spec;
}

BodySpec WorkBoat() {
  BodySpec spec;
  spec.shape.kind = ShapeKind::kMesh;
  spec.shape.mesh = BoatMesh({.length_m = 10.0,
                              .beam_m = 3.4,
                              .depth_m = 1.9,
                              .deadrise_rad = 0.35,
                              .transom_share = 0.75,
                              .stations = 21});
  spec.mass_kg = 9000.0;
  spec.centre_of_mass_m = Vec3d{-1.0, 0.0, 1.0};
  spec.drag = kBoatDrag;
  spec.quadratic_damping = CrossFlow(8.5, 0.75);
  spec.windage = {.frontal_area_m2 = 6.0, .lateral_area_m2 = 14.0, .centre_m = {0.0, 0.0, 2.2}};
  spec.thrusters = {{.position_m = {-4.5, 0.0, -0.1},
                     .diameter_m = 0.7,
                     .turns_per_s_max = 12.0,
                     .kt = 0.35,
                     .kt_slope = 0.4,
                     .lag_s = 1.0}};
  spec.rudders = {{.position_m = {-5.0, 0.0, 0.0},
                   .area_m2 = 0.3,
                   .aspect_ratio = 1.4,
                   .angle_rad_max = 0.6,
                   .lag_s = 0.7,
                   .behind_thruster = 0},
                  // The skeg: hardly a rudder, but it keeps her on her course.
                  {.position_m = {-3.5, 0.0, 0.0},
                   .area_m2 = 0.6,
                   .aspect_ratio = 0.8,
                   .angle_rad_max = 1e-3,
                   .lag_s = 0.0,
                   .behind_thruster = -1}};
  return spec;
}

BodySpec Buoy() {
  BodySpec spec;
  spec.shape.kind = ShapeKind::kCylinder;
  spec.shape.radius_m = 0.6;
  spec.shape.length_m = 1.0;
  spec.mass_kg = 500.0;
  spec.centre_of_mass_m = Vec3d{0.0, 0.0, -0.25};
  spec.windage = {.frontal_area_m2 = 0.8, .lateral_area_m2 = 0.8, .centre_m = {0.0, 0.0, 0.7}};
  return spec;
}

BodySpec Crate() {
  BodySpec spec;
  spec.shape.size_m = {1.0, 1.0, 0.8};
  spec.mass_kg = 240.0;
  spec.windage = {.frontal_area_m2 = 0.5, .lateral_area_m2 = 0.5};
  return spec;
}

BodySpec Raft() {
  BodySpec spec;
  spec.shape.size_m = {3.0, 2.0, 0.3};
  spec.mass_kg = 400.0;
  spec.windage = {.frontal_area_m2 = 0.5, .lateral_area_m2 = 0.8};
  return spec;
}

constexpr std::pair<absl::string_view, BodySpec (*)()> kPresets[] = {
    {"motor-boat", MotorBoat}, {"work-boat", WorkBoat}, {"buoy", Buoy},
    {"crate", Crate},          {"raft", Raft},
};

}  // namespace

absl::StatusOr<BodySpec> BodyPreset(absl::string_view name) {
  std::string known;
  for (const auto& [preset, make] : kPresets) {
    if (preset == name) {
      BodySpec spec = make();
      spec.name = std::string(name);
      return spec;
    }
    absl::StrAppend(&known, known.empty() ? "" : ", ", preset);
  }
  return absl::NotFoundError(absl::StrCat("no body preset \"", name, "\"; there are ", known));
}

}  // namespace onesea::world
