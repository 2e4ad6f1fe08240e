#pragma once

#include <cstdint>
#include <deque>
#include <optional>

/// The server's monotonic clock, estimated from exchanges of messages.
///
/// Problem: a millisecond of clock error is about 2 mm of water, and round trips vary by more than
/// that. Idea: the server's time lies within the round trip, so the exchange of least round trip
/// has the tightest bound, half of it; we keep that one while it is young, since two quartz clocks
/// drift apart by some tens of microseconds a second at worst. Limits: an asymmetric path biases
/// the estimate by up to the stated error, as in every such scheme.
/// Source: F. Cristian, "Probabilistic clock synchronization", Distributed Computing 3, 1989.
namespace onesea::client {

struct ClockEstimate {
  std::int64_t offset_ns = 0;      ///< server's clock minus ours
  std::int64_t round_trip_ns = 0;  ///< of the exchange that it rests on
  std::int64_t error_ns = 0;       ///< bound: half the round trip plus drift since that exchange
};

/// Not thread-safe. All times are of monotonic clocks.
class ClockSync {
 public:
  static constexpr std::size_t kExchangesMax = 64;
  static constexpr double kDriftMax = 50e-6;  ///< of two quartz clocks against each other

  /// Sent at `sent_ns` and answered at `received_ns` by our clock, stamped `server_ns` between.
  /// An exchange that ends before it began is ignored.
  void Add(std::int64_t sent_ns, std::int64_t server_ns, std::int64_t received_ns);

  /// The exchange with the smallest error bound at `now_ns`; nothing before the first.
  std::optional<ClockEstimate> Estimate(std::int64_t now_ns) const;

  std::size_t exchange_count() const { return exchange_count_; }

 private:
  struct Exchange {
    std::int64_t offset_ns;
    std::int64_t round_trip_ns;
    std::int64_t received_ns;
  };
  std::deque<Exchange> exchanges_;
  std::size_t exchange_count_ = 0;
};

}  // namespace onesea::client
