#include "common/wire/proto_update.h"

#include <memory>
#include <utility>

#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/wire/bounds.h"
#include "common/wire/proto_body.h"
#include "common/wire/proto_world.h"

namespace onesea::wire {
namespace {

// Groups of the most cells there can be, each region cutting some at its edges.
constexpr std::size_t kBlobsMax =
    4 * static_cast<std::size_t>(kRegionCellsMax) / (kGroupSide * kGroupSide);
constexpr std::size_t kStatesBytesMax = 128 * static_cast<std::size_t>(kBodiesMax);
constexpr double kSprayMassMaxKg = 1e6;

void SetLayout(const std::vector<RegionLayout>& layout, v1::WorldUpdate::Regions* out) {
  for (const RegionLayout& region : layout) {
    v1::Region* to = out->add_regions();
    to->set_id(region.id);
    to->set_west(region.cells.west);
    to->set_south(region.cells.south);
    to->set_columns(region.cells.columns);
    to->set_rows(region.cells.rows);
    to->set_cell_m(region.cells.cell_m);
    to->set_height_step_m(region.height_step_m);
  }
}

absl::StatusOr<std::vector<RegionLayout>> ReadLayout(const v1::WorldUpdate::Regions& proto) {
  ONESEA_RETURN_IF_ERROR(
      CheckSize("world.", "layout", static_cast<std::size_t>(proto.regions_size()), kRegionsMax));
  std::vector<RegionLayout> layout;
  for (const v1::Region& region : proto.regions()) {
    layout.push_back({.id = region.id(),
                      .cells = {.west = region.west(),
                                .south = region.south(),
                                .columns = region.columns(),
                                .rows = region.rows(),
                                .cell_m = region.cell_m()},
                      .height_step_m = region.height_step_m()});
  }
  ONESEA_RETURN_IF_ERROR(ValidateLayout(layout));
  return layout;
}

absl::StatusOr<BodyUpdate> ReadBodyUpdate(const v1::WorldUpdate& proto) {
  BodyUpdate bodies;
  ONESEA_RETURN_IF_ERROR(CheckSize("world.", "removed_body_ids",
                                   static_cast<std::size_t>(proto.removed_body_ids_size()),
                                   kBodiesMax));
  ONESEA_RETURN_IF_ERROR(
      CheckSize("world.", "bodies", static_cast<std::size_t>(proto.bodies_size()), kBodiesMax));
  ONESEA_RETURN_IF_ERROR(
      CheckSize("world.", "body_states", proto.body_states().size(), kStatesBytesMax));
  bodies.removed_ids.assign(proto.removed_body_ids().begin(), proto.removed_body_ids().end());
  for (const v1::BodyInfo& info : proto.bodies()) {
    ONESEA_ASSIGN_OR_RETURN(BodyInfo read, FromProto(info));
    bodies.infos.push_back(std::make_shared<const BodyInfo>(std::move(read)));
  }
  bodies.states = proto.body_states();
  return bodies;
}

absl::StatusOr<std::vector<Spray>> ReadSpray(const v1::WorldUpdate& proto) {
  ONESEA_RETURN_IF_ERROR(
      CheckSize("world.", "spray", static_cast<std::size_t>(proto.spray_size()), kSprayMax));
  std::vector<Spray> events;
  for (const v1::Spray& spray : proto.spray()) {
    const Spray event{FromProto(spray.position_m()), FromProto(spray.velocity_m_per_s()),
                      spray.mass_kg()};
    const std::string prefix = "world.spray.";
    ONESEA_RETURN_IF_ERROR(
        CheckVector(prefix, "position_m", event.position_m, kQueryCoordinateMaxM));
    ONESEA_RETURN_IF_ERROR(
        CheckVector(prefix, "velocity_m_per_s", event.velocity_m_per_s, kBodySpeedMaxMPerS));
    ONESEA_RETURN_IF_ERROR(CheckReal(prefix, "mass_kg", event.mass_kg, 0.0, kSprayMassMaxKg));
    events.push_back(event);
  }
  return events;
}

}  // namespace

void ToProto(const WorldUpdate& update, v1::WorldUpdate* out) {
  out->set_tick(update.tick);
  if (update.tiles.layout) SetLayout(*update.tiles.layout, out->mutable_layout());
  for (const std::string& blob : update.tiles.blobs) out->add_tile_blobs(blob);
  out->mutable_removed_body_ids()->Assign(update.bodies.removed_ids.begin(),
                                          update.bodies.removed_ids.end());
  for (const auto& info : update.bodies.infos) ToProto(*info, out->add_bodies());
  out->set_body_states(update.bodies.states);
  if (update.water_level_m) out->set_water_level_m(*update.water_level_m);
  for (const Spray& spray : update.spray) {
    v1::Spray* to = out->add_spray();
    ToProto(spray.position_m, to->mutable_position_m());
    ToProto(spray.velocity_m_per_s, to->mutable_velocity_m_per_s());
    to->set_mass_kg(spray.mass_kg);
  }
  if (update.ropes == nullptr) return;
  v1::WorldUpdate::Ropes* const ropes = out->mutable_ropes();  // told even if there are none
  for (const TiedRope& rope : *update.ropes) ToProto(rope, ropes->add_ropes());
}

absl::StatusOr<WorldUpdate> FromProto(const v1::WorldUpdate& proto) {
  WorldUpdate update;
  ONESEA_RETURN_IF_ERROR(CheckInteger("world.", "tick", proto.tick(), -kTickMax, kTickMax));
  update.tick = proto.tick();
  if (proto.has_layout()) {
    ONESEA_ASSIGN_OR_RETURN(update.tiles.layout, ReadLayout(proto.layout()));
  }
  ONESEA_RETURN_IF_ERROR(CheckSize("world.", "tile_blobs",
                                   static_cast<std::size_t>(proto.tile_blobs_size()), kBlobsMax));
  update.tiles.blobs.assign(proto.tile_blobs().begin(), proto.tile_blobs().end());
  ONESEA_ASSIGN_OR_RETURN(update.bodies, ReadBodyUpdate(proto));
  if (proto.has_water_level_m()) {
    ONESEA_RETURN_IF_ERROR(CheckReal("world.", "water_level_m", proto.water_level_m(),
                                     -kWaterLevelMaxM, kWaterLevelMaxM));
    update.water_level_m = proto.water_level_m();
  }
  ONESEA_ASSIGN_OR_RETURN(update.spray, ReadSpray(proto));
  if (proto.has_ropes()) {
    ONESEA_ASSIGN_OR_RETURN(std::vector<TiedRope> ropes,
                            RopesFromProto("world.", proto.ropes().ropes()));
    update.ropes = std::make_shared<const std::vector<TiedRope>>(std::move(ropes));
  }
  return update;
}

}  // namespace onesea::wire
