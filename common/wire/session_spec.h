#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "common/base/vec.h"
#include "common/sea/recipe.h"
#include "common/wire/world_spec.h"

/// Sessions in the domain's own words; the proto of the same name stops at common/wire.
namespace onesea {

enum class Pace : std::uint8_t { kRealTime = 1, kHeld = 2, kLockStep = 3 };

/// A validated request for a session: every default is filled in.
struct SessionSpec {
  std::string name;               ///< [a-z0-9-]{1,64}
  sea::Recipe recipe;             ///< timeline has one entry at tick 0
  int stream_rate_hz = 30;        ///< divides recipe.tick_rate_hz
  std::int64_t epoch_utc_ns = 0;  ///< UTC of tick 0; 0: when the session is created
  std::optional<double> latitude_deg, longitude_deg;
  Pace pace = Pace::kRealTime;
  double speed = 1.0;  ///< sea seconds per real second
  std::vector<Vec2d> probes_m;
  int lock_step_participants = 1;
  double lock_step_deadline_s = 10.0;
  wire::WorldSpec world;  ///< terrain, regions, bodies, tide
};

/// OK, or InvalidArgument (FailedPrecondition: sea_model_version) with field, value and limit.
absl::Status ValidateSessionSpec(const SessionSpec& spec);

/// Eight places within 400 m of the origin, none on a lattice line of another.
std::vector<Vec2d> DefaultProbes();

/// What the server tells about a session.
struct SessionInfo {
  std::string name;
  Pace pace = Pace::kRealTime;
  double speed = 1.0;
  double actual_speed = 1.0;  ///< reached over the last second
  Tick tick = 0;
  int tick_rate_hz = 60;
  int stream_rate_hz = 30;
  std::int64_t epoch_utc_ns = 0;
  std::optional<double> latitude_deg, longitude_deg;
  int viewer_count = 0;
  double hs_m = 0.0;
  std::uint64_t component_hash = 0;
  std::string sea_name;
  std::vector<Vec2d> probes_m;
  std::string transform;
  std::uint64_t terrain_hash = 0;  ///< sea::TerrainHash(); 0: no terrain
};

}  // namespace onesea
