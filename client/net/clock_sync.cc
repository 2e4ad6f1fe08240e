#include "client/net/clock_sync.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"

namespace onesea::client {

std::int64_t ClockSync::BoundNs(const ClockExchange& exchange, std::int64_t local_ns) {
  const std::int64_t half_ns = (exchange.received_ns - exchange.sent_ns + 1) / 2;
  const std::int64_t age_ns = std::max<std::int64_t>(0, local_ns - exchange.received_ns);
  return half_ns + std::llround(kClockDriftMax * static_cast<double>(age_ns));
}

void ClockSync::Add(const ClockExchange& exchange) {
  if (exchange.received_ns < exchange.sent_ns) return;
  window_[count_ % kWindow] = exchange;
  ++count_;
  best_ = exchange;
  const int held = static_cast<int>(std::min<std::int64_t>(count_, kWindow));
  for (int n = 0; n < held; ++n) {
    const std::int64_t now_ns = exchange.received_ns;
    if (BoundNs(window_[n], now_ns) < BoundNs(best_, now_ns)) best_ = window_[n];
  }
}

std::int64_t ClockSync::offset_ns() const {
  ONESEA_CHECK(synchronised());
  return best_.server_ns - (best_.sent_ns + (best_.received_ns - best_.sent_ns) / 2);
}

std::int64_t ClockSync::ErrorBoundNs(std::int64_t local_ns) const {
  ONESEA_CHECK(synchronised());
  return BoundNs(best_, local_ns);
}

std::int64_t ClockSync::round_trip_ns() const {
  ONESEA_CHECK(synchronised());
  return best_.received_ns - best_.sent_ns;
}

}  // namespace onesea::client
