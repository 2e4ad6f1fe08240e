#pragma once

#include <cstdint>
#include <memory>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "common/sea/components.h"
#include "common/wire/session_spec.h"
#include "server/world/world.h"

/// The authoritative state of one session as a pure step: no clock, no thread, no network. Same
/// spec, same components and same commands at the same ticks give the same state hash at every
/// tick.
namespace onesea::server {

class Session {
 public:
  /// Pre: `spec` is valid, `components` was built from its recipe and `world` from the spec; null:
  /// an empty one.
  Session(SessionSpec spec, std::shared_ptr<const sea::Components> components,
          std::unique_ptr<world::World> world = nullptr);

  /// Advances by one tick.
  void Step();

  /// Installs components whose recipe is this session's with one more entry, which begins after
  /// tick(). FailedPrecondition if it does not (time went on while they were built).
  absl::Status ChangeWeather(std::shared_ptr<const sea::Components> components);

  Tick tick() const { return tick_; }
  SimTime time() const { return TimeOfTick(tick_, spec_.recipe.tick_rate_hz); }
  const SessionSpec& spec() const {
    return spec_;
  }  ///< as created; the recipe in force is components()->recipe
  const std::shared_ptr<const sea::Components>& components() const { return components_; }

  /// sea::TerrainHash(); 0: no terrain.
  std::uint64_t terrain_hash() const { return terrain_hash_; }

  world::World& world() { return *world_; }
  const world::World& world() const { return *world_; }

  /// Over the tick, the component hash, the timeline's ticks, the terrain and, if there is anything
  /// in it, the world.
  std::uint64_t StateHash() const;

 private:
  SessionSpec spec_;
  std::shared_ptr<const sea::Components> components_;
  std::unique_ptr<world::World> world_;
  std::uint64_t terrain_hash_ = 0;
  Tick tick_ = 0;
};

/// The world that a session begins with: reads the terrain, checks the hulls. InvalidArgument,
/// NotFound for files. Cost: up to seconds for large terrain.
absl::StatusOr<std::unique_ptr<world::World>> MakeWorld(const SessionSpec& spec,
                                                        sea::TransformKind transform);

}  // namespace onesea::server
