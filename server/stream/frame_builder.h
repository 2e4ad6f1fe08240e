#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "common/wire/frame.h"
#include "common/wire/world_encoder.h"
#include "server/session/session_observer.h"
#include "server/stream/encoded_frame.h"

namespace onesea::server {

/// No audience gets frames at a shorter distance of the server's real time than these (a sea that
/// changes pace, speed or weather is told at once all the same), so fast forward and lock-step do
/// not flood anybody.
inline constexpr std::int64_t kStampSpacingNs = 100'000'000;
/// Three quarters of a streamed period: leaves room for a late tick without losing the next one.
std::int64_t EveryFrameSpacingNs(int stream_rate_hz);

/// Turns the ticks of one session into the frames of one audience: numbers them, encodes each once,
/// and keeps the keyframe of the newest state for newcomers and for those who dropped something.
/// Which ticks are told is said by the session (TickEvent). Times are those in the stamps: there is
/// no clock here. One thread at a time.
class FrameBuilder {
 public:
  explicit FrameBuilder(Audience audience) : audience_(audience) {}

  /// The recipe is new or changed: everybody gets the welcome, as a keyframe.
  void OnWelcome(std::shared_ptr<const wire::Welcome> welcome);
  /// True if newest() is a new frame; without `anybody_watches` there is none, only the state is
  /// kept. Pre: after OnWelcome.
  bool OnTick(const TickEvent& event, bool anybody_watches);
  /// Tells a tick that came too soon after another one; true as in OnTick.
  bool Flush(std::int64_t now_ns);
  /// A last frame with the reason.
  void OnClosed(std::string reason);

  /// Of the newest frame or state; -1 as long as nothing can be told.
  std::int64_t newest_sequence() const { return stamp_.has_value() || farewell_ ? sequence_ : -1; }
  /// For those who have the frame before. Pre: newest_sequence() > 0.
  const FramePtr& newest() const { return newest_; }
  /// Welcome, newest stamp, probes and world under newest_sequence(), which may be a new one: the
  /// world is told to everybody first if it has changed. Encoded on demand, at most once per tick.
  /// Pre: newest_sequence() >= 0.
  const FramePtr& Keyframe();

 private:
  std::int64_t SpacingNs() const;
  void Emit();
  void EncodeWorld(wire::Frame& frame);
  void TakeSpray(const TickEvent& event);
  wire::Frame Keyframed();

  Audience audience_;
  std::shared_ptr<const wire::Welcome> welcome_;
  std::optional<wire::Stamp> stamp_;  // newest
  std::optional<wire::Stamp> told_;   // by the newest frame
  std::optional<wire::ProbeHeights> probes_;
  bool probes_owed_ = false;
  bool held_back_ = false;
  std::optional<std::string> farewell_;
  // Of those who get every frame.
  std::shared_ptr<const world::WorldView> world_;  // newest
  std::optional<wire::WorldEncoder> encoder_;      // what they hold
  bool world_told_ = false;                        // they hold something
  std::vector<wire::Spray> spray_;                 // since the last frame
  std::int64_t sequence_ = 0;
  FramePtr newest_;
  FramePtr keyframe_;  // of the newest state, or null
};

}  // namespace onesea::server
