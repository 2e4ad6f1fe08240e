#pragma once

#include <array>
#include <cstdint>

#include "absl/status/status.h"

namespace onesea::server {

inline constexpr int kCreditMin = 1;
inline constexpr int kCreditMax = 64;  // two seconds of 30 Hz: more would be a backlog again
inline constexpr int kCreditDefault =
    8;  // 0.27 s at 30 Hz: the most that a viewer is shown late after a stall
inline constexpr int kCreditUnlimited = 0;  // WatchStamps: a plain server stream cannot acknowledge
inline constexpr std::int64_t kStallTimeoutNs = 5'000'000'000;

/// Decides what one viewer is sent next. Pure: no transport, no clock, no allocation, one thread.
///
/// Problem: a transport accepts frames long before anybody reads them (10 s of 2 KB frames were
/// measured in kernel and HTTP/2 buffers), so "written" says nothing. Idea: the viewer
/// acknowledges, and only `credit` frames may be unacknowledged; whoever falls behind is not sent a
/// queue but the newest state, as a keyframe that needs nothing before it. A drop shows in the
/// sequence: the next frame is not the one after the last sent.
///
///   state     meaning                                        left by
///   Ready     nothing in flight, credit left                 Next() that sends -> Writing
///   Writing   one write in flight                            OnWritten() -> Ready or Starved
///   Starved   nothing in flight, no credit                   OnAck() -> Ready
///   Ended     End() was called, or stalled too long          never
///
/// In Writing and Starved newer frames only replace what would be sent next. Whoever stays in one
/// of the two for kStallTimeoutNs is ended.
class Subscriber {
 public:
  enum class State : std::uint8_t { kReady, kWriting, kStarved, kEnded };
  enum class Send : std::uint8_t {
    kNothing,   ///< wait
    kFrame,     ///< the newest frame
    kKeyframe,  ///< the shared keyframe of the newest state
  };

  /// `credit` in [kCreditMin, kCreditMax] or kCreditUnlimited.
  Subscriber(int credit, std::int64_t now_ns);

  /// Is this the frame after the last one sent?
  bool Follows(std::int64_t sequence) const {
    return last_sent_ >= 0 && sequence == last_sent_ + 1;
  }
  /// Would Next(newest_sequence) say kKeyframe?
  bool NeedsKeyframe(std::int64_t newest_sequence) const;

  /// What to send, given that the newest frame has `newest_sequence`. Anything but kNothing counts
  /// as sent with that sequence: the caller starts the write. Pre: newest_sequence never falls.
  Send Next(std::int64_t newest_sequence, std::int64_t now_ns);

  /// The write in flight is complete. Pre: state() == kWriting or kEnded.
  void OnWritten(std::int64_t now_ns);

  /// Everything up to `sequence` has been read. InvalidArgument if it was never sent; an old one
  /// changes nothing.
  absl::Status OnAck(std::int64_t sequence, std::int64_t now_ns);

  void End() { state_ = State::kEnded; }

  /// For how long neither the transport nor the viewer took anything; 0 when Ready or Ended.
  std::int64_t StalledNs(std::int64_t now_ns) const;
  bool Stalled(std::int64_t now_ns) const { return StalledNs(now_ns) >= kStallTimeoutNs; }

  State state() const { return state_; }
  int unacknowledged() const { return unacknowledged_; }
  std::int64_t frames_sent() const { return frames_sent_; }
  std::int64_t keyframes_sent() const { return keyframes_sent_; }

 private:
  void Settle(std::int64_t now_ns);

  int credit_;
  State state_ = State::kReady;
  std::int64_t state_since_ns_;
  std::int64_t last_sent_ = -1;
  // Sequences sent and not acknowledged, oldest first, as a ring.
  std::array<std::int64_t, kCreditMax> sent_{};
  int oldest_ = 0;
  int unacknowledged_ = 0;
  std::int64_t frames_sent_ = 0;
  std::int64_t keyframes_sent_ = 0;
};

}  // namespace onesea::server
