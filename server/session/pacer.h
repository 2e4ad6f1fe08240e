#pragma once

#include <cstdint>

#include "common/base/sim_time.h"

/// When ticks are due in real time.
///
/// Problem: a tick every 1/(rate x speed) seconds, for days, exactly; and when the machine can't
/// keep up, neither skipped ticks nor an ever-growing debt that would make it fall behind further
/// once it can. Idea: tick n is due at an anchor plus a multiple; nothing accumulates. A debt up to
/// kDebtMaxNs is worked off at full speed; what exceeds it is forgiven by moving the anchor, so
/// simulated time slows instead, and the caller tells. The
/// ticks that are owed at a change of speed stay owed, however long they last at the new one: sea
/// time doesn't jump there.
namespace onesea::server {

class Pacer {
 public:
  static constexpr std::int64_t kDebtMaxNs = 100'000'000;

  Pacer(int tick_rate_hz, double speed) : tick_rate_hz_(tick_rate_hz), speed_(speed) {}

  /// `tick` is (or was) done at `now_ns`; the next is due one period later. Also forgets the
  /// measured speed.
  void Anchor(Tick tick, std::int64_t now_ns);

  /// Changes the speed at `now_ns`; the sea time of that instant stays, pending debt included.
  void SetSpeed(double speed, Tick tick, std::int64_t now_ns);

  std::int64_t DueNs(Tick tick) const;

  /// Forgives debt above kDebtMaxNs, or above what is left of the debt at a change of speed, for
  /// the next tick; true if it did.
  bool ForgiveDebt(Tick next_tick, std::int64_t now_ns);

  /// Once a second: measures the speed reached since the last call, if that is a quarter of a
  /// second or more ago.
  void Measure(Tick tick, std::int64_t now_ns);
  double speed() const { return speed_; }
  double actual_speed() const { return actual_speed_; }
  /// False from the measurement that finds it below 98 % of the speed until one finds it above 99.5
  /// %.
  bool keeps_up() const { return keeps_up_; }

 private:
  std::int64_t tick_rate_hz_;
  double speed_;
  Tick anchor_tick_ = 0;
  std::int64_t anchor_ns_ = 0;
  std::int64_t debt_max_ns_ = kDebtMaxNs;
  Tick measured_tick_ = 0;
  std::int64_t measured_ns_ = 0;
  double actual_speed_ = 0.0;
  bool keeps_up_ = true;
};

}  // namespace onesea::server
