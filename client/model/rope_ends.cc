#include "client/model/rope_ends.h"

namespace onesea::client {
namespace {

std::optional<Vec3d> PlaceOf(const wire::RopeEnd& end, const WorldView& world, SimTime time,
                             const std::optional<wire::BodyState>& own) {
  if (end.body_id == 0) return end.point_m;
  const wire::BodyTable::Body* body = world.FindBody(end.body_id);
  if (body == nullptr) return std::nullopt;
  const wire::BodyState state = own && own->id == end.body_id ? *own : body->At(time);
  return state.position_m + Rotate(state.turn, end.point_m - body->info->centre_of_mass_m);
}

}  // namespace

std::vector<RopeNow> RopesAt(const WorldView& world, SimTime time,
                             const std::optional<wire::BodyState>& own) {
  std::vector<RopeNow> ropes;
  for (const wire::TiedRope& rope : world.ropes()) {
    const std::optional<Vec3d> from = PlaceOf(rope.spec.from, world, time, own);
    const std::optional<Vec3d> to = PlaceOf(rope.spec.to, world, time, own);
    if (from && to) ropes.push_back({rope.id, *from, *to, rope.spec.length_m});
  }
  return ropes;
}

}  // namespace onesea::client
