#include <cmath>
#include <filesystem>
#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/base/real_math.h"
#include "common/wire/bounds.h"
#include "common/wire/direction.h"
#include "common/wire/proto_body.h"
#include "common/wire/proto_world.h"

namespace onesea::wire {
namespace {

absl::StatusOr<Vec2d> ReadWind(const v1::BodyWind& proto) {
  ONESEA_RETURN_IF_ERROR(CheckReal("world.body_wind.", "speed_m_per_s", proto.speed_m_per_s(), 0.0,
                                   kWindSpeedMaxMPerS));
  ONESEA_ASSIGN_OR_RETURN(const double to_rad,
                          DirectionFromProto(proto.direction(), "world.body_wind.", "direction"));
  const real::SinCosPair to = real::SinCos(to_rad);
  return proto.speed_m_per_s() * Vec2d{to.cos, to.sin};
}

}  // namespace

void ToProto(const RegionSpec& region, v1::RegionSpec* out) {
  out->set_solver(static_cast<v1::SolverKind>(region.solver));
  out->set_x_m(region.middle_m.x);
  out->set_y_m(region.middle_m.y);
  out->set_columns(region.columns);
  out->set_rows(region.rows);
  out->set_cell_m(region.cell_m);
  out->set_follow_body_id(region.follow_body_id);
  out->set_damping_per_s(region.damping_per_s);
  out->set_height_step_m(region.height_step_m);
  out->set_frames_per_update(region.frames_per_update);
  out->set_rain_drops_per_m2_s(region.rain_drops_per_m2_s);
  out->set_rest_after_s(region.rest_after_s);
}

absl::StatusOr<RegionSpec> FromProto(const v1::RegionSpec& proto) {
  RegionSpec region;
  if (!v1::SolverKind_IsValid(proto.solver())) {
    return absl::InvalidArgumentError(
        absl::StrCat("solver: ", static_cast<int>(proto.solver()),
                     " is none of SOLVER_KIND_IWAVE (1), SOLVER_KIND_WAVE_EQUATION (2), "
                     "SOLVER_KIND_SHALLOW_WATER (3)"));
  }
  if (proto.solver() != 0) region.solver = static_cast<RegionSolver>(proto.solver());
  region.middle_m = {proto.x_m(), proto.y_m()};
  if (proto.columns() != 0) region.columns = proto.columns();
  if (proto.rows() != 0) region.rows = proto.rows();
  // Not `!= 0`: NaN must go on to the validation, which refuses it.
  if (!(proto.cell_m() == 0.0)) region.cell_m = proto.cell_m();
  region.follow_body_id = proto.follow_body_id();
  region.damping_per_s = proto.damping_per_s();
  if (region.cell_m > kFarCellM) {
    region.height_step_m = kFarHeightStepM;
    region.frames_per_update = kFarFramesPerUpdate;
  }
  if (proto.has_height_step_m()) region.height_step_m = proto.height_step_m();
  if (proto.frames_per_update() != 0) region.frames_per_update = proto.frames_per_update();
  region.rain_drops_per_m2_s = proto.rain_drops_per_m2_s();
  region.rest_after_s = proto.rest_after_s();
  return region;
}

void ToProto(const RopeSpec& rope, v1::Rope* out) {
  out->mutable_from()->set_body_id(rope.from.body_id);
  ToProto(rope.from.point_m, out->mutable_from()->mutable_point_m());
  out->mutable_to()->set_body_id(rope.to.body_id);
  ToProto(rope.to.point_m, out->mutable_to()->mutable_point_m());
  out->set_length_m(rope.length_m);
  out->set_stiffness_n_per_m(rope.stiffness_n_per_m);
  out->set_damping_n_s_per_m(rope.damping_n_s_per_m);
}

RopeSpec FromProto(const v1::Rope& proto) {
  RopeSpec rope;
  rope.from = {proto.from().body_id(), FromProto(proto.from().point_m())};
  rope.to = {proto.to().body_id(), FromProto(proto.to().point_m())};
  rope.length_m = proto.length_m();
  if (proto.has_stiffness_n_per_m()) rope.stiffness_n_per_m = proto.stiffness_n_per_m();
  if (proto.has_damping_n_s_per_m()) rope.damping_n_s_per_m = proto.damping_n_s_per_m();
  return rope;
}

void ToProto(const WaterLevel& level, v1::WaterLevel* out) {
  out->set_time_s(level.time_s);
  out->set_level_m(level.level_m);
}

WaterLevel FromProto(const v1::WaterLevel& proto) { return {proto.time_s(), proto.level_m()}; }

void ToProto(const TiedRope& rope, v1::TiedRope* out) {
  out->set_id(rope.id);
  ToProto(rope.spec, out->mutable_rope());
}

absl::StatusOr<std::vector<TiedRope>> RopesFromProto(
    const std::string& prefix, const google::protobuf::RepeatedPtrField<v1::TiedRope>& ropes) {
  ONESEA_RETURN_IF_ERROR(
      CheckSize(prefix, "ropes", static_cast<std::size_t>(ropes.size()), kRopesMax));
  std::vector<TiedRope> read;
  std::uint32_t before = 0;
  for (const v1::TiedRope& rope : ropes) {
    const std::string entry = absl::StrCat(prefix, "ropes[", read.size(), "].");
    if (rope.id() <= before) {
      return absl::InvalidArgumentError(
          absl::StrCat(entry, "id: ", rope.id(), " is not above ", before, ", the one before"));
    }
    before = rope.id();
    read.push_back({rope.id(), FromProto(rope.rope())});
    ONESEA_RETURN_IF_ERROR(ValidateRopeSpec(entry + "rope.", read.back().spec));
  }
  return read;
}

void ToProto(const WorldSpec& world, v1::WorldSpec* out) {
  // A path is of one machine; what is read from it has its own message.
  for (const RegionSpec& region : world.regions) ToProto(region, out->add_regions());
  for (const StartBody& body : world.bodies) {
    v1::StartBody* to = out->add_bodies();
    ToProto(body.body, to->mutable_body());
    ToProto(body.start, to->mutable_start());
  }
  for (const WaterLevel& level : world.water_level) ToProto(level, out->add_water_level());
  for (const RopeSpec& rope : world.ropes) ToProto(rope, out->add_ropes());
  if (!world.body_wind_m_per_s) return;
  const Vec2d wind = *world.body_wind_m_per_s;
  out->mutable_body_wind()->set_speed_m_per_s(Norm(wind));
  out->mutable_body_wind()->mutable_direction()->set_to_rad(std::atan2(wind.y, wind.x));
}

absl::StatusOr<WorldSpec> FromProto(const v1::WorldSpec& proto, const std::string& folder) {
  WorldSpec world;
  if (!proto.terrain_path().empty()) {
    if (folder.empty()) {
      return absl::InvalidArgumentError("world.terrain_path: only session files may name files");
    }
    world.terrain_path = (std::filesystem::path(folder) / proto.terrain_path()).string();
  }
  ONESEA_RETURN_IF_ERROR(
      CheckSize("world.", "bodies", static_cast<std::size_t>(proto.bodies_size()), kBodiesMax));
  for (const v1::RegionSpec& region : proto.regions()) {
    ONESEA_ASSIGN_OR_RETURN(RegionSpec read, FromProto(region));
    world.regions.push_back(read);
  }
  for (const v1::StartBody& body : proto.bodies()) {
    ONESEA_ASSIGN_OR_RETURN(BodyDescription read, FromProto(body.body(), folder));
    world.bodies.push_back({std::move(read), FromProto(body.start())});
  }
  for (const v1::WaterLevel& level : proto.water_level()) {
    world.water_level.push_back(FromProto(level));
  }
  for (const v1::Rope& rope : proto.ropes()) world.ropes.push_back(FromProto(rope));
  if (proto.has_body_wind()) {
    ONESEA_ASSIGN_OR_RETURN(world.body_wind_m_per_s, ReadWind(proto.body_wind()));
  }
  return world;
}

}  // namespace onesea::wire
