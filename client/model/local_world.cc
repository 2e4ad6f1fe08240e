#include "client/model/local_world.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"

namespace onesea::client {
namespace {

// Samples are cubic in both directions, with weights whose amounts add to 5/4 at most in each.
constexpr double kSplineGain = 25.0 / 16.0;

// A copy, since the store goes on changing.
std::shared_ptr<const sea::InteractionSnapshot> Snapshot(std::span<const wire::RegionField> fields,
                                                         Tick tick) {
  auto snapshot = std::make_shared<sea::InteractionSnapshot>();
  snapshot->tick = tick;
  for (const wire::RegionField& field : fields) {
    auto copy = std::make_shared<sea::InteractionField>();
    copy->cells = field.layout.cells;
    copy->height_m = field.height_m;
    copy->foam = field.foam;
    snapshot->fields.push_back(std::move(copy));
  }
  return snapshot;
}

// Does the water that one region moves meet the other's? It reaches two cells out.
bool Meet(const sea::CellRect& a, const sea::CellRect& b) {
  const auto overlap = [&](std::int64_t a_low, int a_count, std::int64_t b_low, int b_count) {
    const double a_from = static_cast<double>(a_low - 2) * a.cell_m;
    const double b_from = static_cast<double>(b_low - 2) * b.cell_m;
    return a_from < b_from + (b_count + 4) * b.cell_m && b_from < a_from + (a_count + 4) * a.cell_m;
  };
  return overlap(a.west, a.columns, b.west, b.columns) && overlap(a.south, a.rows, b.south, b.rows);
}

// A cell is within a step of the server's; where regions overlap, heights add.
double HeightErrorBound(std::span<const wire::RegionField> fields) {
  double worst_m = 0.0;
  for (const wire::RegionField& field : fields) {
    double sum_m = 0.0;
    for (const wire::RegionField& other : fields) {
      if (Meet(field.layout.cells, other.layout.cells)) sum_m += other.layout.height_step_m;
    }
    worst_m = std::max(worst_m, sum_m);
  }
  return kSplineGain * worst_m;
}

}  // namespace

WorldView::Moment WorldView::MomentAt(SimTime time) const {
  const auto after = std::find_if(layers_.begin(), layers_.end(),
                                  [&](const Layer& layer) { return time <= layer.time; });
  Moment moment;
  if (after == layers_.end()) {
    const double age_s = (time - layers_.back().time).Seconds();
    moment.strength = std::clamp(2.0 - age_s / kStandsS, 0.0, 1.0);
    if (moment.strength == 0.0) return {};
    moment.before = moment.after = layers_.back().snapshot.get();
    moment.height_error_m = layers_.back().height_error_m;
  } else if (after->time == time) {
    moment.before = moment.after = after->snapshot.get();
    moment.height_error_m = after->height_error_m;
  } else {
    if (after == layers_.begin()) return {};
    const Layer& before = after[-1];
    moment.before = before.snapshot.get();
    moment.after = after->snapshot.get();
    moment.share = (time - before.time).Seconds() / (after->time - before.time).Seconds();
    moment.height_error_m = std::max(before.height_error_m, after->height_error_m);
  }
  const bool is_calm = moment.before->fields.empty() && moment.after->fields.empty();
  return is_calm ? Moment{} : moment;
}

sea::InteractionSample WorldView::SampleAt(const Moment& moment, Vec2d place) {
  if (!moment) return {};
  const sea::InteractionSample before = sea::SampleInteraction(*moment.before, place);
  if (moment.before == moment.after && moment.strength == 1.0) return before;
  const sea::InteractionSample after =
      moment.before == moment.after ? before : sea::SampleInteraction(*moment.after, place);
  const double b = moment.strength * moment.share, a = moment.strength - b;
  sea::InteractionSample between;
  between.height_m = a * before.height_m + b * after.height_m;
  between.slope = a * before.slope + b * after.slope;
  between.foam = a * before.foam + b * after.foam;
  return between;
}

absl::Status LocalWorld::Apply(const wire::Frame& frame, int tick_rate_hz) {
  ONESEA_CHECK(IsTickRateExact(tick_rate_hz));
  absl::MutexLock lock(&mutex_);
  if (!frame.world) {
    if (!frame.keyframe) return absl::OkStatus();
    wire::WorldUpdate nothing;
    nothing.tick = frame.stamp ? frame.stamp->tick : 0;
    nothing.tiles.layout.emplace();
    return ApplyWorld(nothing, true, tick_rate_hz);
  }
  return ApplyWorld(*frame.world, frame.keyframe, tick_rate_hz);
}

absl::Status LocalWorld::ApplyWorld(const wire::WorldUpdate& update, bool keyframe,
                                    int tick_rate_hz) {
  const bool fits = current_ || keyframe;
  current_ = false;
  if (!fits) return absl::FailedPreconditionError("world: a keyframe is needed first");
  if (!IsTickInRange(update.tick, tick_rate_hz)) {
    return absl::InvalidArgumentError(
        absl::StrCat("world.tick: ", update.tick, " is more than a century from tick 0"));
  }
  auto next = std::make_shared<WorldView>(*view_);
  const SimTime time = TimeOfTick(update.tick, tick_rate_hz);
  if (!keyframe && time < next->time()) {
    return absl::InvalidArgumentError(absl::StrCat("world.tick: ", update.tick, " goes back"));
  }
  ONESEA_RETURN_IF_ERROR(tiles_.Apply(update.tiles, keyframe));
  ONESEA_RETURN_IF_ERROR(next->bodies_.Apply(update.bodies, update.tick, tick_rate_hz, keyframe));
  // After a gap nothing is known of the way here.
  if (keyframe) next->layers_.clear();
  const bool is_new = keyframe || update.tiles.layout || !update.tiles.blobs.empty();
  WorldView::Layer layer;
  if (is_new) {
    layer.snapshot = Snapshot(tiles_.fields(), update.tick);
    layer.height_error_m = HeightErrorBound(tiles_.fields());
  } else {
    layer = next->layers_.back();
  }
  layer.time = time;
  AddLayer(std::move(layer), *next);
  if (update.water_level_m) next->water_level_m_ = *update.water_level_m;
  if (keyframe && !update.water_level_m) next->water_level_m_ = 0.0;
  if (keyframe) next->ropes_ = std::make_shared<const std::vector<wire::TiedRope>>();
  if (update.ropes != nullptr) next->ropes_ = update.ropes;
  AddSpray(update.spray);
  view_ = std::move(next);
  current_ = true;
  return absl::OkStatus();
}

void LocalWorld::AddLayer(WorldView::Layer layer, WorldView& view) const {
  const SimTime oldest = layer.time - past_;
  auto& layers = view.layers_;
  // Of an update at the same time the newer one holds.
  if (!layers.empty() && layers.back().time == layer.time) layers.pop_back();
  layers.push_back(std::move(layer));
  // The one before the oldest is the other end of the way to it.
  while (layers.size() > 2 && layers[1].time <= oldest) layers.erase(layers.begin());
}

void LocalWorld::AddSpray(const std::vector<wire::Spray>& spray) {
  spray_.insert(spray_.end(), spray.begin(), spray.end());
  if (spray_.size() > kSprayMax) spray_.erase(spray_.begin(), spray_.end() - kSprayMax);
}

bool LocalWorld::current() const {
  absl::MutexLock lock(&mutex_);
  return current_;
}

std::shared_ptr<const WorldView> LocalWorld::view() const {
  absl::MutexLock lock(&mutex_);
  return view_;
}

std::vector<wire::Spray> LocalWorld::TakeSpray() {
  absl::MutexLock lock(&mutex_);
  return std::exchange(spray_, {});
}

}  // namespace onesea::client
