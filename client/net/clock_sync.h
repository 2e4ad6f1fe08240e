#pragma once

#include <array>
#include <cstdint>

namespace onesea::client {

/// One question "what is your clock?": our clock when it left and when the answer came, theirs in
/// between.
struct ClockExchange {
  std::int64_t sent_ns = 0;
  std::int64_t server_ns = 0;
  std::int64_t received_ns = 0;
};

/// Two quartz clocks of ordinary machines part by no more than this [s/s].
inline constexpr double kClockDriftMax = 50e-6;

/// The server's monotonic clock, from exchanges.
///
/// Problem: an answer says what their clock was at some moment between our two readings; queues
/// make that span long and lopsided. Idea: the span is the error, so keep the exchange of least
/// round trip and put their reading in its middle: then the truth is within half the round trip,
/// whatever the delays were. Averages would only mix worse exchanges in. Clocks drift, so an old
/// exchange loses kClockDriftMax of its age and a fresh one takes over. Limits: a path that is
/// slower in one direction shifts the estimate inside its bound; nobody can see that from here.
///
/// Pure; one thread.
class ClockSync {
 public:
  static constexpr int kWindow = 16;

  /// An exchange that was answered before it was asked is ignored.
  void Add(const ClockExchange& exchange);

  bool synchronised() const { return count_ > 0; }
  std::int64_t count() const { return count_; }

  /// Their clock minus ours, by the best exchange. Pre: synchronised().
  std::int64_t offset_ns() const;
  /// The truth is within this of offset_ns() at `local_ns`. Pre: synchronised().
  std::int64_t ErrorBoundNs(std::int64_t local_ns) const;
  /// Of the best exchange. Pre: synchronised().
  std::int64_t round_trip_ns() const;

 private:
  static std::int64_t BoundNs(const ClockExchange& exchange, std::int64_t local_ns);

  std::array<ClockExchange, kWindow> window_;  // ring: exchange n is at n mod kWindow
  std::int64_t count_ = 0;
  ClockExchange best_;
};

}  // namespace onesea::client
