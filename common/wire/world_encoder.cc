#include "common/wire/world_encoder.h"

#include <algorithm>

#include "common/base/check.h"
#include "common/base/limits.h"

namespace onesea::wire {

namespace {

RopeList NoRopes() { return std::make_shared<const std::vector<TiedRope>>(); }

}  // namespace

WorldEncoder::WorldEncoder(double tick_s, const WorldEncoderOptions& options)
    : tiles_(options.tiles), bodies_(tick_s, options.bodies) {}

WorldUpdate WorldEncoder::Encode(const WorldState& state) {
  static const auto& kNone = *new sea::InteractionSnapshot();
  const sea::InteractionSnapshot& snapshot =
      state.interaction != nullptr ? *state.interaction : kNone;
  ONESEA_CHECK(state.streaming.empty() || state.streaming.size() == snapshot.fields.size());
  const std::uint32_t known = last_id_;
  NameRegions(snapshot, state.streaming);
  fields_.clear();
  for (std::size_t n = 0; n < regions_.size(); ++n) {
    const int every = state.streaming.empty() ? 1 : state.streaming[n].frames_per_update;
    // Not all of them in the same frame, but a new one at once.
    if (regions_[n].id <= known && (updates_ + regions_[n].id) % every != 0) {
      fields_.push_back({regions_[n], {}, {}});
    } else {
      const sea::InteractionField& field = *snapshot.fields[n];
      std::shared_ptr<const std::vector<float>>& sent = foams_[regions_[n].id];
      const bool is_new = field.foam != nullptr && field.foam != sent;
      sent = field.foam;
      fields_.push_back({regions_[n], field.height_m,
                         is_new ? std::span<const float>(*field.foam) : std::span<const float>()});
    }
  }
  std::erase_if(foams_, [&](const auto& sent) {
    return std::ranges::none_of(regions_, [&](const auto& r) { return r.id == sent.first; });
  });
  ++updates_;
  WorldUpdate update;
  update.tick = tick_ = state.tick;
  update.tiles = tiles_.Encode(fields_);
  update.bodies = bodies_.Encode(state.tick, state.bodies);
  if (water_level_m_ != state.water_level_m) update.water_level_m = state.water_level_m;
  water_level_m_ = state.water_level_m;
  if (ropes_ != state.ropes) update.ropes = state.ropes != nullptr ? state.ropes : NoRopes();
  ropes_ = state.ropes;
  const auto told = std::min<std::size_t>(state.spray.size(), kSprayMax);
  update.spray.assign(state.spray.begin(), state.spray.begin() + told);
  return update;
}

void WorldEncoder::NameRegions(const sea::InteractionSnapshot& snapshot,
                               std::span<const RegionStreaming> streaming) {
  former_.swap(regions_);
  regions_.clear();
  for (const auto& field : snapshot.fields) {
    const RegionStreaming how = streaming.empty() ? RegionStreaming{} : streaming[regions_.size()];
    auto best = former_.end();
    std::size_t most = 0;
    for (auto former = former_.begin(); former != former_.end(); ++former) {
      if (former->cells.cell_m != field->cells.cell_m) continue;
      const std::size_t shared = sea::Intersection(former->cells, field->cells).cells();
      if (shared <= most) continue;
      most = shared;
      best = former;
    }
    regions_.push_back({.id = best != former_.end() ? best->id : ++last_id_,
                        .cells = field->cells,
                        .height_step_m = how.height_step_m});
    if (best != former_.end()) former_.erase(best);
  }
}

WorldUpdate WorldEncoder::Keyframe() {
  WorldUpdate update;
  update.tick = tick_;
  update.tiles = tiles_.Keyframe();
  update.bodies = bodies_.Keyframe();
  update.water_level_m = water_level_m_;
  if (ropes_ != nullptr && !ropes_->empty()) update.ropes = ropes_;
  return update;
}

}  // namespace onesea::wire
