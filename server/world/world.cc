#include "server/world/world.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/check.h"
#include "common/base/real_math.h"
#include "server/world/body_from_wire.h"
#include "server/world/rain.h"

namespace onesea::world {
namespace {

// How slowly what a body presses on the water follows its true displacement: within a heave of some
// seconds it must not, or the wave that comes back feeds the heave.
constexpr double kPressLagS = 5.0;
// Wakes of hulls: from this speed through the water on they foam, and from the other on fully.
constexpr double kFoamSpeedMPerS = 1.5, kFullFoamSpeedMPerS = 8.0;

// Hulls average over what a coarser sea gets a little wrong (point_query.h).
constexpr int kSeaCoarser = 2;

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
  Publish(Change::kRegions);
}

World::~World() = default;

void World::Step(Tick tick, const std::shared_ptr<const sea::Components>& components) {
  if (bodies_.empty() && regions_.empty()) {
    tick_ = tick;
    past_ = std::make_shared<const sea::InteractionPast>();
    if (!view_->empty()) Publish(Change::kTick);
    return;
  }
  const SimTime start = TimeOfTick(tick_, options_.tick_rate_hz);
  WakeRegions();
  PlaceRegions().IgnoreError();  // a region without water is left out until there is some
  Done(WorldStage::kRegionsPlaced);
  SampleSea(tick_, components);
  Done(WorldStage::kSeaMade);
  water_.Clear();
  for (auto& [id, body] : bodies_) AddWaterUnder(body);
  FillWater();
  Done(WorldStage::kWaterSampled);
  PressBodies();
  HoldObstacles();
  layer_.ForEachForcing(
      [&](RegionForcing& forcing) { RainOn(forcing, components->recipe.seed, tick_, step_s_); });
  Done(WorldStage::kPressed);
  FloatNewBodies();
  FeelTheLayer();
  Done(WorldStage::kLayerFelt);
  Water water(water_);
  rigid_.Step(water, AirAt(components->recipe, start));
  SprayFromBodies();
  NoteActivity();
  Done(WorldStage::kBodiesMoved);
  layer_.Step();
  Done(WorldStage::kRegionsStepped);
  tick_ = tick;
  Publish(Change::kTick);
  KeepPast();
  Done(WorldStage::kPublished);
}

// For queries about the last seconds.
void World::KeepPast() {
  if (tick_ % std::max(1, options_.tick_rate_hz / kPastPerSecond) != 0) return;
  auto past = std::make_shared<sea::InteractionPast>(*past_);
  past->push_back(view_->interaction);
  const auto ticks_max = static_cast<Tick>(kPastS * options_.tick_rate_hz);
  std::size_t bytes = 0;
  auto oldest = past->end();
  while (oldest != past->begin()) {
    const auto& snapshot = *(oldest - 1);
    for (const auto& field : snapshot->fields) bytes += 4 * sizeof(float) * field->cells.cells();
    if (bytes > kPastBytesMax || tick_ - snapshot->tick > ticks_max) break;
    --oldest;
  }
  past->erase(past->begin(), oldest);
  past_ = std::move(past);
}

void World::SampleSea(Tick tick, const std::shared_ptr<const sea::Components>& components) {
  if (components_ != components) {
    components_ = components;
    sea_ = nullptr;
    builder_ = std::make_unique<sea::SnapshotBuilder>(components, options_.transform, kSeaCoarser);
  }
  if (sea_ != nullptr && sea_tick_ == tick) return;  // as SetPoses() left it
  const SimTime time = TimeOfTick(tick, options_.tick_rate_hz);
  sea_tick_ = tick;
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
    const Vec3d centre_m = body.stepped->state.pose.centre_m;
    const Vec2d place{centre_m.x, centre_m.y};
    sea::SurfaceSample sea;
    sea_->Sample({&place, 1}, {&sea, 1});
    sea::InteractionFelt felt;
    layer_.AddFelt({&place, 1}, {&felt, 1});
    rigid_.Raise(id, sea.height_m + felt.height_m, sea.velocity_z_m_per_s).IgnoreError();
  }
}

std::size_t World::AddWaterUnder(const Body& body) {
  const Pose& pose = body.stepped->state.pose;
  const WetHull& hull = body.model->hull;
  const Vec2d centre_m{pose.centre_m.x, pose.centre_m.y};
  if (body.model->spec.radiation == Radiation::kGrid) {
    return water_.Add(
        {.centre_m = centre_m, .half_m = {hull.radius_m(), hull.radius_m()}, .is_in_grid = true});
  }
  // However it rolls or pitches.
  const Vec3d reach = hull.reach_m();
  const Quaternion heading = HeadingOf(pose.turn);
  return water_.Add({.centre_m = centre_m,
                     .half_m = {std::max(reach.x, reach.z), std::max(reach.y, reach.z)},
                     .along = {1.0 - 2.0 * heading.z * heading.z, 2.0 * heading.w * heading.z}});
}

void World::FillWater() {
  const IncidentSea sea{.waves = sea_.get(),
                        .wavenumber_rad_per_m = wavenumbers_,
                        .level_m = LevelAt(TimeOfTick(tick_, options_.tick_rate_hz)),
                        .current_m_per_s = options_.current_m_per_s,
                        .depth_m = options_.depth_m,
                        .terrain = options_.terrain.get()};
  water_.Fill(sea);
}

// The heads that hulls press now, on the water that answered to those before: both of this instant.
// Heads of a step later or earlier would push a hull along its own hollow.
void World::FeelTheLayer() {
  felt_.assign(water_.points_m().size(), {});
  layer_.AddFelt(water_.points_m(), felt_);
  water_.AddInteraction(felt_);
  auto first = felt_.begin();
  std::size_t index = 0;
  for (auto& [id, body] : bodies_) {
    const auto last = first + static_cast<std::ptrdiff_t>(water_.points_m(index++).size());
    if (body.model->spec.control == BodyControl::kByOwner) body.felt.assign(first, last);
    first = last;
  }
}

Air World::AirAt(const sea::Recipe& recipe, SimTime time) const {
  Air air;
  if (wind_m_per_s_) {
    air.wind_m_per_s = {wind_m_per_s_->x, wind_m_per_s_->y, 0.0};
    return air;
  }
  const Vec2d wind = sea::WindAt(recipe, time);
  air.wind_m_per_s = {wind.x, wind.y, 0.0};
  return air;
}

double World::LevelAt(SimTime time) const { return wire::WaterLevelAt(levels_, time); }

void World::PressBodies() {
  std::size_t index = 0;
  for (auto& [id, body] : bodies_) PressBody(body, water_.incident(index++));
}

void World::PressBody(Body& body, const HeightPatch& incident) {
  const BodyState& state = body.stepped->state;
  const double wet_m3 = body.wetness.volume_m3;
  const Vec2d place{state.pose.centre_m.x, state.pose.centre_m.y};
  const BodyModel& model = *body.model;
  const double share = std::min(wet_m3 / model.rest.volume_m3, 1.5);
  body.pressed_share += (share - body.pressed_share) * step_s_ / (kPressLagS + step_s_);
  RegionForcing* forcing = layer_.ForcingAt(place);
  if (forcing == nullptr) {
    // In the next region it presses as one that was just spawned does, and makes no splash.
    body.pressed_share = 0.0;
    return;
  }
  forcing->has_pressure = true;
  if (model.spec.radiation == Radiation::kGrid) {
    AddDisplacedColumns(model.mesh, model.centre_of_mass_m, state.pose, incident, forcing->cells,
                        forcing->pressure_head_m);
  } else if (body.pressed_share > 1e-3) {
    if (body.columns_cell_m != forcing->cells.cell_m) {
      body.columns_cell_m = forcing->cells.cell_m;
      body.columns = ColumnsAtRest(model.mesh, model.centre_of_mass_m, model.rest.centre_height_m,
                                   body.columns_cell_m);
    }
    AddColumns(body.columns, place, HeadingOf(state.pose.turn), forcing->cells,
               forcing->pressure_head_m, body.pressed_share);
  }
  const Vec3d velocity = state.velocity_m_per_s;
  const Vec2d through{velocity.x - options_.current_m_per_s.x,
                      velocity.y - options_.current_m_per_s.y};
  const double speed = std::sqrt(through.x * through.x + through.y * through.y);
  // As often as foam moves, so that it stays the same object in between.
  if (tick_ % kFoamSteps == 0 && speed > kFoamSpeedMPerS && wet_m3 > 0.0) {
    const double strength =
        std::min(1.0, (speed - kFoamSpeedMPerS) / (kFullFoamSpeedMPerS - kFoamSpeedMPerS));
    layer_.AddFoam(place, 0.6 * model.hull.radius_m(), 4.0 * strength * kFoamSteps * step_s_);
  }
}

void World::SprayFromBodies() {
  std::size_t index = 0;
  for (auto& [id, body] : bodies_) {
    const WaterPatch& water = water_.patch(index++);
    const BodyLoads& loads = body.stepped->loads;
    if (body.wetness_known) {
      AddHullSpray(*body.model, body.stepped->state, loads, body.wetness, water, step_s_, spray_);
    }
    body.wetness = {loads.wet.volume_m3, loads.wet.wet_area_m2};
    body.wetness_known = true;
  }
}

// As often as foam is made.
void World::SprayFromCrests(const WorldView& view) {
  if (tick_ % kFoamSteps != 0 || sea_ == nullptr) return;
  const std::size_t first = spray_.size();
  for (const auto& field : view.interaction->fields) {
    AddCrestSpray(*field, kFoamSteps * step_s_, spray_);
  }
  // On top of the rest of the sea.
  for (std::size_t n = first; n < std::min<std::size_t>(spray_.size(), kSprayMax); ++n) {
    const Vec2d place{spray_[n].position_m.x, spray_[n].position_m.y};
    sea::SurfaceSample sample;
    sea_->Sample({&place, 1}, {&sample, 1});
    spray_[n].position_m.z += view.water_level_m + sample.height_m;
  }
}

void World::HoldObstacles() {
  if (obstacles_.empty()) return;
  layer_.ForEachForcing([&](RegionForcing& forcing) {
    if (!forcing.is_read) return;
    const Obstacles::Cells& cells = obstacles_.CellsIn(forcing.cells);
    if (cells.index.empty()) return;
    obstacle_samples_.resize(cells.index.size());
    sea_->Sample(cells.place_m, obstacle_samples_);
    for (std::size_t n = 0; n < cells.index.size(); ++n) {
      forcing.solid[cells.index[n]] = 1.0f;
      // Relative to the level, as all heights of the layer.
      forcing.rest_height_m[cells.index[n]] = -obstacle_samples_[n].height_m;
    }
    forcing.has_solid = true;
  });
}

// After a tick, or after a command between two: then with what it changed.
void World::Publish(Change change) {
  auto view = std::make_shared<WorldView>();
  view->tick = tick_;
  view->water_level_m = LevelAt(TimeOfTick(tick_, options_.tick_rate_hz));
  view->interaction = change == Change::kBodies ? view_->interaction : layer_.Snapshot(tick_);
  view->past = past_;
  view->ropes = ropes_;
  if (change == Change::kTick) {
    SprayFromCrests(*view);
    spray_.resize(std::min<std::size_t>(spray_.size(), kSprayMax));
    view->spray = std::exchange(spray_, {});
  }
  for (const Region& region : layer_.regions()) {
    view->streaming.push_back({region.traits.height_step_m, region.traits.frames_per_update});
  }
  view->bodies.reserve(bodies_.size());
  for (const auto& [id, body] : bodies_) {
    const BodyState& state = body.stepped->state;
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

// After every command that may tie or untie one.
void World::ListRopes() {
  std::vector<wire::TiedRope> ropes;
  for (auto& [id, spec] : rigid_.State().ropes) {
    ropes.push_back({static_cast<std::uint32_t>(id), spec});
  }
  if (ropes_ != nullptr ? ropes == *ropes_ : ropes.empty()) return;
  ropes_ = ropes.empty() ? nullptr
                         : std::make_shared<const std::vector<wire::TiedRope>>(std::move(ropes));
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
    hash.Add(body.mean_m_per_s.x);
    hash.Add(body.mean_m_per_s.y);
    hash.Add(body.active_tick);
  }
  for (const auto& [id, region] : regions_) {
    hash.Add(id);
    hash.Add(region.since_tick);
    hash.Add(static_cast<std::int64_t>(region.resting));
    hash.Add(region.end_tick.value_or(0));
  }
  obstacles_.AddTo(hash);
  return hash.value();
}

}  // namespace onesea::world
