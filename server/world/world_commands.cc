// What commands do to the world.

#include <cmath>
#include <numbers>
#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/base/real_math.h"
#include "common/sea/constants.h"
#include "server/world/body_from_wire.h"
#include "server/world/body_presets.h"
#include "server/world/world.h"

namespace onesea::world {
namespace {

absl::Status NoBody(std::uint32_t id) {
  return absl::NotFoundError(absl::StrCat("body_id: there is no body ", id));
}

// A dome of water with a trough around it, as much below the level as above. Its potential energy
// is that share of the explosion's which goes into waves: about a twentieth near the surface, less
// the deeper it lies.
struct Dome {
  double radius_m, volume_m3;
};
Dome DomeOf(double energy_j, double depth_m) {
  constexpr double kWaveShare = 0.05;
  // Of height R/4 in its middle, as (1 - r²/R²)²: energy rho g pi R⁴/160.
  const double rho_g = sea::kWaterDensityKgPerM3 * sea::kGravity;
  const auto radius_of = [&](double wave_energy_j) {
    return std::sqrt(std::sqrt(160.0 * wave_energy_j / (rho_g * std::numbers::pi)));
  };
  const double at_surface_m = radius_of(kWaveShare * energy_j);
  const double fade = real::Exp(-depth_m / at_surface_m);
  const double radius_m = radius_of(kWaveShare * energy_j * fade);
  return {radius_m, std::numbers::pi / 3.0 * radius_m * radius_m * 0.25 * radius_m};
}

}  // namespace

absl::StatusOr<PreparedBody> PrepareBody(wire::BodyDescription given) {
  ONESEA_ASSIGN_OR_RETURN(wire::BodyDescription description, WithPreset(std::move(given)));
  ONESEA_ASSIGN_OR_RETURN(BodySpec spec, FromWire(description));
  PreparedBody body;
  ONESEA_ASSIGN_OR_RETURN(body.model, MakeBodyModel(std::move(spec)));
  body.info = InfoOf(description, *body.model);
  if (!description.shape->mesh.empty()) {
    body.mesh = std::make_shared<const std::string>(std::move(description.shape->mesh));
    description.shape->mesh.clear();
  }
  body.description = std::move(description);
  return body;
}

absl::Status World::Begin(const wire::WorldSpec& spec) {
  levels_ = spec.water_level;
  wind_m_per_s_ = spec.body_wind_m_per_s;
  for (std::size_t n = 0; n < spec.bodies.size(); ++n) {
    const absl::StatusOr<PreparedBody> body = PrepareBody(spec.bodies[n].body);
    if (!body.ok()) {
      return absl::Status(body.status().code(),
                          absl::StrCat("world.bodies[", n, "].body.", body.status().message()));
    }
    ONESEA_RETURN_IF_ERROR(Spawn(*body, spec.bodies[n].start).status());
  }
  for (const wire::RegionSpec& region : spec.regions) {
    ONESEA_RETURN_IF_ERROR(Do(wire::AddRegion{region}).status());
  }
  for (const wire::RopeSpec& rope : spec.ropes) {
    ONESEA_RETURN_IF_ERROR(rigid_.AddRope(rope).status());
  }
  ListRopes();
  Publish(Change::kRegions);
  return absl::OkStatus();
}

// Bodies of one kind share a model: what a step reads of all of them then stays in the caches.
std::shared_ptr<const BodyModel> World::Known(const std::shared_ptr<const BodyModel>& model) const {
  for (const auto& [id, body] : bodies_) {
    if (body.model->spec == model->spec &&
        body.model->density_kg_per_m3 == model->density_kg_per_m3) {
      return body.model;
    }
  }
  return model;
}

absl::StatusOr<std::uint32_t> World::Spawn(const PreparedBody& prepared,
                                           const wire::Kinematics& start) {
  BodyState state = FromWire(start);
  // A start at z = 0 means afloat: here on still water, in the first step on its waves.
  const bool is_to_float = state.pose.centre_m.z == 0.0;
  if (is_to_float) {
    state.pose.centre_m.z =
        LevelAt(TimeOfTick(tick_, options_.tick_rate_hz)) +
        (prepared.model->rest.floats ? prepared.model->rest.centre_height_m : 0.0);
  }
  const std::shared_ptr<const BodyModel> model = Known(prepared.model);
  ONESEA_ASSIGN_OR_RETURN(const BodyId id, rigid_.Add(model, state));
  const auto wire_id = static_cast<std::uint32_t>(id);
  Body& body = bodies_[wire_id];
  body.model = model;
  body.stepped = rigid_.FindBody(id);
  body.mesh = prepared.mesh;
  body.is_to_float = is_to_float;
  body.active_tick = tick_;
  wire::BodyInfo info = prepared.info;
  info.id = wire_id;
  body.info = std::make_shared<const wire::BodyInfo>(std::move(info));
  Publish(Change::kBodies);
  return wire_id;
}

absl::StatusOr<std::uint32_t> World::Apply(const wire::WorldCommand& command) {
  absl::StatusOr<std::uint32_t> id = std::visit(
      [this](const auto& one) -> absl::StatusOr<std::uint32_t> {
        using Command = std::decay_t<decltype(one)>;
        if constexpr (std::is_same_v<Command, wire::SpawnBody>) {
          ONESEA_CHECK(false) << "bodies are spawned by Spawn()";
          return 0;
        } else if constexpr (std::is_same_v<Command, wire::TakeLease> ||
                             std::is_same_v<Command, wire::ReleaseLease>) {
          if (!HasBody(one.body_id)) return NoBody(one.body_id);
          return one.body_id;
        } else {
          return Do(one);
        }
      },
      command);
  const bool regions_changed = std::holds_alternative<wire::AddRegion>(command) ||
                               std::holds_alternative<wire::RemoveRegion>(command);
  if (!id.ok()) return id;
  NoteCommand(command);
  const bool ropes_changed = std::holds_alternative<wire::AddRope>(command) ||
                             std::holds_alternative<wire::RemoveRope>(command) ||
                             std::holds_alternative<wire::RemoveBody>(command);
  if (ropes_changed) ListRopes();
  Publish(regions_changed ? Change::kRegions : Change::kBodies);
  return id;
}

absl::StatusOr<std::uint32_t> World::Do(const wire::RemoveBody& command) {
  const BodyState* state = rigid_.FindState(command.body_id);
  if (state == nullptr) return NoBody(command.body_id);
  LeaveRegionsOf(command.body_id, {state->pose.centre_m.x, state->pose.centre_m.y});
  ONESEA_RETURN_IF_ERROR(rigid_.Remove(command.body_id));
  bodies_.erase(command.body_id);
  return command.body_id;
}

absl::StatusOr<std::uint32_t> World::Do(const wire::DriveBody& command) {
  if (!HasBody(command.body_id)) return NoBody(command.body_id);
  const BodySpec& spec = bodies_[command.body_id].model->spec;
  if (command.throttle.size() > spec.thrusters.size()) {
    return absl::InvalidArgumentError(absl::StrCat("throttle: ", command.throttle.size(),
                                                   " values, but body ", command.body_id, " has ",
                                                   spec.thrusters.size(), " thrusters"));
  }
  DriveCommand drive;
  for (std::size_t n = 0; n < command.throttle.size(); ++n) drive.throttle[n] = command.throttle[n];
  for (std::size_t n = 0; n < std::min(command.rudder.size(), drive.rudder.size()); ++n) {
    drive.rudder[n] = command.rudder[n];
  }
  ONESEA_RETURN_IF_ERROR(rigid_.SetDrive(command.body_id, drive));
  return command.body_id;
}

absl::StatusOr<std::uint32_t> World::Do(const wire::ApplyImpulse& command) {
  const BodyState* state = rigid_.FindState(command.body_id);
  if (state == nullptr) return NoBody(command.body_id);
  const Vec3d place_m = command.position_m.value_or(state->pose.centre_m);
  ONESEA_RETURN_IF_ERROR(rigid_.ApplyImpulse(command.body_id, command.impulse_n_s, place_m));
  return command.body_id;
}

absl::StatusOr<std::uint32_t> World::Do(const wire::Explode& command) {
  const Vec2d place{command.position_m.x, command.position_m.y};
  const Dome dome = DomeOf(command.energy_j, -command.position_m.z);
  // The trough spreads over twice the radius and takes what the dome has.
  if (!layer_.AddSource(place, dome.radius_m, dome.volume_m3) ||
      !layer_.AddSource(place, 2.0 * dome.radius_m, -dome.volume_m3)) {
    return absl::NotFoundError(absl::StrCat("position_m: no region of the interaction layer at ",
                                            place.x, ", ", place.y, "; add one there first"));
  }
  layer_.AddFoam(place, 1.5 * dome.radius_m, 1.0);
  AddPlume({place.x, place.y, LevelAt(TimeOfTick(tick_, options_.tick_rate_hz))}, dome.radius_m,
           dome.volume_m3, spray_);
  return 0;
}

absl::StatusOr<std::uint32_t> World::Do(const wire::SetObstacle& command) {
  std::uint32_t id = command.obstacle_id;
  if (id != 0 && !obstacles_.Contains(id)) {
    return absl::NotFoundError(absl::StrCat("obstacle_id: there is no obstacle ", id));
  }
  if (id == 0 && obstacles_.size() >= kObstaclesMax) {
    return absl::ResourceExhaustedError(
        absl::StrCat("the session has ", kObstaclesMax, " obstacles, the most there can be"));
  }
  if (id == 0) id = next_obstacle_id_++;
  obstacles_.Set(id, command.corners_m);
  return id;
}

absl::StatusOr<std::uint32_t> World::Do(const wire::RemoveObstacle& command) {
  if (obstacles_.Remove(command.obstacle_id)) return command.obstacle_id;
  return absl::NotFoundError(
      absl::StrCat("obstacle_id: there is no obstacle ", command.obstacle_id));
}

absl::StatusOr<std::uint32_t> World::Do(const wire::AddRope& command) {
  ONESEA_ASSIGN_OR_RETURN(const RopeId id, rigid_.AddRope(command.rope));
  return static_cast<std::uint32_t>(id);
}

absl::StatusOr<std::uint32_t> World::Do(const wire::RemoveRope& command) {
  ONESEA_RETURN_IF_ERROR(rigid_.RemoveRope(command.rope_id));
  return command.rope_id;
}

}  // namespace onesea::world
