#include "common/wire/body_description.h"

#include <cmath>
#include <span>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/hash.h"
#include "common/wire/bounds.h"

namespace onesea::wire {
namespace {

constexpr double kOffsetMaxM = kHullSizeMaxM;  // of anything that is fixed to a body
constexpr double kCoefficientMax = 1e15;       // of given matrices: keeps sums finite
constexpr double kPi = 3.141592653589793;
constexpr std::uint32_t kColourMax = 0xFFFFFF;

absl::Status CheckOffset(std::string_view prefix, const std::string& field, Vec3d v) {
  ONESEA_RETURN_IF_ERROR(CheckReal(prefix, field + ".x", v.x, -kOffsetMaxM, kOffsetMaxM));
  ONESEA_RETURN_IF_ERROR(CheckReal(prefix, field + ".y", v.y, -kOffsetMaxM, kOffsetMaxM));
  return CheckReal(prefix, field + ".z", v.z, -kOffsetMaxM, kOffsetMaxM);
}

absl::Status CheckLength(std::string_view prefix, std::string_view field, double length_m) {
  return CheckReal(prefix, field, length_m, kHullSizeMinM, kHullSizeMaxM);
}

// Half-open: 0 is refused, and so is NaN.
absl::Status CheckPositive(std::string_view prefix, std::string_view field, double value,
                           double max) {
  return CheckReal(prefix, field, value, 1e-9, max);
}

absl::Status CheckShape(const std::string& prefix, const BodyShape& shape) {
  switch (shape.kind) {
    case ShapeKind::kBox:
      ONESEA_RETURN_IF_ERROR(CheckLength(prefix, "size.x_m", shape.size_m.x));
      ONESEA_RETURN_IF_ERROR(CheckLength(prefix, "size.y_m", shape.size_m.y));
      return CheckLength(prefix, "size.z_m", shape.size_m.z);
    case ShapeKind::kSphere:
      return CheckLength(prefix, "radius_m", shape.radius_m);
    case ShapeKind::kCylinder:
    case ShapeKind::kCapsule:
      ONESEA_RETURN_IF_ERROR(CheckLength(prefix, "radius_m", shape.radius_m));
      return CheckLength(prefix, "length_m", shape.length_m);
    case ShapeKind::kMesh:
      return CheckInteger(prefix, "mesh bytes", static_cast<std::int64_t>(shape.mesh.size()), 0,
                          kHullFileBytesMax);
  }
  return absl::InvalidArgumentError(absl::StrCat(prefix, "kind: is none of the shapes"));
}

absl::Status CheckThruster(const std::string& prefix, const Thruster& thruster) {
  ONESEA_RETURN_IF_ERROR(CheckOffset(prefix, "position_m", thruster.position_m));
  ONESEA_RETURN_IF_ERROR(CheckOffset(prefix, "direction", thruster.direction));
  ONESEA_RETURN_IF_ERROR(
      CheckReal(prefix, "direction length", Norm(thruster.direction), 1e-6, 2.0 * kOffsetMaxM));
  ONESEA_RETURN_IF_ERROR(CheckPositive(prefix, "diameter_m", thruster.diameter_m, 20.0));
  ONESEA_RETURN_IF_ERROR(CheckPositive(prefix, "turns_per_s_max", thruster.turns_per_s_max, 200.0));
  ONESEA_RETURN_IF_ERROR(CheckReal(prefix, "kt", thruster.kt, 0.0, 1.0));
  ONESEA_RETURN_IF_ERROR(CheckReal(prefix, "kt_slope", thruster.kt_slope, 0.0, 2.0));
  ONESEA_RETURN_IF_ERROR(CheckReal(prefix, "lag_s", thruster.lag_s, 0.0, 60.0));
  return CheckReal(prefix, "steer_rad_max", thruster.steer_rad_max, 0.0, kPi);
}

absl::Status CheckRudder(const std::string& prefix, const Rudder& rudder, int thrusters) {
  ONESEA_RETURN_IF_ERROR(CheckOffset(prefix, "position_m", rudder.position_m));
  ONESEA_RETURN_IF_ERROR(CheckPositive(prefix, "area_m2", rudder.area_m2, 1000.0));
  ONESEA_RETURN_IF_ERROR(CheckPositive(prefix, "aspect_ratio", rudder.aspect_ratio, 10.0));
  ONESEA_RETURN_IF_ERROR(CheckPositive(prefix, "angle_rad_max", rudder.angle_rad_max, 0.5 * kPi));
  ONESEA_RETURN_IF_ERROR(CheckReal(prefix, "lag_s", rudder.lag_s, 0.0, 60.0));
  return CheckInteger(prefix, "behind_thruster", rudder.behind_thruster, -1, thrusters - 1);
}

absl::Status CheckForces(const std::string& prefix, const BodyDescription& body) {
  const Drag& drag = body.drag;
  ONESEA_RETURN_IF_ERROR(CheckReal(prefix, "drag.friction", drag.friction, 0.0, 1.0));
  ONESEA_RETURN_IF_ERROR(CheckReal(prefix, "drag.pressure", drag.pressure, 0.0, 10.0));
  ONESEA_RETURN_IF_ERROR(CheckReal(prefix, "drag.suction", drag.suction, 0.0, 10.0));
  ONESEA_RETURN_IF_ERROR(CheckReal(prefix, "drag.planing", drag.planing, 0.0, 10.0));
  const std::string wind = prefix + "windage.";
  const Windage& windage = body.windage;
  ONESEA_RETURN_IF_ERROR(CheckReal(wind, "frontal_area_m2", windage.frontal_area_m2, 0.0, 1e5));
  ONESEA_RETURN_IF_ERROR(CheckReal(wind, "lateral_area_m2", windage.lateral_area_m2, 0.0, 1e5));
  ONESEA_RETURN_IF_ERROR(
      CheckReal(wind, "frontal_coefficient", windage.frontal_coefficient, 0.0, 5.0));
  ONESEA_RETURN_IF_ERROR(
      CheckReal(wind, "lateral_coefficient", windage.lateral_coefficient, 0.0, 5.0));
  ONESEA_RETURN_IF_ERROR(CheckOffset(wind, "centre_m", windage.centre_m));
  ONESEA_RETURN_IF_ERROR(CheckReal(prefix, "contact_friction", body.contact_friction, 0.0, 2.0));
  return CheckReal(prefix, "contact_restitution", body.contact_restitution, 0.0, 1.0);
}

absl::Status CheckMatrix(const std::string& prefix, const char* field,
                         std::span<const double> values) {
  for (std::size_t n = 0; n < values.size(); ++n) {
    ONESEA_RETURN_IF_ERROR(CheckReal(prefix, absl::StrCat(field, "[", n, "]"), values[n],
                                     -kCoefficientMax, kCoefficientMax));
  }
  return absl::OkStatus();
}

absl::Status CheckMass(const std::string& prefix, const BodyDescription& body) {
  ONESEA_RETURN_IF_ERROR(
      CheckReal(prefix, "mass_kg", body.mass_kg, kBodyMassMinKg, kBodyMassMaxKg));
  if (body.centre_of_mass_m) {
    ONESEA_RETURN_IF_ERROR(CheckOffset(prefix, "centre_of_mass_m", *body.centre_of_mass_m));
  }
  if (body.inertia_kg_m2) {
    ONESEA_RETURN_IF_ERROR(CheckMatrix(prefix, "inertia_kg_m2", *body.inertia_kg_m2));
  }
  const std::pair<const char*, const std::optional<Matrix6>*> matrices[] = {
      {"added_mass", &body.added_mass},
      {"radiation_damping", &body.radiation_damping},
      {"viscous_damping", &body.viscous_damping},
      {"quadratic_damping", &body.quadratic_damping}};
  for (const auto& [field, matrix] : matrices) {
    if (*matrix) ONESEA_RETURN_IF_ERROR(CheckMatrix(prefix, field, **matrix));
  }
  return absl::OkStatus();
}

}  // namespace

std::uint64_t MeshHash(const std::string& mesh) {
  Hash64 hash;
  hash.Add(std::string_view(mesh));
  return hash.value();
}

absl::Status ValidateBodyDescription(const std::string& prefix, const BodyDescription& body) {
  ONESEA_RETURN_IF_ERROR(CheckText(prefix, "name", body.name, kBodyNameLengthMax));
  ONESEA_RETURN_IF_ERROR(CheckText(prefix, "owner", body.owner, kBodyNameLengthMax));
  ONESEA_RETURN_IF_ERROR(CheckInteger(prefix, "colour_rgb", body.colour_rgb, 0, kColourMax));
  ONESEA_RETURN_IF_ERROR(CheckShape(prefix + "shape.", body.shape));
  ONESEA_RETURN_IF_ERROR(CheckMass(prefix, body));
  ONESEA_RETURN_IF_ERROR(CheckForces(prefix, body));
  ONESEA_RETURN_IF_ERROR(CheckSize(prefix, "thrusters", body.thrusters.size(), kThrustersMax));
  for (std::size_t n = 0; n < body.thrusters.size(); ++n) {
    ONESEA_RETURN_IF_ERROR(
        CheckThruster(absl::StrCat(prefix, "thrusters[", n, "]."), body.thrusters[n]));
  }
  ONESEA_RETURN_IF_ERROR(CheckSize(prefix, "rudders", body.rudders.size(), kRuddersMax));
  for (std::size_t n = 0; n < body.rudders.size(); ++n) {
    ONESEA_RETURN_IF_ERROR(CheckRudder(absl::StrCat(prefix, "rudders[", n, "]."), body.rudders[n],
                                       static_cast<int>(body.thrusters.size())));
  }
  return absl::OkStatus();
}

absl::Status ValidateBodyInfo(const BodyInfo& info) {
  const std::string prefix = absl::StrCat("body ", info.id, ": ");
  if (info.id == 0) return absl::InvalidArgumentError(absl::StrCat(prefix, "id"));
  ONESEA_RETURN_IF_ERROR(CheckText(prefix, "name", info.name, kBodyNameLengthMax));
  ONESEA_RETURN_IF_ERROR(CheckText(prefix, "owner", info.owner, kBodyNameLengthMax));
  ONESEA_RETURN_IF_ERROR(CheckInteger(prefix, "colour_rgb", info.colour_rgb, 0, kColourMax));
  ONESEA_RETURN_IF_ERROR(CheckShape(prefix + "shape.", info.shape));
  ONESEA_RETURN_IF_ERROR(CheckOffset(prefix, "centre_of_mass_m", info.centre_of_mass_m));
  return CheckReal(prefix, "mass_kg", info.mass_kg, 0.0, kBodyMassMaxKg);
}

}  // namespace onesea::wire
