#include "server/world/body_presets.h"

#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/ingest/mesh_file.h"
#include "common/sea/constants.h"
#include "server/world/hull_shapes.h"

namespace onesea::world {
namespace {

using wire::BodyDescription;
using wire::ShapeKind;

// Slender hulls: little form drag, some lift of the bottom.
constexpr wire::Drag kBoatDrag{
    .friction = 0.004, .pressure = 0.25, .suction = 0.15, .planing = 0.5};

// Cross-flow drag of a slender hull in sway and yaw, which the coefficients along it leave out:
//   rho/2 c L T,  rho/2 c T ∫|x|³ dx.
wire::Matrix6 CrossFlow(double length_m, double draft_m) {
  constexpr double kCoefficient = 0.8;
  const double line = 0.5 * sea::kWaterDensityKgPerM3 * kCoefficient * draft_m;
  const double half = 0.5 * length_m;
  wire::Matrix6 out{};
  out[6 * 1 + 1] = line * length_m;
  out[6 * 5 + 5] = line * 0.5 * half * half * half * half;
  return out;
}

wire::BodyShape MeshShape(const TriangleMesh& mesh) {
  wire::BodyShape shape;
  shape.kind = ShapeKind::kMesh;
  shape.mesh = ingest::WriteStl(mesh);
  shape.mesh_hash = wire::MeshHash(shape.mesh);
  return shape;
}

BodyDescription Boat() {
  BodyDescription body;
  body.colour_rgb = 0xC23B22;
  body.shape = MeshShape(BoatMesh({}));
  body.mass_kg = 450.0;
  body.centre_of_mass_m = Vec3d{-0.6, 0.0, 0.5};
  body.drag = kBoatDrag;
  body.quadratic_damping = CrossFlow(4.6, 0.25);
  body.windage =
      wire::Windage{.frontal_area_m2 = 1.5, .lateral_area_m2 = 3.5, .centre_m = {-0.3, 0.0, 1.0}};
  body.thrusters = {{.position_m = {-2.55, 0.0, -0.1},
                     .diameter_m = 0.28,
                     .turns_per_s_max = 40.0,
                     .kt = 0.35,
                     .kt_slope = 0.4,
                     .lag_s = 0.6,
                     .steer_rad_max = 0.5}};
  // The motor's leg: it steers without thrust too, and keeps the boat on its course.
  body.rudders = {{.position_m = {-2.55, 0.0, 0.0},
                   .area_m2 = 0.08,
                   .aspect_ratio = 2.0,
                   .angle_rad_max = 0.5,
                   .lag_s = 0.6,
                   .behind_thruster = -1}};
  return body;
}

BodyDescription WorkBoat() {
  BodyDescription body;
  body.colour_rgb = 0x2A5CA8;
  body.shape = MeshShape(BoatMesh({.length_m = 10.0,
                                   .beam_m = 3.4,
                                   .depth_m = 1.9,
                                   .deadrise_rad = 0.35,
                                   .transom_share = 0.75,
                                   .stations = 21}));
  body.mass_kg = 9000.0;
  body.centre_of_mass_m = Vec3d{-1.0, 0.0, 1.0};
  body.drag = kBoatDrag;
  body.quadratic_damping = CrossFlow(8.5, 0.75);
  body.windage =
      wire::Windage{.frontal_area_m2 = 6.0, .lateral_area_m2 = 14.0, .centre_m = {0.0, 0.0, 2.2}};
  body.thrusters = {{.position_m = {-4.5, 0.0, -0.1},
                     .diameter_m = 0.7,
                     .turns_per_s_max = 12.0,
                     .kt = 0.35,
                     .kt_slope = 0.4,
                     .lag_s = 1.0}};
  body.rudders = {{.position_m = {-5.0, 0.0, 0.0},
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
  return body;
}

BodyDescription Buoy() {
  BodyDescription body;
  body.colour_rgb = 0xE0C020;
  body.shape = wire::BodyShape{.kind = ShapeKind::kCylinder, .radius_m = 0.6, .length_m = 1.0};
  body.mass_kg = 500.0;
  body.centre_of_mass_m = Vec3d{0.0, 0.0, -0.25};
  body.windage =
      wire::Windage{.frontal_area_m2 = 0.8, .lateral_area_m2 = 0.8, .centre_m = {0.0, 0.0, 0.7}};
  return body;
}

BodyDescription Crate() {
  BodyDescription body;
  body.colour_rgb = 0xA9825A;
  body.shape = wire::BodyShape{.kind = ShapeKind::kBox, .size_m = {1.0, 1.0, 0.8}};
  body.mass_kg = 240.0;
  body.windage = wire::Windage{.frontal_area_m2 = 0.5, .lateral_area_m2 = 0.5};
  return body;
}

BodyDescription Raft() {
  BodyDescription body;
  body.colour_rgb = 0x8A6B45;
  body.shape = wire::BodyShape{.kind = ShapeKind::kBox, .size_m = {3.0, 2.0, 0.3}};
  body.mass_kg = 400.0;
  body.windage = wire::Windage{.frontal_area_m2 = 0.5, .lateral_area_m2 = 0.8};
  return body;
}

struct Preset {
  BodyPresetEntry entry;
  BodyDescription (*make)();
};
constexpr Preset kPresets[] = {
    {{"boat", "motor boat, 5.0 x 2.0 m, 450 kg, an outboard that steers; it planes"}, Boat},
    {{"work-boat", "10 x 3.4 m, 9 t, a propeller with a rudder behind it"}, WorkBoat},
    {{"buoy", "1.2 m across, 500 kg, weight low"}, Buoy},
    {{"crate", "1 x 1 x 0.8 m, 240 kg"}, Crate},
    {{"raft", "3 x 2 x 0.3 m, 400 kg"}, Raft},
};

}  // namespace

std::vector<BodyPresetEntry> BodyPresets() {
  std::vector<BodyPresetEntry> entries;
  for (const Preset& preset : kPresets) entries.push_back(preset.entry);
  return entries;
}

absl::StatusOr<BodyDescription> BodyPreset(absl::string_view name) {
  std::string known;
  for (const auto& [entry, make] : kPresets) {
    if (entry.name == name) {
      BodyDescription body = make();
      body.name = std::string(name);
      return body;
    }
    absl::StrAppend(&known, known.empty() ? "" : ", ", entry.name);
  }
  return absl::NotFoundError(
      absl::StrCat("preset: there is no body \"", name, "\"; there are ", known));
}

absl::StatusOr<BodyDescription> WithPreset(BodyDescription given) {
  if (given.preset.empty()) return given;
  ONESEA_ASSIGN_OR_RETURN(BodyDescription preset, BodyPreset(given.preset));
  return wire::Overlaid(std::move(preset), given);
}

}  // namespace onesea::world
