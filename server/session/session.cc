#include "server/session/session.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/hash.h"
#include "common/ingest/terrain_file.h"

namespace onesea::server {

namespace {

world::WorldOptions OptionsFor(const SessionSpec& spec, sea::TransformKind transform) {
  return {.tick_rate_hz = spec.recipe.tick_rate_hz,
          .depth_m = spec.recipe.depth_m,
          .current_m_per_s = spec.recipe.current_m_per_s,
          .terrain = nullptr,
          .transform = transform};
}

}  // namespace

Session::Session(SessionSpec spec, std::shared_ptr<const sea::Components> components,
                 std::unique_ptr<world::World> world)
    : spec_(std::move(spec)), components_(std::move(components)), world_(std::move(world)) {
  ONESEA_CHECK(components_ != nullptr);
  ONESEA_CHECK(components_->recipe == spec_.recipe);
  if (world_ == nullptr) {
    world_ = std::make_unique<world::World>(OptionsFor(spec_, sea::TransformKind::kOwn));
  }
  if (world_->terrain() != nullptr) terrain_hash_ = sea::TerrainHash(*world_->terrain());
}

absl::StatusOr<std::unique_ptr<world::World>> MakeWorld(const SessionSpec& spec,
                                                        sea::TransformKind transform) {
  world::WorldOptions options = OptionsFor(spec, transform);
  if (!spec.world.terrain_path.empty()) {
    ONESEA_ASSIGN_OR_RETURN(sea::Terrain terrain,
                            ingest::ReadTerrainFile(spec.world.terrain_path, {}));
    options.terrain = std::make_shared<const sea::Terrain>(std::move(terrain));
  }
  auto world = std::make_unique<world::World>(std::move(options));
  ONESEA_RETURN_IF_ERROR(world->Begin(spec.world));
  return world;
}

void Session::Step() {
  ++tick_;
  world_->Step(tick_, components_);
}

absl::Status Session::ChangeWeather(std::shared_ptr<const sea::Components> components) {
  ONESEA_CHECK(components != nullptr && !components->recipe.timeline.empty());
  const Tick start_tick = components->recipe.timeline.back().start_tick;
  if (start_tick <= tick_) {
    return absl::FailedPreconditionError(
        absl::StrCat("start_tick: ", start_tick, " went by while the sea was built, now is tick ",
                     tick_, "; name a later one or none"));
  }
  components_ = std::move(components);
  return absl::OkStatus();
}

std::uint64_t Session::StateHash() const {
  Hash64 hash;
  hash.Add(tick_);
  hash.Add(components_->hash);
  for (const sea::WeatherEntry& entry : components_->recipe.timeline) {
    hash.Add(entry.start_tick);
    hash.Add(entry.span_ticks);
  }
  if (terrain_hash_ != 0) hash.Add(terrain_hash_);
  if (!world_->view()->empty()) hash.Add(world_->Hash());
  return hash.value();
}

}  // namespace onesea::server
