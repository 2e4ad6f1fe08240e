#include "client/model/local_world.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"

namespace onesea::client {

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
  if (keyframe) next->wakes_.Clear();
  next->wakes_.Add(time, tiles_.fields(), past_);
  if (update.water_level_m) next->water_level_m_ = *update.water_level_m;
  if (keyframe && !update.water_level_m) next->water_level_m_ = 0.0;
  if (keyframe) next->ropes_ = std::make_shared<const std::vector<wire::TiedRope>>();
  if (update.ropes != nullptr) next->ropes_ = update.ropes;
  AddSpray(update.spray);
  view_ = std::move(next);
  current_ = true;
  return absl::OkStatus();
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
