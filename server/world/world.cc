#include "server/world/world.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/check.h"
#include "common/base/real_math.h"
#include "server/world/body_from_wire.h"

namespace onesea::world {
namespace {

// How slowly what a body presses on the water follows its true displacement: within a heave of some
// seconds it must not, or the wave that comes back feeds the heave.
constexpr double kPressLagS = 5.0;
// Wakes of hulls: from this speed through the water on they foam, and from the other on fully.
constexpr double kFoamSpeedMPerS = 1.5, kFullFoamSpeedMPerS = 8.0;

// Turned about the vertical alone, as the body is.
Quaternion HeadingOf(const Quaternion& turn) {
  const double norm = std::sqrt(turn.w * turn.w + turn.z * turn.z);
  if (!(norm > 1e-9)) return {};
  return {turn.w / norm, 0.0, 0.0, turn.z / norm};
}

}  // namespace

// Hands out the patches that were sampled for this tick, in the order of ids.
class World::Water final : public WaterSource {
 public:
  explicit Water(const BodyWater& sampled) : sampled_(sampled) {}
  const WaterPatch& Around(Vec3d /*centre_m*/, double /*radius_m*/) override {
    return sampled_.patch(next_++);
  }

 private:
  const BodyWater& sampled_;
  std::size_t next_ = 0;
};

World::World(WorldOptions options)
    : options_(std::move(options)),
      step_s_(1.0 / options_.tick_rate_hz),
      rigid_(step_s_, options_.terrain),
      layer_({.step_s = step_s_, .depth_m = options_.depth_m, .terrain = options_.terrain}) {
  Publish();
}

World::~World() = default;

void World::Step(Tick tick, const std::shared_ptr<const sea::Components>& components) {
  if (bodies_.empty() && regions_.empty()) {
    tick_ = tick;
    if (!view_->empty()) Publish();
    return;
  }
  const SimTime start = TimeOfTick(tick_, options_.tick_rate_hz);
  PlaceRegions().IgnoreError();  // a region without water is left out until there is some
  SampleSea(tick_, components);
  FloatNewBodies();
  FillWater();
  Water water(water_);
  rigid_.Step(water, AirAt(components->recipe, start));
  PressBodies();
  HoldObstacles();
  std::vector<sea::InteractionField> heads = PressedHeads();
  layer_.Step();
  tick_ = tick;
  Publish();
  Feel(std::move(heads));
}

// What bodies will feel: the layer, plus what they press on it.
void World::Feel(std::vector<sea::InteractionField> heads) {
  felt_ = *view_->interaction;
  for (sea::InteractionField& head : heads) {
    for (std::shared_ptr<const sea::InteractionField>& field : felt_.fields) {
      if (field->cells != head.cells) continue;
      for (std::size_t n = 0; n < head.height_m.size(); ++n) head.height_m[n] += field->height_m[n];
      field = std::make_shared<const sea::InteractionField>(std::move(head));
      break;
    }
  }
}

absl::Status World::PlaceRegions() {
  std::vector<RegionAsk> asks;
  for (const auto& [id, spec] : regions_) {
    RegionAsk ask{.id = id,
                  .kind = static_cast<SolverKind>(spec.solver),
                  .cell_m = spec.cell_m,
                  .columns = spec.columns,
                  .rows = spec.rows,
                  .centre_m = spec.middle_m};
    if (const BodyState* body = rigid_.FindState(spec.follow_body_id); body != nullptr) {
      ask.centre_m = {body->pose.centre_m.x, body->pose.centre_m.y};
    }
    asks.push_back(ask);
  }
  return layer_.Place(asks);
}

void World::SampleSea(Tick tick, const std::shared_ptr<const sea::Components>& components) {
  if (components_ != components) {
    components_ = components;
    sea_ = nullptr;
    builder_ = std::make_unique<sea::SnapshotBuilder>(components, options_.transform);
  }
  const SimTime time = TimeOfTick(tick, options_.tick_rate_hz);
  sea_ = builder_->At(time, sea::QueryDetail::kVelocity, std::exchange(sea_, nullptr));
  // The means move with the weather only, which takes seconds.
  if (wavenumbers_.empty() || tick % options_.tick_rate_hz == 0 ||
      wavenumbers_.size() != static_cast<std::size_t>(sea_->bands())) {
    wavenumbers_ = sea::BandWavenumbers(*components, time);
  }
}

void World::FloatNewBodies() {
  for (auto& [id, body] : bodies_) {
    if (!std::exchange(body.is_to_float, false)) continue;
    const Vec3d centre_m = rigid_.FindState(id)->pose.centre_m;
    const Vec2d place{centre_m.x, centre_m.y};
    sea::SurfaceSample sea;
    sea_->Sample({&place, 1}, {&sea, 1});
    const double layer_m = sea::SampleInteraction(felt_, place).height_m;
    rigid_.Raise(id, sea.height_m + layer_m, sea.velocity_z_m_per_s).IgnoreError();
  }
}

void World::FillWater() {
  water_.Clear();
  for (const auto& [id, body] : bodies_) {
    const BodyState& state = *rigid_.FindState(id);
    water_.Add({state.pose.centre_m.x, state.pose.centre_m.y}, body.model->hull.radius_m());
  }
  felt_m_.resize(felt_.fields.empty() ? 0 : water_.points_m().size());
  if (!felt_m_.empty()) sea::InteractionHeights(felt_, water_.points_m(), felt_m_);
  const IncidentSea sea{.waves = sea_.get(),
                        .wavenumber_rad_per_m = wavenumbers_,
                        .level_m = LevelAt(TimeOfTick(tick_, options_.tick_rate_hz)),
                        .current_m_per_s = options_.current_m_per_s,
                        .depth_m = options_.depth_m,
                        .terrain = options_.terrain.get()};
  water_.Fill(sea, felt_m_);
}

Air World::AirAt(const sea::Recipe& recipe, SimTime time) const {
  Air air;
  if (wind_m_per_s_) {
    air.wind_m_per_s = {wind_m_per_s_->x, wind_m_per_s_->y, 0.0};
    return air;
  }
  const std::vector<double> weights = sea::WeatherWeights(recipe, time);
  for (std::size_t n = 0; n < weights.size(); ++n) {
    const sea::SeaState& sea = recipe.timeline[n].sea;
    const real::SinCosPair to = real::SinCos(sea.wind_to_rad);
    const double speed = weights[n] * sea.wind_speed_m_per_s;
    air.wind_m_per_s = air.wind_m_per_s + speed * Vec3d{to.cos, to.sin, 0.0};
  }
  return air;
}

double World::LevelAt(SimTime time) const { return wire::WaterLevelAt(levels_, time); }

void World::PressBodies() {
  pressed_.clear();
  std::size_t index = 0;
  for (auto& [id, body] : bodies_) PressBody(id, body, water_.incident(index++));
}

void World::PressBody(std::uint32_t id, Body& body, const HeightPatch& incident) {
  const BodyState& state = *rigid_.FindState(id);
  const BodyLoads& loads = *rigid_.FindLoads(id);
  const Vec2d place{state.pose.centre_m.x, state.pose.centre_m.y};
  const BodyModel& model = *body.model;
  const double share = std::min(loads.wet.volume_m3 / model.rest.volume_m3, 1.5);
  body.pressed_share += (share - body.pressed_share) * step_s_ / (kPressLagS + step_s_);
  RegionForcing* forcing = layer_.ForcingAt(place);
  if (forcing == nullptr) return;
  if (std::find(pressed_.begin(), pressed_.end(), forcing) == pressed_.end()) {
    pressed_.push_back(forcing);
  }
  if (model.spec.radiation == Radiation::kGrid) {
    AddDisplacedColumns(model.mesh, model.centre_of_mass_m, state.pose, incident, forcing->cells,
                        forcing->pressure_head_m);
  } else if (body.pressed_share > 1e-3) {
    const Pose at_rest{{place.x, place.y, model.rest.centre_height_m}, HeadingOf(state.pose.turn)};
    AddDisplacedColumns(model.mesh, model.centre_of_mass_m, at_rest, HeightPatch{}, forcing->cells,
                        forcing->pressure_head_m, body.pressed_share);
  }
  const Vec3d velocity = state.velocity_m_per_s;
  const double speed =
      std::hypot(velocity.x - options_.current_m_per_s.x, velocity.y - options_.current_m_per_s.y);
  if (speed > kFoamSpeedMPerS && loads.wet.volume_m3 > 0.0) {
    const double strength =
        std::min(1.0, (speed - kFoamSpeedMPerS) / (kFullFoamSpeedMPerS - kFoamSpeedMPerS));
    layer_.AddFoam(place, 0.6 * model.hull.radius_m(), 4.0 * strength * step_s_);
  }
}

void World::HoldObstacles() {
  if (obstacles_.empty()) return;
  layer_.ForEachForcing([&](RegionForcing& forcing) {
    const Obstacles::Cells& cells = obstacles_.CellsIn(forcing.cells);
    if (cells.index.empty()) return false;
    obstacle_samples_.resize(cells.index.size());
    sea_->Sample(cells.place_m, obstacle_samples_);
    for (std::size_t n = 0; n < cells.index.size(); ++n) {
      forcing.solid[cells.index[n]] = 1.0f;
      // Relative to the level, as all heights of the layer.
      forcing.rest_height_m[cells.index[n]] = -obstacle_samples_[n].height_m;
    }
    return true;
  });
}

std::vector<sea::InteractionField> World::PressedHeads() const {
  std::vector<sea::InteractionField> heads;
  for (const RegionForcing* forcing : pressed_) {
    sea::InteractionField field;
    field.cells = forcing->cells;
    field.height_m.assign(forcing->pressure_head_m.begin(), forcing->pressure_head_m.end());
    heads.push_back(std::move(field));
  }
  return heads;
}

void World::Publish() {
  auto view = std::make_shared<WorldView>();
  view->tick = tick_;
  view->water_level_m = LevelAt(TimeOfTick(tick_, options_.tick_rate_hz));
  view->interaction = layer_.Snapshot(tick_, true);
  for (const auto& [id, body] : bodies_) {
    const BodyState& state = *rigid_.FindState(id);
    wire::BodyView& out = view->bodies.emplace_back();
    out.state.id = id;
    out.state.position_m = state.pose.centre_m;
    out.state.turn = state.pose.turn;
    out.state.velocity_m_per_s = state.velocity_m_per_s;
    out.state.spin_rad_per_s = state.spin_rad_per_s;
    if (body.model->spec.control == BodyControl::kByOwner) out.state.flags |= wire::kBodyByOwner;
    out.info = body.info;
  }
  view_ = std::move(view);
}

std::shared_ptr<const std::string> World::FindMesh(std::uint64_t hash) const {
  for (const auto& [id, body] : bodies_) {
    if (body.mesh != nullptr && body.info->shape.mesh_hash == hash) return body.mesh;
  }
  return nullptr;
}

std::uint64_t World::Hash() const {
  Hash64 hash;
  hash.Add(tick_);
  hash.Add(rigid_.Hash());
  hash.Add(layer_.Hash());
  for (const auto& [id, body] : bodies_) {
    hash.Add(id);
    hash.Add(body.pressed_share);
  }
  for (const auto& [id, spec] : regions_) hash.Add(id);
  obstacles_.AddTo(hash);
  return hash.value();
}

}  // namespace onesea::world
