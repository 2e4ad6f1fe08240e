#include "client/app/body_models.h"

#include <cstdint>

#include "absl/strings/match.h"

namespace onesea::client {
namespace {

// sRGB bytes to linear shares, near enough for paint.
std::array<float, 3> PaintOf(std::uint32_t rgb) {
  const auto channel = [&](int shift) {
    const float share = static_cast<float>((rgb >> shift) & 0xffu) / 255.0f;
    return share * share;
  };
  return {channel(16), channel(8), channel(0)};
}

}  // namespace

BodyModels::Model BodyModels::MakeModel(const wire::BodyInfo& info) {
  const wire::BodyShape& shape = info.shape;
  const auto named = [&](const char* word) { return absl::StrContains(info.name, word); };
  switch (shape.kind) {
    case wire::ShapeKind::kBox:
      if (named("boat")) {
        return {render::BoatModel(shape.size_m.x, shape.size_m.y, shape.size_m.z),
                {0, 0, -0.5 * shape.size_m.z}};
      }
      if (named("raft")) return {render::RaftModel(shape.size_m), {}};
      return {render::CrateModel(shape.size_m), {}};
    case wire::ShapeKind::kCylinder:
      if (named("buoy")) return {render::BuoyModel(shape.radius_m, shape.length_m), {}};
      return {render::BarrelModel(shape.radius_m, shape.length_m), {}};
    case wire::ShapeKind::kCapsule:
      return {render::CapsuleModel(shape.radius_m, shape.length_m), {}};
    case wire::ShapeKind::kSphere:
      return {render::BallModel(shape.radius_m), {}};
    default:
      return {};
  }
}

std::vector<render::HullInstance> BodyModels::At(const WorldView& world, SimTime time,
                                                 const std::optional<wire::BodyState>& own) {
  std::vector<render::HullInstance> hulls;
  std::map<std::shared_ptr<const wire::BodyInfo>, Model> kept;
  for (const wire::BodyTable::Body& body : world.bodies()) {
    const auto known = models_.find(body.info);
    const Model& model =
        kept.emplace(body.info, known != models_.end() ? known->second : MakeModel(*body.info))
            .first->second;
    if (model.mesh == nullptr) continue;
    const wire::BodyState state = own && own->id == body.newest.id ? *own : body.At(time);
    render::HullInstance& hull = hulls.emplace_back();
    hull.mesh = model.mesh;
    hull.position_m =
        state.position_m + Rotate(state.turn, model.origin_m - body.info->centre_of_mass_m);
    hull.rotation_wxyz = {state.turn.w, state.turn.x, state.turn.y, state.turn.z};
    hull.colour = PaintOf(body.info->colour_rgb);
  }
  models_ = std::move(kept);
  return hulls;
}

}  // namespace onesea::client
