#include "server/session/session.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/hash.h"

namespace onesea::server {

Session::Session(SessionSpec spec, std::shared_ptr<const sea::Components> components)
    : spec_(std::move(spec)), components_(std::move(components)) {
  ONESEA_CHECK(components_ != nullptr);
  ONESEA_CHECK(components_->recipe == spec_.recipe);
}

void Session::Step() { ++tick_; }

absl::Status Session::ChangeWeather(std::shared_ptr<const sea::Components> components) {
  ONESEA_CHECK(components != nullptr && !components->recipe.timeline.empty());
  const Tick start_tick = components->recipe.timeline.back().start_tick;
  if (start_tick <= tick_) {
    return absl::FailedPreconditionError(
        absl::StrCat("start_tick: ", start_tick, " went by while the sea was built, now is tick ",
                     tick_, "; name a later one or none"));
  }
  components_ = std::move(components);
  return absl::OkStatus();
}

std::uint64_t Session::StateHash() const {
  Hash64 hash;
  hash.Add(tick_);
  hash.Add(components_->hash);
  for (const sea::WeatherEntry& entry : components_->recipe.timeline) {
    hash.Add(entry.start_tick);
    hash.Add(entry.span_ticks);
  }
  return hash.value();
}

}  // namespace onesea::server
