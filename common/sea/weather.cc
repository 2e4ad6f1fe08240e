#include <cmath>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/base/real_math.h"
#include "common/sea/constants.h"
#include "common/sea/recipe.h"

// Problem: the sea must change from one spectrum to another while every wave keeps its phase, with
// no jump in height or velocity, also when the next change is ordered in the middle of one.
// Idea: entry n takes the share sin²θ of the variance from the mix of all earlier entries; that mix
// itself goes on changing underneath, so nothing has to be frozen and every share is smooth.
namespace onesea::sea {
namespace {

// Share that an entry takes from its predecessors: 0 before it starts, 1 from its end on.
double ShareAt(const WeatherEntry& entry, const Recipe& recipe, SimTime time) {
  const SimTime start = TimeOfTick(entry.start_tick, recipe.tick_rate_hz);
  if (time < start) return 0.0;
  const SimTime span = TimeOfTick(entry.span_ticks, recipe.tick_rate_hz);
  // Both differences are exact: |time| and |start| are at most a century.
  const std::int64_t passed = time.flicks - start.flicks;
  if (passed >= span.flicks) return 1.0;
  const double u = static_cast<double>(passed) / static_cast<double>(span.flicks);
  const double s = real::Sin(0.5 * kPi * (u * u * (3.0 - 2.0 * u)));
  return s * s;
}

}  // namespace

void WeatherWeights(const Recipe& recipe, SimTime time, std::span<double> weights) {
  ONESEA_CHECK(weights.size() == recipe.timeline.size());
  if (weights.empty()) return;
  weights[0] = 1.0;
  for (std::size_t n = 1; n < weights.size(); ++n) {
    const double share = ShareAt(recipe.timeline[n], recipe, time);
    for (std::size_t m = 0; m < n; ++m) weights[m] *= 1.0 - share;
    weights[n] = share;
  }
}

std::vector<double> WeatherWeights(const Recipe& recipe, SimTime time) {
  std::vector<double> weights(recipe.timeline.size(), 0.0);
  WeatherWeights(recipe, time, weights);
  return weights;
}

Vec2d WindAt(const Recipe& recipe, SimTime time) {
  const std::vector<double> weights = WeatherWeights(recipe, time);
  double speed = 0.0;
  Vec2d mean;
  for (std::size_t n = 0; n < weights.size(); ++n) {
    const SeaState& sea = recipe.timeline[n].sea;
    const double share = weights[n] * sea.wind_speed_m_per_s;
    const real::SinCosPair to = real::SinCos(sea.wind_to_rad);
    speed += share;
    mean = mean + share * Vec2d{to.cos, to.sin};
  }
  const double length = std::sqrt(mean.x * mean.x + mean.y * mean.y);
  if (!(length > 1e-9 * speed)) return {};
  return (speed / length) * mean;
}

absl::Status AppendWeather(Recipe& recipe, WeatherEntry entry) {
  std::vector<WeatherEntry> timeline = recipe.timeline;
  if (!timeline.empty() && entry.start_tick < timeline.back().start_tick) {
    return absl::InvalidArgumentError(absl::StrCat("start_tick = ", entry.start_tick,
                                                   " lies before the last change, which starts at ",
                                                   timeline.back().start_tick));
  }
  // An entry that had fully taken over an hour before this change hides all earlier ones from then
  // on; who asks for an older past than that gets that entry's sea.
  const Tick horizon = entry.start_tick - std::int64_t{3600} * recipe.tick_rate_hz;
  std::size_t first = 0;
  for (std::size_t n = 1; n < timeline.size(); ++n) {
    if (timeline[n].start_tick + timeline[n].span_ticks <= horizon) first = n;
  }
  timeline.erase(timeline.begin(), timeline.begin() + static_cast<std::ptrdiff_t>(first));
  if (timeline.size() >= kWeatherEntriesMax) {
    return absl::InvalidArgumentError(
        absl::StrCat("timeline: ", timeline.size() + 1, " changes within an hour, the limit is ",
                     kWeatherEntriesMax, ": wait for older ones to end"));
  }
  timeline.push_back(std::move(entry));
  Recipe changed = recipe;
  changed.timeline = std::move(timeline);
  if (absl::Status status = ValidateRecipe(changed); !status.ok()) return status;
  recipe = std::move(changed);
  return absl::OkStatus();
}

}  // namespace onesea::sea
