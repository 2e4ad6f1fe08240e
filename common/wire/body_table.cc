#include "common/wire/body_table.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/wire/bounds.h"

namespace onesea::wire {
namespace {

using Body = BodyTable::Body;

std::vector<Body>::iterator Place(std::vector<Body>& bodies, std::uint32_t id) {
  return std::lower_bound(bodies.begin(), bodies.end(), id,
                          [](const Body& body, std::uint32_t i) { return body.newest.id < i; });
}

absl::Status SetInfo(const std::shared_ptr<const BodyInfo>& info, std::vector<Body>& bodies) {
  if (info == nullptr) return absl::InvalidArgumentError("bodies: an info that says nothing");
  ONESEA_RETURN_IF_ERROR(ValidateBodyInfo(*info));
  const auto place = Place(bodies, info->id);
  if (place != bodies.end() && place->newest.id == info->id) {
    place->info = info;
    return absl::OkStatus();
  }
  ONESEA_RETURN_IF_ERROR(CheckSize("", "bodies", bodies.size() + 1, kBodiesMax));
  Body body;
  body.info = info;
  body.newest.id = info->id;
  bodies.insert(place, std::move(body));
  return absl::OkStatus();
}

}  // namespace

BodyState BodyTable::Body::At(SimTime time) const {
  const double after_s = (time - newest_time).Seconds();
  if (after_s >= 0.0) return Extrapolate(newest, std::min(after_s, kExtrapolationMaxS));
  if (!before) return newest;
  const double span_s = (newest_time - before_time).Seconds();
  const double share = span_s > 0.0 ? (time - before_time).Seconds() / span_s : 1.0;
  if (share <= 0.0) return *before;
  return Interpolate(*before, newest, span_s, share);
}

absl::Status BodyTable::Apply(const BodyUpdate& update, Tick tick, int tick_rate_hz,
                              bool keyframe) {
  ONESEA_ASSIGN_OR_RETURN(const std::vector<SentBody> states, ReadBodies(update.states));
  std::vector<Body> bodies = keyframe ? std::vector<Body>() : bodies_;
  for (const std::uint32_t id : update.removed_ids) {
    const auto place = Place(bodies, id);
    if (place == bodies.end() || place->newest.id != id) {
      return absl::InvalidArgumentError(absl::StrCat("bodies: removed id ", id, " isn't there"));
    }
    bodies.erase(place);
  }
  std::vector<std::uint32_t> fresh;  // an info is followed by its first state in the same frame
  for (const auto& info : update.infos) {
    const std::size_t size = bodies.size();
    ONESEA_RETURN_IF_ERROR(SetInfo(info, bodies));
    if (bodies.size() > size) fresh.push_back(info->id);
  }
  for (const SentBody& sent : states) {
    const auto place = Place(bodies, sent.state.id);
    if (place == bodies.end() || place->newest.id != sent.state.id) {
      return absl::InvalidArgumentError(absl::StrCat("bodies: id ", sent.state.id, " has no info"));
    }
    const bool first = std::erase(fresh, sent.state.id) > 0;
    if (!first) {
      place->before = place->newest;
      place->before_time = place->newest_time;
    }
    place->newest = sent.state;
    place->newest_time = TimeOfTick(tick - sent.age_ticks, tick_rate_hz);
  }
  if (!fresh.empty()) {
    return absl::InvalidArgumentError(absl::StrCat("bodies: id ", fresh[0], " has no state"));
  }
  bodies_ = std::move(bodies);
  return absl::OkStatus();
}

const Body* BodyTable::Find(std::uint32_t id) const {
  const auto place =
      std::lower_bound(bodies_.begin(), bodies_.end(), id,
                       [](const Body& body, std::uint32_t i) { return body.newest.id < i; });
  return place != bodies_.end() && place->newest.id == id ? &*place : nullptr;
}

}  // namespace onesea::wire
