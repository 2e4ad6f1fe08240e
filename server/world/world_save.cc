// The whole world at a tick, kept and brought back.

#include "server/world/world.h"

namespace onesea::world {

struct World::Saved {
  Tick tick = 0;
  std::vector<wire::WaterLevel> levels;
  std::optional<Vec2d> wind_m_per_s;
  RigidBodiesState rigid;
  InteractionState layer;
  Obstacles obstacles;
  std::map<std::uint32_t, Body> bodies;
  std::map<std::uint32_t, AskedRegion> regions;
  std::uint32_t next_region_id = 1, next_obstacle_id = 1;
  std::vector<double> wavenumbers;  // held for a second
};

std::shared_ptr<const World::Saved> World::Save() {
  rigid_.Rebuild();
  return std::make_shared<const Saved>(Saved{.tick = tick_,
                                             .levels = levels_,
                                             .wind_m_per_s = wind_m_per_s_,
                                             .rigid = rigid_.State(),
                                             .layer = layer_.State(),
                                             .obstacles = obstacles_,
                                             .bodies = bodies_,
                                             .regions = regions_,
                                             .next_region_id = next_region_id_,
                                             .next_obstacle_id = next_obstacle_id_,
                                             .wavenumbers = wavenumbers_});
}

absl::Status World::Restore(const Saved& saved) {
  ONESEA_RETURN_IF_ERROR(layer_.Restore(saved.layer));
  rigid_.Restore(saved.rigid);
  tick_ = saved.tick;
  levels_ = saved.levels;
  wind_m_per_s_ = saved.wind_m_per_s;
  obstacles_ = saved.obstacles;
  bodies_ = saved.bodies;
  for (auto& [id, body] : bodies_) body.stepped = rigid_.FindBody(id);
  regions_ = saved.regions;
  next_region_id_ = saved.next_region_id;
  next_obstacle_id_ = saved.next_obstacle_id;
  wavenumbers_ = saved.wavenumbers;
  past_ = std::make_shared<const sea::InteractionPast>();
  spray_.clear();
  ListRopes();
  Publish(Change::kRegions);
  return absl::OkStatus();
}

}  // namespace onesea::world
