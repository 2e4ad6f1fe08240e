#include "common/wire/body_encoder.h"

#include <algorithm>
#include <utility>

#include "common/base/check.h"
#include "common/base/limits.h"

namespace onesea::wire {
namespace {

bool AtRest(const BodyState& state) {
  return state.velocity_m_per_s == Vec3d{} && state.spin_rad_per_s == Vec3d{};
}

}  // namespace

const BodyView* FindBody(std::span<const BodyView> bodies, std::uint32_t id) {
  const auto found =
      std::lower_bound(bodies.begin(), bodies.end(), id,
                       [](const BodyView& body, std::uint32_t i) { return body.state.id < i; });
  return found != bodies.end() && found->state.id == id ? &*found : nullptr;
}

BodyEncoder::BodyEncoder(double tick_s, const BodyTolerance& tolerance)
    : tick_s_(tick_s), tolerance_(tolerance) {
  ONESEA_CHECK(tick_s > 0.0 && tolerance.refresh_s > 0.0);
}

const BodyUpdate& BodyEncoder::Encode(Tick tick, std::span<const BodyView> bodies) {
  update_.removed_ids.clear();
  update_.infos.clear();
  update_.states.clear();
  states_.clear();
  next_.clear();
  tick_ = tick;
  auto old = sent_.begin();
  for (const BodyView& body : bodies) {
    const std::uint32_t id = body.state.id;
    ONESEA_CHECK(next_.empty() || next_.back().state.id < id) << "bodies must ascend by id";
    for (; old != sent_.end() && old->state.id < id; ++old) {
      update_.removed_ids.push_back(old->state.id);
    }
    const bool known = old != sent_.end() && old->state.id == id;
    if (!known || old->info != body.info) update_.infos.push_back(body.info);
    if (known && !MustSend(*old, body.state, tick)) {
      next_.push_back(std::move(*old));
      next_.back().info = body.info;
    } else {
      next_.push_back({Quantised(body.state), tick, body.info});
      states_.push_back({next_.back().state, 0});
    }
    if (known) ++old;
  }
  for (; old != sent_.end(); ++old) update_.removed_ids.push_back(old->state.id);
  sent_.swap(next_);
  AppendBodies(states_, update_.states);
  return update_;
}

bool BodyEncoder::MustSend(const Sent& sent, const BodyState& state, Tick tick) const {
  if (state.flags != sent.state.flags) return true;
  const double seconds = static_cast<double>(tick - sent.tick) * tick_s_;
  // A body that receivers believe at rest stays where it is however long they wait.
  if (seconds >= tolerance_.refresh_s && !AtRest(sent.state)) return true;
  const BodyState believed = Extrapolate(sent.state, seconds);
  // Written so that NaN is sent, and found, rather than kept.
  return !(Norm(believed.position_m - state.position_m) <= tolerance_.position_m &&
           AngleBetween(believed.turn, state.turn) <= tolerance_.angle_rad);
}

BodyUpdate BodyEncoder::Keyframe() const {
  BodyUpdate keyframe;
  std::vector<SentBody> states;
  for (const Sent& sent : sent_) {
    keyframe.infos.push_back(sent.info);
    // Bodies at rest may be older than the wire can say, and it doesn't matter.
    states.push_back({sent.state, std::min<Tick>(tick_ - sent.tick, kBodyAgeTicksMax)});
  }
  AppendBodies(states, keyframe.states);
  return keyframe;
}

}  // namespace onesea::wire
