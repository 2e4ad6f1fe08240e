#include "common/wire/body_description.h"

#include <cmath>
#include <span>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/hash.h"
#include "common/wire/bounds.h"

namespace onesea::wire {
namespace {

constexpr double kCoefficientMax = 1e15;  // of given matrices: keeps sums finite
constexpr std::uint32_t kColourMax = 0xFFFFFF;

absl::Status CheckLength(std::string_view prefix, std::string_view field, double length_m) {
  return CheckReal(prefix, field, length_m, kHullSizeMinM, kHullSizeMaxM);
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

absl::Status CheckForces(const std::string& prefix, const BodyDescription& body) {
  if (body.drag) ONESEA_RETURN_IF_ERROR(ValidateDrag(prefix + "drag.", *body.drag));
  if (body.windage) ONESEA_RETURN_IF_ERROR(ValidateWindage(prefix + "windage.", *body.windage));
  if (body.contact_friction) {
    ONESEA_RETURN_IF_ERROR(CheckReal(prefix, "contact_friction", *body.contact_friction, 0.0, 2.0));
  }
  if (!body.contact_restitution) return absl::OkStatus();
  return CheckReal(prefix, "contact_restitution", *body.contact_restitution, 0.0, 1.0);
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
  if (body.mass_kg) {
    ONESEA_RETURN_IF_ERROR(
        CheckReal(prefix, "mass_kg", *body.mass_kg, kBodyMassMinKg, kBodyMassMaxKg));
  }
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

BodyDescription Overlaid(BodyDescription base, const BodyDescription& given) {
  const auto take = [](auto& to, const auto& from) {
    if constexpr (requires { from.has_value(); }) {
      if (from.has_value()) to = from;
    } else {
      if (!from.empty()) to = from;
    }
  };
  base.preset.clear();
  take(base.name, given.name);
  take(base.owner, given.owner);
  take(base.colour_rgb, given.colour_rgb);
  take(base.control, given.control);
  take(base.radiation, given.radiation);
  take(base.shape, given.shape);
  take(base.mass_kg, given.mass_kg);
  take(base.centre_of_mass_m, given.centre_of_mass_m);
  take(base.inertia_kg_m2, given.inertia_kg_m2);
  take(base.added_mass, given.added_mass);
  take(base.radiation_damping, given.radiation_damping);
  take(base.viscous_damping, given.viscous_damping);
  take(base.quadratic_damping, given.quadratic_damping);
  take(base.drag, given.drag);
  take(base.windage, given.windage);
  take(base.thrusters, given.thrusters);
  take(base.rudders, given.rudders);
  take(base.contact_friction, given.contact_friction);
  take(base.contact_restitution, given.contact_restitution);
  return base;
}

absl::Status ValidateBodyDescription(const std::string& prefix, const BodyDescription& body) {
  ONESEA_RETURN_IF_ERROR(CheckText(prefix, "preset", body.preset, kBodyNameLengthMax));
  if (body.preset.empty() && !body.shape) {
    return absl::InvalidArgumentError(absl::StrCat(
        prefix, "shape: is missing; box, sphere, cylinder, capsule, mesh, or name a preset"));
  }
  if (body.preset.empty() && !body.mass_kg) {
    return absl::InvalidArgumentError(absl::StrCat(prefix, "mass_kg: is missing"));
  }
  ONESEA_RETURN_IF_ERROR(CheckText(prefix, "name", body.name, kBodyNameLengthMax));
  ONESEA_RETURN_IF_ERROR(CheckText(prefix, "owner", body.owner, kBodyNameLengthMax));
  const std::uint32_t colour_rgb = body.colour_rgb.value_or(kBodyColourDefault);
  ONESEA_RETURN_IF_ERROR(CheckInteger(prefix, "colour_rgb", colour_rgb, 0, kColourMax));
  if (body.shape) ONESEA_RETURN_IF_ERROR(CheckShape(prefix + "shape.", *body.shape));
  ONESEA_RETURN_IF_ERROR(CheckMass(prefix, body));
  ONESEA_RETURN_IF_ERROR(CheckForces(prefix, body));
  ONESEA_RETURN_IF_ERROR(CheckSize(prefix, "thrusters", body.thrusters.size(), kThrustersMax));
  for (std::size_t n = 0; n < body.thrusters.size(); ++n) {
    ONESEA_RETURN_IF_ERROR(
        ValidateThruster(absl::StrCat(prefix, "thrusters[", n, "]."), body.thrusters[n]));
  }
  ONESEA_RETURN_IF_ERROR(CheckSize(prefix, "rudders", body.rudders.size(), kRuddersMax));
  for (std::size_t n = 0; n < body.rudders.size(); ++n) {
    ONESEA_RETURN_IF_ERROR(ValidateRudder(absl::StrCat(prefix, "rudders[", n, "]."),
                                          body.rudders[n],
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
