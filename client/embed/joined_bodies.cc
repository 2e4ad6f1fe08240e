// The part of JoinedSea that is about bodies.

#include <cmath>
#include <numbers>
#include <utility>

#include "absl/strings/str_format.h"
#include "client/embed/joined_sea.h"
#include "client/model/boat_figures.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/base/quaternion.h"

namespace onesea {
namespace {

Quaternion TurnOf(const Body& body) {
  return {body.turn[0], body.turn[1], body.turn[2], body.turn[3]};
}

}  // namespace

void Body::PointOf(double forward_m, double port_m, double up_m, double (&world_m)[3]) const {
  const Vec3d from_centre{forward_m - centre_of_mass_m[0], port_m - centre_of_mass_m[1],
                          up_m - centre_of_mass_m[2]};
  const Vec3d arm = Rotate(TurnOf(*this), from_centre);
  world_m[0] = position_m[0] + arm.x;
  world_m[1] = position_m[1] + arm.y;
  world_m[2] = position_m[2] + arm.z;
}

double Body::HeadingRad() const { return client::HeadingOf(TurnOf(*this)); }

namespace client {
namespace {

void Copy(Vec3d from, double (&to)[3]) {
  to[0] = from.x;
  to[1] = from.y;
  to[2] = from.z;
}

Body BodyAt(const wire::BodyTable::Body& known, SimTime time) {
  const wire::BodyState state = known.At(time);
  Body body;
  body.id = state.id;
  body.name = known.info->name;
  body.owner = known.info->owner;
  Copy(state.position_m, body.position_m);
  body.turn[0] = state.turn.w;
  body.turn[1] = state.turn.x;
  body.turn[2] = state.turn.y;
  body.turn[3] = state.turn.z;
  Copy(state.velocity_m_per_s, body.velocity_m_per_s);
  Copy(state.spin_rad_per_s, body.spin_rad_per_s);
  Copy(known.info->centre_of_mass_m, body.centre_of_mass_m);
  body.mass_kg = known.info->mass_kg;
  return body;
}

}  // namespace

std::vector<Body> JoinedSea::Bodies() const { return BodiesAt(session_.Now().render); }

std::vector<Body> JoinedSea::Bodies(double time_s) const {
  if (!IsTime(time_s)) return {};
  return BodiesAt(SimTime::FromSeconds(time_s));
}

std::vector<Body> JoinedSea::BodiesAt(SimTime time) const {
  const std::shared_ptr<const WorldView> world = session_.world().view();
  std::vector<Body> bodies;
  bodies.reserve(world->bodies().size());
  for (const wire::BodyTable::Body& body : world->bodies()) bodies.push_back(BodyAt(body, time));
  return bodies;
}

std::optional<Body> JoinedSea::FindBody(std::uint32_t id) const {
  const std::shared_ptr<const WorldView> world = session_.world().view();
  const wire::BodyTable::Body* const body = world->FindBody(id);
  if (body == nullptr) return std::nullopt;
  return BodyAt(*body, session_.Now().render);
}

absl::StatusOr<std::unique_ptr<OwnBody>> JoinedSea::Spawn(const SpawnOptions& options) {
  ONESEA_RETURN_IF_ERROR(status());
  if (!IsPlace(options.x_m, options.y_m) || !std::isfinite(options.heading_rad)) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "place (%g, %g) must be in [-%g, %g] and heading_rad, %g, finite", options.x_m, options.y_m,
        kQueryCoordinateMaxM, kQueryCoordinateMaxM, options.heading_rad));
  }
  wire::SpawnBody spawn;
  spawn.body.preset = options.preset;
  spawn.body.name = options.name;
  spawn.body.owner = owner_;
  spawn.start.position_m = {options.x_m, options.y_m, 0.0};  // afloat
  spawn.start.turn =
      TurnBy({0.0, 0.0, std::remainder(options.heading_rad, 2.0 * std::numbers::pi)});
  ONESEA_RETURN_IF_ERROR(Validate(spawn));
  return fleet_.Spawn(std::move(spawn), options.wake);
}

absl::StatusOr<std::unique_ptr<OwnBody>> JoinedSea::Take(std::uint32_t id) {
  ONESEA_RETURN_IF_ERROR(status());
  ONESEA_RETURN_IF_ERROR(Validate(wire::TakeLease{.body_id = id, .holder = owner_}));
  return fleet_.Take(id, owner_);
}

absl::Status JoinedSea::Validate(const wire::WorldCommand& command) const {
  return wire::ValidateCommand(
      {.session = session_name_, .request_id = "0", .tick = std::nullopt, .lease = ""}, command);
}

}  // namespace client
}  // namespace onesea
