#include "client/app/body_models.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

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

struct Bounds {
  Vec3d low_m, high_m;
};
Bounds BoundsOf(const render::HullMesh& mesh) {
  Bounds bounds{{1e9, 1e9, 1e9}, {-1e9, -1e9, -1e9}};
  for (const render::HullCorner& corner : mesh.corners) {
    const auto [x, y, z] = corner.position_m;
    bounds.low_m = {std::min<double>(bounds.low_m.x, x), std::min<double>(bounds.low_m.y, y),
                    std::min<double>(bounds.low_m.z, z)};
    bounds.high_m = {std::max<double>(bounds.high_m.x, x), std::max<double>(bounds.high_m.y, y),
                     std::max<double>(bounds.high_m.z, z)};
  }
  return bounds;
}

// The hulls of the server's own boats are plain; on them goes what a boat has above the deck. They
// are told from anybody's "boat" by their name and by where their origin is: amidships on the keel.
bool IsPresetBoat(const std::string& name, const Bounds& hull) {
  constexpr double kNearM = 1e-3;
  return absl::StrContains(name, "boat") && std::abs(hull.low_m.z) < kNearM &&
         std::abs(hull.low_m.x + hull.high_m.x) < kNearM &&
         std::abs(hull.low_m.y + hull.high_m.y) < kNearM;
}

}  // namespace

BodyModels::Look BodyModels::LookOf(const wire::BodyInfo& info) {
  for (const auto& [word, look] : {std::pair("boat", Look::kBoat), std::pair("raft", Look::kRaft),
                                   std::pair("buoy", Look::kBuoy)}) {
    if (absl::StrContains(info.name, word)) return look;
  }
  return Look::kPlain;
}

BodyModels::Model BodyModels::MakeModel(const wire::BodyInfo& info, MeshFetcher* meshes) {
  const wire::BodyShape& shape = info.shape;
  const Look look = LookOf(info);
  switch (shape.kind) {
    case wire::ShapeKind::kBox:
      if (look == Look::kBoat) {
        return {look,
                render::BoatModel(shape.size_m.x, shape.size_m.y, shape.size_m.z),
                {0, 0, -0.5 * shape.size_m.z}};
      }
      if (look == Look::kRaft) return {look, render::RaftModel(shape.size_m), {}};
      return {look, render::CrateModel(shape.size_m), {}};
    case wire::ShapeKind::kCylinder:
      if (look == Look::kBuoy) {
        return {look, render::BuoyModel(shape.radius_m, shape.length_m), {}};
      }
      return {look, render::BarrelModel(shape.radius_m, shape.length_m), {}};
    case wire::ShapeKind::kCapsule:
      return {look, render::CapsuleModel(shape.radius_m, shape.length_m), {}};
    case wire::ShapeKind::kSphere:
      return {look, render::BallModel(shape.radius_m), {}};
    case wire::ShapeKind::kMesh: {
      const render::SharedHullMesh mesh =
          meshes != nullptr ? meshes->Find(shape.mesh_hash) : nullptr;
      if (mesh == nullptr) return {look, nullptr, {}};
      const Bounds hull = BoundsOf(*mesh);
      if (!IsPresetBoat(info.name, hull)) return {look, mesh, {}};
      const Vec3d size_m = hull.high_m - hull.low_m;
      return {look, render::BoatModel(size_m.x, size_m.y, size_m.z), {}};
    }
  }
  return {};
}

BodyModels::Model BodyModels::ModelFor(const std::shared_ptr<const wire::BodyInfo>& info,
                                       MeshFetcher* meshes) const {
  const auto known = models_.find(info);
  if (known != models_.end() && known->second.mesh != nullptr) return known->second;
  for (const auto& [other, model] : models_) {
    if (model.mesh != nullptr && model.look == LookOf(*info) && other->shape == info->shape) {
      return model;
    }
  }
  return MakeModel(*info, meshes);
}

std::vector<render::HullInstance> BodyModels::At(const WorldView& world, SimTime time,
                                                 MeshFetcher* meshes,
                                                 const std::optional<wire::BodyState>& own) {
  std::vector<render::HullInstance> hulls;
  for (const wire::BodyTable::Body& body : world.bodies()) {
    const Model model = ModelFor(body.info, meshes);
    models_.insert_or_assign(body.info, model);
    if (model.mesh == nullptr) continue;
    const wire::BodyState state = own && own->id == body.newest.id ? *own : body.At(time);
    render::HullInstance& hull = hulls.emplace_back();
    hull.mesh = model.mesh;
    hull.position_m =
        state.position_m + Rotate(state.turn, model.origin_m - body.info->centre_of_mass_m);
    hull.rotation_wxyz = {state.turn.w, state.turn.x, state.turn.y, state.turn.z};
    hull.colour = PaintOf(body.info->colour_rgb);
  }
  // Infos of bodies that are gone are held by nobody else.
  std::erase_if(models_, [](const auto& entry) { return entry.first.use_count() == 1; });
  return hulls;
}

}  // namespace onesea::client
