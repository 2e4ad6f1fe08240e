#include "common/wire/proto_body.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"

namespace onesea::wire {
namespace {

absl::StatusOr<std::string> ReadMesh(const std::string& path, const std::string& folder) {
  if (folder.empty()) {
    return absl::InvalidArgumentError("shape.mesh.path: only session files may name files");
  }
  const std::filesystem::path whole = std::filesystem::path(folder) / path;
  std::error_code failure;
  const std::uintmax_t size = std::filesystem::file_size(whole, failure);
  if (failure) {
    return absl::NotFoundError(absl::StrCat("shape.mesh.path: ", path, ": ", failure.message()));
  }
  if (size > static_cast<std::uintmax_t>(kHullFileBytesMax)) {
    return absl::InvalidArgumentError(absl::StrCat("shape.mesh.path: ", path, ": ", size,
                                                   " bytes, the limit is ", kHullFileBytesMax));
  }
  std::ifstream file(whole, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  if (!file) return absl::NotFoundError(absl::StrCat("shape.mesh.path: ", path, ": can't be read"));
  return bytes.str();
}

void SetShape(const BodyShape& shape, bool with_mesh, v1::BodyShape* out) {
  switch (shape.kind) {
    case ShapeKind::kBox:
      ToProto(shape.size_m, out->mutable_box()->mutable_size_m());
      return;
    case ShapeKind::kSphere:
      out->mutable_sphere()->set_radius_m(shape.radius_m);
      return;
    case ShapeKind::kCylinder:
      out->mutable_cylinder()->set_radius_m(shape.radius_m);
      out->mutable_cylinder()->set_length_m(shape.length_m);
      return;
    case ShapeKind::kCapsule:
      out->mutable_capsule()->set_radius_m(shape.radius_m);
      out->mutable_capsule()->set_length_m(shape.length_m);
      return;
    case ShapeKind::kMesh:
      if (with_mesh) out->mutable_mesh()->set_file(shape.mesh);
      out->mutable_mesh()->set_hash(shape.mesh_hash);
  }
}

absl::StatusOr<BodyShape> ReadShape(const v1::BodyShape& proto, const std::string& folder) {
  BodyShape shape;
  switch (proto.kind_case()) {
    case v1::BodyShape::kBox:
      shape.size_m = FromProto(proto.box().size_m());
      return shape;
    case v1::BodyShape::kSphere:
      shape.kind = ShapeKind::kSphere;
      shape.radius_m = proto.sphere().radius_m();
      return shape;
    case v1::BodyShape::kCylinder:
      shape.kind = ShapeKind::kCylinder;
      shape.radius_m = proto.cylinder().radius_m();
      shape.length_m = proto.cylinder().length_m();
      return shape;
    case v1::BodyShape::kCapsule:
      shape.kind = ShapeKind::kCapsule;
      shape.radius_m = proto.capsule().radius_m();
      shape.length_m = proto.capsule().length_m();
      return shape;
    case v1::BodyShape::kMesh:
      shape.kind = ShapeKind::kMesh;
      shape.mesh = proto.mesh().file();
      if (!proto.mesh().path().empty()) {
        ONESEA_ASSIGN_OR_RETURN(shape.mesh, ReadMesh(proto.mesh().path(), folder));
      }
      // Whoever has the bytes need not believe a hash.
      shape.mesh_hash = shape.mesh.empty() ? proto.mesh().hash() : MeshHash(shape.mesh);
      return shape;
    case v1::BodyShape::KIND_NOT_SET:
      break;
  }
  return absl::InvalidArgumentError("shape: is none of box, sphere, cylinder, capsule, mesh");
}

void SetThruster(const Thruster& thruster, v1::Thruster* out) {
  ToProto(thruster.position_m, out->mutable_position_m());
  ToProto(thruster.direction, out->mutable_direction());
  out->set_diameter_m(thruster.diameter_m);
  out->set_turns_per_s_max(thruster.turns_per_s_max);
  out->set_kt(thruster.kt);
  out->set_kt_slope(thruster.kt_slope);
  out->set_lag_s(thruster.lag_s);
  out->set_steer_rad_max(thruster.steer_rad_max);
}

Thruster ReadThruster(const v1::Thruster& proto) {
  Thruster thruster;
  thruster.position_m = FromProto(proto.position_m());
  if (proto.has_direction()) thruster.direction = FromProto(proto.direction());
  if (proto.has_diameter_m()) thruster.diameter_m = proto.diameter_m();
  if (proto.has_turns_per_s_max()) thruster.turns_per_s_max = proto.turns_per_s_max();
  if (proto.has_kt()) thruster.kt = proto.kt();
  if (proto.has_kt_slope()) thruster.kt_slope = proto.kt_slope();
  if (proto.has_lag_s()) thruster.lag_s = proto.lag_s();
  thruster.steer_rad_max = proto.steer_rad_max();
  return thruster;
}

void SetRudder(const Rudder& rudder, v1::Rudder* out) {
  ToProto(rudder.position_m, out->mutable_position_m());
  out->set_area_m2(rudder.area_m2);
  out->set_aspect_ratio(rudder.aspect_ratio);
  out->set_angle_rad_max(rudder.angle_rad_max);
  out->set_lag_s(rudder.lag_s);
  if (rudder.behind_thruster >= 0) out->set_behind_thruster(rudder.behind_thruster);
}

Rudder ReadRudder(const v1::Rudder& proto) {
  Rudder rudder;
  rudder.position_m = FromProto(proto.position_m());
  if (proto.has_area_m2()) rudder.area_m2 = proto.area_m2();
  if (proto.has_aspect_ratio()) rudder.aspect_ratio = proto.aspect_ratio();
  if (proto.has_angle_rad_max()) rudder.angle_rad_max = proto.angle_rad_max();
  if (proto.has_lag_s()) rudder.lag_s = proto.lag_s();
  if (proto.has_behind_thruster()) rudder.behind_thruster = proto.behind_thruster();
  return rudder;
}

void SetForces(const BodyDescription& body, v1::BodyDescription* out) {
  if (body.drag) {
    out->mutable_drag()->set_friction(body.drag->friction);
    out->mutable_drag()->set_pressure(body.drag->pressure);
    out->mutable_drag()->set_suction(body.drag->suction);
    out->mutable_drag()->set_planing(body.drag->planing);
  }
  if (body.windage) {
    v1::Windage* windage = out->mutable_windage();
    windage->set_frontal_area_m2(body.windage->frontal_area_m2);
    windage->set_lateral_area_m2(body.windage->lateral_area_m2);
    windage->set_frontal_coefficient(body.windage->frontal_coefficient);
    windage->set_lateral_coefficient(body.windage->lateral_coefficient);
    ToProto(body.windage->centre_m, windage->mutable_centre_m());
  }
  if (body.contact_friction) out->set_contact_friction(*body.contact_friction);
  if (body.contact_restitution) out->set_contact_restitution(*body.contact_restitution);
}

Drag ReadDrag(const v1::Drag& proto) {
  Drag drag;
  if (proto.has_friction()) drag.friction = proto.friction();
  if (proto.has_pressure()) drag.pressure = proto.pressure();
  if (proto.has_suction()) drag.suction = proto.suction();
  drag.planing = proto.planing();
  return drag;
}

Windage ReadWindage(const v1::Windage& proto) {
  Windage windage;
  windage.frontal_area_m2 = proto.frontal_area_m2();
  windage.lateral_area_m2 = proto.lateral_area_m2();
  if (proto.has_frontal_coefficient()) windage.frontal_coefficient = proto.frontal_coefficient();
  if (proto.has_lateral_coefficient()) windage.lateral_coefficient = proto.lateral_coefficient();
  windage.centre_m = FromProto(proto.centre_m());
  return windage;
}

void ReadForces(const v1::BodyDescription& proto, BodyDescription& body) {
  if (proto.has_drag()) body.drag = ReadDrag(proto.drag());
  if (proto.has_windage()) body.windage = ReadWindage(proto.windage());
  if (proto.has_contact_friction()) body.contact_friction = proto.contact_friction();
  if (proto.has_contact_restitution()) body.contact_restitution = proto.contact_restitution();
}

template <typename Array>
void SetNumbers(const std::optional<Array>& from, google::protobuf::RepeatedField<double>* to) {
  if (from) to->Assign(from->begin(), from->end());
}

template <typename Array>
absl::Status ReadNumbers(const char* field, const google::protobuf::RepeatedField<double>& from,
                         std::optional<Array>& to) {
  if (from.empty()) return absl::OkStatus();
  to.emplace();
  if (from.size() != static_cast<int>(to->size())) {
    return absl::InvalidArgumentError(
        absl::StrCat(field, ": ", from.size(), " numbers, ", to->size(), " are due"));
  }
  std::copy(from.begin(), from.end(), to->begin());
  return absl::OkStatus();
}

}  // namespace

void ToProto(Vec3d v, v1::Vector3* out) {
  out->set_x(v.x);
  out->set_y(v.y);
  out->set_z(v.z);
}

Vec3d FromProto(const v1::Vector3& proto) { return {proto.x(), proto.y(), proto.z()}; }

Quaternion FromProto(const v1::Turn& proto) {
  const Quaternion turn{proto.w(), proto.x(), proto.y(), proto.z()};
  return std::isfinite(Dot(turn, turn)) ? Normalised(turn) : turn;
}

void ToProto(const Kinematics& kinematics, v1::Kinematics* out) {
  ToProto(kinematics.position_m, out->mutable_position_m());
  out->mutable_turn()->set_w(kinematics.turn.w);
  out->mutable_turn()->set_x(kinematics.turn.x);
  out->mutable_turn()->set_y(kinematics.turn.y);
  out->mutable_turn()->set_z(kinematics.turn.z);
  ToProto(kinematics.velocity_m_per_s, out->mutable_velocity_m_per_s());
  ToProto(kinematics.spin_rad_per_s, out->mutable_spin_rad_per_s());
}

Kinematics FromProto(const v1::Kinematics& proto) {
  return {.position_m = FromProto(proto.position_m()),
          .turn = FromProto(proto.turn()),
          .velocity_m_per_s = FromProto(proto.velocity_m_per_s()),
          .spin_rad_per_s = FromProto(proto.spin_rad_per_s())};
}

void ToProto(const BodyDescription& body, v1::BodyDescription* out) {
  out->set_preset(body.preset);
  out->set_name(body.name);
  out->set_owner(body.owner);
  if (body.colour_rgb) out->set_colour_rgb(*body.colour_rgb);
  if (body.control) out->set_control(static_cast<v1::BodyDescription::Control>(*body.control));
  if (body.radiation) {
    out->set_radiation(static_cast<v1::BodyDescription::Radiation>(*body.radiation));
  }
  if (body.shape) SetShape(*body.shape, true, out->mutable_shape());
  if (body.mass_kg) out->set_mass_kg(*body.mass_kg);
  if (body.centre_of_mass_m) ToProto(*body.centre_of_mass_m, out->mutable_centre_of_mass_m());
  SetNumbers(body.inertia_kg_m2, out->mutable_inertia_kg_m2());
  SetNumbers(body.added_mass, out->mutable_added_mass());
  SetNumbers(body.radiation_damping, out->mutable_radiation_damping());
  SetNumbers(body.viscous_damping, out->mutable_viscous_damping());
  SetNumbers(body.quadratic_damping, out->mutable_quadratic_damping());
  SetForces(body, out);
  for (const Thruster& thruster : body.thrusters) SetThruster(thruster, out->add_thrusters());
  for (const Rudder& rudder : body.rudders) SetRudder(rudder, out->add_rudders());
}

absl::StatusOr<BodyDescription> FromProto(const v1::BodyDescription& proto,
                                          const std::string& folder) {
  BodyDescription body;
  body.preset = proto.preset();
  body.name = proto.name();
  body.owner = proto.owner();
  if (proto.has_colour_rgb()) body.colour_rgb = proto.colour_rgb();
  if (!v1::BodyDescription::Control_IsValid(proto.control()) ||
      !v1::BodyDescription::Radiation_IsValid(proto.radiation())) {
    return absl::InvalidArgumentError("control, radiation: a value that is none of theirs");
  }
  if (proto.control() != 0) body.control = static_cast<BodyControl>(proto.control());
  if (proto.radiation() != 0) body.radiation = static_cast<Radiation>(proto.radiation());
  if (proto.has_shape()) {
    ONESEA_ASSIGN_OR_RETURN(body.shape, ReadShape(proto.shape(), folder));
  }
  // Not `!= 0`: NaN must go on to the validation, which refuses it.
  if (!(proto.mass_kg() == 0.0)) body.mass_kg = proto.mass_kg();
  if (proto.has_centre_of_mass_m()) body.centre_of_mass_m = FromProto(proto.centre_of_mass_m());
  ONESEA_RETURN_IF_ERROR(ReadNumbers("inertia_kg_m2", proto.inertia_kg_m2(), body.inertia_kg_m2));
  ONESEA_RETURN_IF_ERROR(ReadNumbers("added_mass", proto.added_mass(), body.added_mass));
  ONESEA_RETURN_IF_ERROR(
      ReadNumbers("radiation_damping", proto.radiation_damping(), body.radiation_damping));
  ONESEA_RETURN_IF_ERROR(
      ReadNumbers("viscous_damping", proto.viscous_damping(), body.viscous_damping));
  ONESEA_RETURN_IF_ERROR(
      ReadNumbers("quadratic_damping", proto.quadratic_damping(), body.quadratic_damping));
  ReadForces(proto, body);
  for (const v1::Thruster& thruster : proto.thrusters()) {
    body.thrusters.push_back(ReadThruster(thruster));
  }
  for (const v1::Rudder& rudder : proto.rudders()) body.rudders.push_back(ReadRudder(rudder));
  return body;
}

void ToProto(const BodyInfo& info, v1::BodyInfo* out) {
  out->set_id(info.id);
  out->set_name(info.name);
  out->set_owner(info.owner);
  out->set_colour_rgb(info.colour_rgb);
  SetShape(info.shape, false, out->mutable_shape());
  ToProto(info.centre_of_mass_m, out->mutable_centre_of_mass_m());
  out->set_mass_kg(info.mass_kg);
}

absl::StatusOr<BodyInfo> FromProto(const v1::BodyInfo& proto) {
  BodyInfo info;
  info.id = proto.id();
  info.name = proto.name();
  info.owner = proto.owner();
  info.colour_rgb = proto.colour_rgb();
  ONESEA_ASSIGN_OR_RETURN(info.shape, ReadShape(proto.shape(), ""));
  info.centre_of_mass_m = FromProto(proto.centre_of_mass_m());
  info.mass_kg = proto.mass_kg();
  ONESEA_RETURN_IF_ERROR(ValidateBodyInfo(info));
  return info;
}

}  // namespace onesea::wire
