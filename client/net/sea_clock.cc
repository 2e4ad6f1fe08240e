#include "client/net/sea_clock.h"

#include <algorithm>
#include <cmath>

namespace onesea::client {

void SeaClock::SetStamp(const wire::Stamp& stamp, int tick_rate_hz) {
  stamp_ = stamp;
  tick_rate_hz_ = tick_rate_hz;
}

std::optional<SimTime> SeaClock::Now(std::int64_t now_ns) {
  if (!stamp_ || !offset_ns_) return std::nullopt;
  const std::int64_t since_stamp_ns =
      std::max<std::int64_t>(0, now_ns + *offset_ns_ - stamp_->server_monotonic_ns);
  const double sea_s = 1e-9 * static_cast<double>(since_stamp_ns) * stamp_->speed;
  SimTime time = TimeOfTick(stamp_->tick, tick_rate_hz_) + SimTime::FromSeconds(sea_s);
  if (shown_ && time < *shown_ && *shown_ - time < kRestartJump) time = *shown_;
  shown_ = time;
  return time;
}

}  // namespace onesea::client
