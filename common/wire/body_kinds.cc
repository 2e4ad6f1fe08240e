#include "common/wire/body_kinds.h"

#include "absl/strings/str_cat.h"

namespace onesea::wire {
namespace {

BodyDescription Boxed(std::string_view name, Vec3d size_m, double mass_kg, double ballast_share) {
  BodyDescription body;
  body.name = std::string(name);
  body.shape.kind = ShapeKind::kBox;
  body.shape.size_m = size_m;
  body.mass_kg = mass_kg;
  body.centre_of_mass_m = Vec3d{0, 0, -ballast_share * size_m.z};
  return body;
}

BodyDescription Boat() {
  BodyDescription boat = Boxed("boat", {6.0, 2.2, 1.1}, 1900.0, 0.2);
  boat.colour_rgb = 0xC23B22;
  // A box, but one with a bow: it meets less resistance than its flat front would.
  boat.drag = {.friction = 0.004, .pressure = 0.12, .suction = 0.08, .planing = 0.0};
  boat.windage = {.frontal_area_m2 = 2.5, .lateral_area_m2 = 6.0, .centre_m = {0, 0, 0.5}};
  Thruster motor;
  motor.position_m = {-2.9, 0, -0.85};
  motor.diameter_m = 0.4;
  motor.turns_per_s_max = 25.0;
  motor.steer_rad_max = 0.6;
  boat.thrusters.push_back(motor);
  return boat;
}

}  // namespace

absl::StatusOr<BodyDescription> BodyKind(std::string_view kind) {
  if (kind == "boat") return Boat();
  if (kind == "crate") {
    BodyDescription crate = Boxed(kind, {1, 1, 1}, 350.0, 0.05);
    crate.colour_rgb = 0xA9825A;
    return crate;
  }
  if (kind == "raft") return Boxed(kind, {4, 3, 0.5}, 2500.0, 0.0);
  if (kind == "buoy") {
    BodyDescription buoy;
    buoy.name = "buoy";
    buoy.shape.kind = ShapeKind::kCylinder;
    buoy.shape.radius_m = 0.6;
    buoy.shape.length_m = 0.9;
    buoy.mass_kg = 500.0;
    buoy.centre_of_mass_m = Vec3d{0, 0, -0.25};
    buoy.colour_rgb = 0xE0C020;
    return buoy;
  }
  return absl::NotFoundError(
      absl::StrCat("'", std::string(kind), "' is no kind of body; there are ", BodyKindNames()));
}

std::string BodyKindNames() { return "boat, buoy, crate, raft"; }

}  // namespace onesea::wire
