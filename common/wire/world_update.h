#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "common/base/sim_time.h"
#include "common/base/vec.h"
#include "common/wire/body_encoder.h"
#include "common/wire/tile_codec.h"
#include "common/wire/world_spec.h"

namespace onesea::wire {

/// Water thrown up where a hull slams or crests meet.
struct Spray {
  Vec3d position_m, velocity_m_per_s;
  double mass_kg = 0.0;  ///< (0, 1e6]
  friend bool operator==(const Spray&, const Spray&) = default;
};

/// Shared by all who hold it, so that unchanged ropes cost a comparison of pointers.
using RopeList = std::shared_ptr<const std::vector<TiedRope>>;

/// What one frame says of the interaction layer and of bodies: what changed, or in a keyframe all
/// that there is. The same for every viewer.
struct WorldUpdate {
  Tick tick = 0;  ///< when all of it holds; at most the stamp's
  TileUpdate tiles;
  BodyUpdate bodies;
  std::optional<double> water_level_m;  ///< of the whole sea above the mean; none: as before
  std::vector<Spray> spray;             ///< at most kSprayMax; none in a keyframe
  /// All of them, ids ascending; their bodies may be unknown. Null: as before, or in a keyframe
  /// none.
  RopeList ropes = nullptr;
};

}  // namespace onesea::wire
