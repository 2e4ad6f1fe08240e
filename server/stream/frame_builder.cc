#include "server/stream/frame_builder.h"

#include <algorithm>
#include <utility>

#include "common/base/check.h"
#include "common/base/limits.h"

namespace onesea::server {

std::int64_t EveryFrameSpacingNs(int stream_rate_hz) {
  return 750'000'000 / static_cast<std::int64_t>(stream_rate_hz);
}

std::int64_t FrameBuilder::SpacingNs() const {
  return audience_ == Audience::kStamps ? kStampSpacingNs
                                        : EveryFrameSpacingNs(welcome_->session.stream_rate_hz);
}

void FrameBuilder::OnWelcome(std::shared_ptr<const wire::Welcome> welcome) {
  const bool first = welcome_ == nullptr;
  welcome_ = std::move(welcome);
  keyframe_.reset();
  if (audience_ == Audience::kEveryFrame && !encoder_) {
    encoder_.emplace(1.0 / welcome_->session.tick_rate_hz);
  }
  if (first || !stamp_.has_value()) return;
  ++sequence_;
  newest_ = Keyframe();
  told_ = stamp_;
  probes_owed_ = held_back_ = false;
}

bool FrameBuilder::OnTick(const TickEvent& event, bool anybody_watches) {
  ONESEA_CHECK(welcome_ != nullptr) << "a tick before the welcome";
  const bool changed =
      !stamp_.has_value() || event.stamp.speed != stamp_->speed || event.stamp.pace != stamp_->pace;
  stamp_ = event.stamp;
  TakeSpray(event);
  world_ = event.world;
  keyframe_.reset();
  if (event.probes != nullptr) {
    probes_ = *event.probes;
    probes_owed_ = true;
  }
  if (!anybody_watches) spray_.clear();
  const bool wanted =
      event.stamp_instant || (audience_ == Audience::kEveryFrame && event.stream_instant);
  if (!wanted || !anybody_watches) return false;
  if (!changed && told_.has_value() &&
      stamp_->server_monotonic_ns - told_->server_monotonic_ns < SpacingNs()) {
    held_back_ = true;
    return false;
  }
  Emit();
  return true;
}

// Of each tick once; a frame tells that of all since the one before.
void FrameBuilder::TakeSpray(const TickEvent& event) {
  const bool new_tick =
      world_ == nullptr || event.world == nullptr || event.world->tick != world_->tick;
  if (audience_ != Audience::kEveryFrame || event.world == nullptr || !new_tick) return;
  const std::vector<wire::Spray>& spray = event.world->spray;
  const std::size_t room = kSprayMax - spray_.size();
  spray_.insert(spray_.end(), spray.begin(),
                spray.begin() + static_cast<std::ptrdiff_t>(std::min(room, spray.size())));
}

bool FrameBuilder::Flush(std::int64_t now_ns) {
  if (!held_back_ || now_ns - told_->server_monotonic_ns < SpacingNs()) return false;
  Emit();
  return true;
}

void FrameBuilder::OnClosed(std::string reason) {
  farewell_ = std::move(reason);
  keyframe_.reset();
  Emit();
}

void FrameBuilder::Emit() {
  wire::Frame frame;
  frame.sequence = ++sequence_;
  frame.stamp = stamp_;
  if (probes_owed_) frame.probes = probes_;
  frame.farewell = farewell_;
  EncodeWorld(frame);
  told_ = stamp_;
  probes_owed_ = held_back_ = false;
  keyframe_.reset();
  newest_ = std::make_shared<EncodedFrame>(EncodedFrame{sequence_, wire::EncodeFrame(frame)});
}

// What changed in the world since the last frame.
void FrameBuilder::EncodeWorld(wire::Frame& frame) {
  if (!encoder_ || world_ == nullptr || (world_->empty() && !world_told_)) return;
  frame.world = encoder_->Encode({.tick = world_->tick,
                                  .interaction = world_->interaction.get(),
                                  .streaming = world_->streaming,
                                  .bodies = world_->bodies,
                                  .water_level_m = world_->water_level_m,
                                  .spray = spray_,
                                  .ropes = world_->ropes});
  spray_.clear();
  world_told_ = true;
}

wire::Frame FrameBuilder::Keyframed() {
  wire::Frame frame;
  frame.sequence = sequence_;
  frame.keyframe = true;
  frame.stamp = stamp_;
  frame.probes = probes_;
  frame.farewell = farewell_;
  if (welcome_ == nullptr) return frame;
  frame.welcome = *welcome_;
  if (world_told_) frame.world = encoder_->Keyframe();
  if (stamp_.has_value()) {
    frame.welcome->session.tick = stamp_->tick;
    frame.welcome->session.pace = stamp_->pace;
    frame.welcome->session.actual_speed = stamp_->actual_speed;
  }
  return frame;
}

const FramePtr& FrameBuilder::Keyframe() {
  // What receivers hold is as old as the last frame, which may be long ago if nobody watched.
  const bool stale = encoder_ && world_ != nullptr && (world_told_ || !world_->empty()) &&
                     stamp_.has_value() && (!told_.has_value() || told_->tick != stamp_->tick);
  if (stale) Emit();
  if (keyframe_ == nullptr) {
    keyframe_ =
        std::make_shared<EncodedFrame>(EncodedFrame{sequence_, wire::EncodeFrame(Keyframed())});
  }
  return keyframe_;
}

}  // namespace onesea::server
