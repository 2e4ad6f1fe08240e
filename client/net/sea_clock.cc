#include "client/net/sea_clock.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/base/limits.h"

namespace onesea::client {

void SeaClock::OnStamp(const wire::Stamp& stamp, int tick_rate_hz, std::int64_t offset_ns) {
  anchor_ = TimeOfTick(stamp.tick, tick_rate_hz);
  anchor_server_ns_ = stamp.server_monotonic_ns;
  speed_ = stamp.speed;
  offset_ns_ = offset_ns;
  valid_ = true;
}

SimTime SeaClock::Exact(std::int64_t local_ns) const {
  ONESEA_CHECK(valid_);
  constexpr double kFlicksPerNs = static_cast<double>(kFlicksPerSecond) * 1e-9;
  // A server whose two clocks disagree by years must not lead out of 64 bits.
  constexpr double kReachFlicks = kQueryTimeMaxS * static_cast<double>(kFlicksPerSecond);
  const std::int64_t since_ns = local_ns + offset_ns_ - anchor_server_ns_;
  const double since_flicks = static_cast<double>(since_ns) * speed_ * kFlicksPerNs;
  return anchor_ + SimTime{std::llround(std::clamp(since_flicks, -kReachFlicks, kReachFlicks))};
}

SimTime SeaClock::Render(std::int64_t local_ns) {
  SimTime time = Exact(local_ns);
  const bool restarted = rendered_ && (last_rendered_ - time).Seconds() > kRestartS;
  if (rendered_ && speed_ != 0.0 && !restarted) time = std::max(time, last_rendered_);
  rendered_ = true;
  last_rendered_ = time;
  return time;
}

}  // namespace onesea::client
