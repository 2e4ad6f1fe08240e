#include "common/wire/world_encoder.h"

#include <algorithm>

#include "common/base/limits.h"

namespace onesea::wire {

WorldEncoder::WorldEncoder(double tick_s, const WorldEncoderOptions& options)
    : options_(options), tiles_(options.tiles), bodies_(tick_s, options.bodies) {}

WorldUpdate WorldEncoder::Encode(const WorldState& state) {
  static const auto& kNone = *new sea::InteractionSnapshot();
  const sea::InteractionSnapshot& snapshot =
      state.interaction != nullptr ? *state.interaction : kNone;
  NameRegions(snapshot);
  fields_.clear();
  for (std::size_t n = 0; n < regions_.size(); ++n) {
    const bool coarse = regions_[n].cells.cell_m > options_.coarse_cell_m;
    if (coarse && (updates_ + regions_[n].id) % options_.coarse_frames_per_update != 0) {
      fields_.push_back({regions_[n], {}, {}});
    } else {
      fields_.push_back({regions_[n], snapshot.fields[n]->height_m, snapshot.fields[n]->foam});
    }
  }
  ++updates_;
  WorldUpdate update;
  update.tick = tick_ = state.tick;
  update.tiles = tiles_.Encode(fields_);
  update.bodies = bodies_.Encode(state.tick, state.bodies);
  if (water_level_m_ != state.water_level_m) update.water_level_m = state.water_level_m;
  water_level_m_ = state.water_level_m;
  const auto told = std::min<std::size_t>(state.spray.size(), kSprayMax);
  update.spray.assign(state.spray.begin(), state.spray.begin() + told);
  return update;
}

void WorldEncoder::NameRegions(const sea::InteractionSnapshot& snapshot) {
  former_.swap(regions_);
  regions_.clear();
  for (const auto& field : snapshot.fields) {
    auto best = former_.end();
    std::size_t most = 0;
    for (auto former = former_.begin(); former != former_.end(); ++former) {
      if (former->cells.cell_m != field->cells.cell_m) continue;
      const std::size_t shared = sea::Intersection(former->cells, field->cells).cells();
      if (shared <= most) continue;
      most = shared;
      best = former;
    }
    const bool coarse = field->cells.cell_m > options_.coarse_cell_m;
    regions_.push_back({.id = best != former_.end() ? best->id : ++last_id_,
                        .cells = field->cells,
                        .height_step_m = coarse ? options_.coarse_step_m : options_.height_step_m});
    if (best != former_.end()) former_.erase(best);
  }
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
