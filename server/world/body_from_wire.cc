#include "server/world/body_from_wire.h"

#include <algorithm>
#include <utility>

#include "common/base/check.h"
#include "common/ingest/mesh_file.h"

namespace onesea::world {
namespace {

std::optional<Mat6> MatrixOf(const std::optional<wire::Matrix6>& matrix) {
  if (!matrix) return std::nullopt;
  Mat6 out;
  for (std::size_t row = 0; row < 6; ++row) {
    for (std::size_t column = 0; column < 6; ++column) {
      out[row][column] = (*matrix)[6 * row + column];
    }
  }
  return out;
}

absl::StatusOr<BodyShape> ShapeOf(const wire::BodyShape& shape) {
  BodyShape out;
  out.kind = shape.kind;
  out.size_m = shape.size_m;
  out.radius_m = shape.radius_m;
  out.length_m = shape.length_m;
  if (shape.kind == wire::ShapeKind::kMesh) {
    ONESEA_ASSIGN_OR_RETURN(out.mesh, ingest::ReadMeshFile(shape.mesh));
  }
  return out;
}

}  // namespace

absl::StatusOr<BodySpec> FromWire(const wire::BodyDescription& from) {
  if (!from.shape || !from.mass_kg) {
    return absl::InvalidArgumentError("shape, mass_kg: both are needed");
  }
  BodySpec spec;
  if (from.control) spec.control = *from.control;
  if (from.radiation) spec.radiation = *from.radiation;
  ONESEA_ASSIGN_OR_RETURN(spec.shape, ShapeOf(*from.shape));
  spec.mass_kg = *from.mass_kg;
  spec.centre_of_mass_m = from.centre_of_mass_m;
  if (from.inertia_kg_m2) spec.inertia_kg_m2 = Mat3d{*from.inertia_kg_m2};
  spec.added_mass = MatrixOf(from.added_mass);
  spec.radiation_damping = MatrixOf(from.radiation_damping);
  spec.viscous_damping = MatrixOf(from.viscous_damping);
  if (from.quadratic_damping) spec.quadratic_damping = *MatrixOf(from.quadratic_damping);
  if (from.drag) spec.drag = *from.drag;
  if (from.windage) spec.windage = *from.windage;
  spec.thrusters = from.thrusters;
  for (wire::Thruster& thruster : spec.thrusters) {
    thruster.direction = (1.0 / Norm(thruster.direction)) * thruster.direction;
  }
  spec.rudders = from.rudders;
  if (from.contact_friction) spec.contact_friction = *from.contact_friction;
  if (from.contact_restitution) spec.contact_restitution = *from.contact_restitution;
  return spec;
}

BodyState FromWire(const wire::Kinematics& kinematics) {
  BodyState state;
  state.pose = {kinematics.position_m, Normalised(kinematics.turn)};
  state.velocity_m_per_s = kinematics.velocity_m_per_s;
  state.spin_rad_per_s = kinematics.spin_rad_per_s;
  return state;
}

wire::BodyInfo InfoOf(const wire::BodyDescription& description, const BodyModel& model) {
  wire::BodyInfo info;
  info.name = description.name;
  info.owner = description.owner;
  info.colour_rgb = description.colour_rgb.value_or(wire::kBodyColourDefault);
  info.shape = *description.shape;
  info.shape.mesh.clear();
  info.centre_of_mass_m = model.centre_of_mass_m;
  info.mass_kg = model.spec.mass_kg;
  return info;
}

}  // namespace onesea::world
