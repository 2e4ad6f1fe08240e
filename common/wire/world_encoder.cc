#include "common/wire/world_encoder.h"

#include <algorithm>

#include "common/base/limits.h"

namespace onesea::wire {

WorldUpdate WorldEncoder::Encode(const WorldState& state) {
  WorldUpdate update;
  update.tick = tick_ = state.tick;
  update.tiles = tiles_.Encode(state.fields);
  update.bodies = bodies_.Encode(state.tick, state.bodies);
  if (water_level_m_ != state.water_level_m) update.water_level_m = state.water_level_m;
  water_level_m_ = state.water_level_m;
  const auto told = std::min<std::size_t>(state.spray.size(), kSprayMax);
  update.spray.assign(state.spray.begin(), state.spray.begin() + told);
  return update;
}

WorldUpdate WorldEncoder::Keyframe() {
  WorldUpdate update;
  update.tick = tick_;
  update.tiles = tiles_.Keyframe();
  update.bodies = bodies_.Keyframe();
  update.water_level_m = water_level_m_;
  return update;
}

}  // namespace onesea::wire
