#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/sea/interaction_field.h"
#include "common/wire/body_encoder.h"
#include "common/wire/tile_encoder.h"
#include "common/wire/world_update.h"

namespace onesea::wire {

/// How a region is streamed.
struct RegionStreaming {
  double height_step_m = 1e-3;
  int frames_per_update = 1;  ///< its tiles go with every so manieth Encode()
  friend bool operator==(const RegionStreaming&, const RegionStreaming&) = default;
};

/// A session's world at one tick, as its streamer sees it.
struct WorldState {
  Tick tick = 0;
  const sea::InteractionSnapshot* interaction = nullptr;  ///< null: no regions
  std::span<const RegionStreaming> streaming = {};        ///< one per region, or none: the defaults
  std::span<const BodyView> bodies;  ///< all bodies, ascending by id; see BodyEncoder
  double water_level_m = 0.0;
  std::span<const Spray> spray;  ///< since the last call; the first kSprayMax are told
  RopeList ropes = nullptr;      ///< another pointer: they changed; null: none
};

struct WorldEncoderOptions {
  TileTolerance tiles;
  BodyTolerance bodies;
};

/// Everything that a stream of frames must remember to say only what changed. One per session, for
/// all viewers; not thread-safe.
///
/// Regions have no names on the server: a region takes over the id, and so the tiles, of the one
/// before that it overlaps most. While nobody watches nothing needs to be encoded: later updates
/// and keyframes count from the last one.
class WorldEncoder {
 public:
  /// `tick_s` is the length of a tick.
  explicit WorldEncoder(double tick_s, const WorldEncoderOptions& options = {});

  /// For receivers that have every update before. Pre: at most kRegionsMax fields that fit
  /// ValidateLayout; bodies as BodyEncoder's.
  WorldUpdate Encode(const WorldState& state);
  /// What those receivers hold now, for a frame that is a keyframe. Any number of times.
  WorldUpdate Keyframe();

 private:
  void NameRegions(const sea::InteractionSnapshot& snapshot,
                   std::span<const RegionStreaming> streaming);

  Tick tick_ = 0;
  std::int64_t updates_ = 0;
  std::optional<double> water_level_m_;
  RopeList ropes_;
  std::uint32_t last_id_ = 0;
  std::vector<RegionLayout> regions_, former_;
  std::vector<TileField> fields_;
  std::map<std::uint32_t, std::shared_ptr<const std::vector<float>>> foams_;  // by region, as sent
  TileEncoder tiles_;
  BodyEncoder bodies_;
};

}  // namespace onesea::wire
