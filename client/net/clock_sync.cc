#include "client/net/clock_sync.h"

namespace onesea::client {

void ClockSync::Add(std::int64_t sent_ns, std::int64_t server_ns, std::int64_t received_ns) {
  if (received_ns < sent_ns) return;
  const std::int64_t round_trip_ns = received_ns - sent_ns;
  exchanges_.push_back({server_ns - (sent_ns + round_trip_ns / 2), round_trip_ns, received_ns});
  if (exchanges_.size() > kExchangesMax) exchanges_.pop_front();
  ++exchange_count_;
}

std::optional<ClockEstimate> ClockSync::Estimate(std::int64_t now_ns) const {
  std::optional<ClockEstimate> best;
  for (const Exchange& exchange : exchanges_) {
    const double drift_ns = kDriftMax * static_cast<double>(now_ns - exchange.received_ns);
    const std::int64_t error_ns =
        exchange.round_trip_ns / 2 + static_cast<std::int64_t>(drift_ns > 0 ? drift_ns : 0);
    if (!best || error_ns < best->error_ns) {
      best = {exchange.offset_ns, exchange.round_trip_ns, error_ns};
    }
  }
  return best;
}

}  // namespace onesea::client
