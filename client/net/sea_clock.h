#pragma once

#include <cstdint>

#include "common/base/sim_time.h"
#include "common/wire/frame.h"

namespace onesea::client {

/// From stamps to the sea time of any moment: time of the stamp's tick + (now - then) * speed.
///
/// Two readings. Exact() is the line that the last stamp draws: what the server's sea is at, as far
/// as we know. Render() is what pictures are made at: the same, but it never goes backwards while
/// the sea runs, for the estimate of the server's clock moves by microseconds and a stamp of a slow
/// server may step back. It waits for the line instead of smoothing towards it. Two exceptions,
/// both exact jumps that the server asked for: a sea that stands still (held, lock-step) is at
/// exactly its tick, on every screen, even if this one had run ahead by the delay of the news; and
/// a sea more than kRestartS behind is another one (the session began anew).
///
/// Pure; one thread.
class SeaClock {
 public:
  static constexpr double kRestartS = 1.0;

  /// A new stamp, or the same one with a better `offset_ns`: the server's clock minus ours.
  /// Pre: IsTickInRange(stamp.tick, tick_rate_hz), stamp.speed is finite, the stamp's time and
  /// `offset_ns` are within 2^61 ns.
  void OnStamp(const wire::Stamp& stamp, int tick_rate_hz, std::int64_t offset_ns);

  bool valid() const { return valid_; }
  double speed() const { return speed_; }
  /// Pre: valid(). Within a century of the stamp, whatever the clocks say.
  SimTime Exact(std::int64_t local_ns) const;
  SimTime Render(std::int64_t local_ns);

 private:
  bool valid_ = false;
  SimTime anchor_;
  std::int64_t anchor_server_ns_ = 0;
  std::int64_t offset_ns_ = 0;
  double speed_ = 0.0;
  bool rendered_ = false;
  SimTime last_rendered_;
};

}  // namespace onesea::client
