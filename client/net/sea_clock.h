#pragma once

#include <cstdint>
#include <optional>

#include "common/base/sim_time.h"
#include "common/wire/frame.h"

namespace onesea::client {

/// Sea time on our own clock: the newest stamp, extrapolated at its speed.
///
/// Unset → running (first stamp and clock offset). While running, Now() never goes back by less
/// than kRestartJump: a better clock estimate makes it stand still for some microseconds, and
/// what was shown is never taken back. A step back by more than that is a new session under the
/// old name, and is followed at once. Not thread-safe.
class SeaClock {
 public:
  static constexpr SimTime kRestartJump{2 * kFlicksPerSecond};

  /// `offset_ns`: server's monotonic clock minus ours.
  void SetOffset(std::int64_t offset_ns) { offset_ns_ = offset_ns; }
  void SetStamp(const wire::Stamp& stamp, int tick_rate_hz);

  /// Sea time at `now_ns` of our monotonic clock; nothing before both of the above.
  std::optional<SimTime> Now(std::int64_t now_ns);

  double speed() const { return stamp_ ? stamp_->speed : 0.0; }

 private:
  std::optional<std::int64_t> offset_ns_;
  std::optional<wire::Stamp> stamp_;
  int tick_rate_hz_ = 1;
  std::optional<SimTime> shown_;
};

}  // namespace onesea::client
