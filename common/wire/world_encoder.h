#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/wire/body_encoder.h"
#include "common/wire/tile_encoder.h"
#include "common/wire/world_update.h"

namespace onesea::wire {

/// A session's world at one tick, as its streamer sees it. Spans are valid during the call.
struct WorldState {
  Tick tick = 0;
  std::span<const TileField> fields;  ///< all regions; see TileEncoder
  std::span<const BodyView> bodies;   ///< all bodies, ascending by id; see BodyEncoder
  double water_level_m = 0.0;
  std::span<const Spray> spray;  ///< since the last call; the first kSprayMax are told
};

/// Everything that a stream of frames must remember to say only what changed. One per session, for
/// all viewers; not thread-safe.
///
/// Who watches nothing needs no Encode(): later updates and keyframes count from the last one.
class WorldEncoder {
 public:
  /// `tick_s` is the length of a tick.
  explicit WorldEncoder(double tick_s, const TileTolerance& tiles = {},
                        const BodyTolerance& bodies = {})
      : tiles_(tiles), bodies_(tick_s, bodies) {}

  /// For receivers that have every update before. Pre: as the encoders' of tiles and bodies.
  WorldUpdate Encode(const WorldState& state);
  /// What those receivers hold now, for a frame that is a keyframe. Any number of times.
  WorldUpdate Keyframe();

 private:
  Tick tick_ = 0;
  std::optional<double> water_level_m_;
  TileEncoder tiles_;
  BodyEncoder bodies_;
};

}  // namespace onesea::wire
