#include "client/model/local_world.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"

namespace onesea::client {
namespace {

using Fields = WorldView::Fields;

// Bilinear over the lattice; cells beyond the region count as 0.
double Sample(const sea::CellRect& cells, const std::vector<float>& values, Vec2d place) {
  const double x = place.x / cells.cell_m, y = place.y / cells.cell_m;
  // Before the conversion to integers, which far places would overflow.
  if (!(x > static_cast<double>(cells.west - 1) && x < static_cast<double>(cells.east()) &&
        y > static_cast<double>(cells.south - 1) && y < static_cast<double>(cells.north()))) {
    return 0.0;
  }
  const double floor_x = std::floor(x), floor_y = std::floor(y);
  const double u = x - floor_x, v = y - floor_y;
  const auto i = static_cast<std::int64_t>(floor_x), j = static_cast<std::int64_t>(floor_y);
  const auto at = [&](std::int64_t column, std::int64_t row) {
    if (!cells.Contains(column, row)) return 0.0;
    const std::int64_t n = (row - cells.south) * cells.columns + column - cells.west;
    return static_cast<double>(values[static_cast<std::size_t>(n)]);
  };
  return (1.0 - v) * ((1.0 - u) * at(i, j) + u * at(i + 1, j)) +
         v * ((1.0 - u) * at(i, j + 1) + u * at(i + 1, j + 1));
}

double SumOfHeights(const Fields& fields, Vec2d place) {
  double height_m = 0.0;
  for (const wire::RegionField& field : fields) {
    height_m += Sample(field.layout.cells, field.height_m, place);
  }
  return height_m;
}

}  // namespace

double WorldView::HeightAt(Vec2d place, SimTime time) const {
  const double newest_m = SumOfHeights(*fields_, place);
  if (time >= time_ || before_ == fields_) return newest_m;
  const double span_s = (time_ - before_time_).Seconds();
  const double share = std::max((time - before_time_).Seconds() / span_s, 0.0);
  return (1.0 - share) * SumOfHeights(*before_, place) + share * newest_m;
}

double WorldView::FoamAt(Vec2d place) const {
  double foam = 0.0;
  for (const wire::RegionField& field : *fields_) {
    foam = std::max(foam, Sample(field.layout.cells, field.foam, place));
  }
  return foam;
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
  if (!keyframe && time < next->time_) {
    return absl::InvalidArgumentError(absl::StrCat("world.tick: ", update.tick, " goes back"));
  }
  ONESEA_RETURN_IF_ERROR(tiles_.Apply(update.tiles, keyframe));
  ONESEA_RETURN_IF_ERROR(next->bodies_.Apply(update.bodies, update.tick, tick_rate_hz, keyframe));
  next->before_time_ = next->time_;
  next->time_ = time;
  next->before_ = next->fields_;
  if (keyframe || update.tiles.layout || !update.tiles.blobs.empty()) {
    next->fields_ = std::make_shared<const Fields>(tiles_.fields().begin(), tiles_.fields().end());
  }
  // After a gap nothing is known of the way here.
  if (keyframe) next->before_ = next->fields_;
  if (update.water_level_m) next->water_level_m_ = *update.water_level_m;
  if (keyframe && !update.water_level_m) next->water_level_m_ = 0.0;
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
