// Bodies that their owners integrate: poses in, forces of the water out.

#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "server/world/body_from_wire.h"
#include "server/world/world.h"

namespace onesea::world {

absl::StatusOr<std::vector<wire::BodyWrench>> World::SetPoses(
    std::span<const wire::BodyPose> poses,
    const std::shared_ptr<const sea::Components>& components) {
  std::vector<BodyState> states;
  for (std::size_t n = 0; n < poses.size(); ++n) {
    const BodyState& state = states.emplace_back(FromWire(poses[n].state));
    const absl::Status status = rigid_.CheckMotion(poses[n].body_id, state.pose,
                                                   state.velocity_m_per_s, state.spin_rad_per_s);
    if (status.ok()) continue;
    return absl::Status(status.code(), absl::StrCat("poses[", n, "]: ", status.message()));
  }
  SampleSea(tick_, components);
  water_.Clear();
  felt_.clear();
  for (std::size_t n = 0; n < poses.size(); ++n) {
    const std::uint32_t id = poses[n].body_id;
    Body& body = bodies_[id];
    const Vec3d way_m = states[n].pose.centre_m - rigid_.FindState(id)->pose.centre_m;
    body.is_to_float = false;
    body.active_tick = tick_;
    if (Norm(way_m) > body.model->hull.radius_m()) {
      body.pressed_share = 0.0;
      body.felt.clear();
    }
    const absl::Status set =
        rigid_.SetMotion(id, states[n].pose, states[n].velocity_m_per_s, states[n].spin_rad_per_s);
    ONESEA_CHECK(set.ok()) << set.ToString();
    const std::size_t points = water_.points_m(AddWaterUnder(body)).size();
    // As the last step had it: layer and pressing hulls of one instant.
    if (body.felt.size() == points) {
      felt_.insert(felt_.end(), body.felt.begin(), body.felt.end());
    } else {
      felt_.resize(felt_.size() + points);
    }
  }
  FillWater();
  water_.AddInteraction(felt_);
  const Air air = AirAt(components->recipe, TimeOfTick(tick_, options_.tick_rate_hz));
  std::vector<wire::BodyWrench> wrenches(poses.size());
  for (std::size_t n = 0; n < poses.size(); ++n) {
    const std::uint32_t id = poses[n].body_id;
    const HydrodynamicWrench wrench =
        ComputeWrench(*bodies_[id].model, *rigid_.FindState(id), water_.patch(n), air, scratch_);
    wrenches[n] = {.body_id = id, .force_n = wrench.force_n, .torque_n_m = wrench.torque_n_m};
    for (std::size_t m = 0; m < wrenches[n].added_mass.size(); ++m) {
      wrenches[n].added_mass[m] = wrench.added_mass[m / 6][m % 6];
    }
  }
  return wrenches;
}

}  // namespace onesea::world
