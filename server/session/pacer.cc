#include "server/session/pacer.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"

namespace onesea::server {

namespace {

// A shorter span holds too few ticks to say anything: just after a change of speed none at all.
constexpr std::int64_t kMeasureMinNs = 250'000'000;

}  // namespace

void Pacer::Anchor(Tick tick, std::int64_t now_ns) {
  anchor_tick_ = tick;
  anchor_ns_ = now_ns;
  measured_tick_ = tick;
  measured_ns_ = now_ns;
  actual_speed_ = speed_;
  keeps_up_ = true;
  debt_max_ns_ = kDebtMaxNs;
}

void Pacer::SetSpeed(double speed, Tick tick, std::int64_t now_ns) {
  ONESEA_CHECK(speed > 0.0);
  ForgiveDebt(tick + 1, now_ns);  // by the limit of the old speed
  // A fraction of the current period has passed; what is left of it passes at the new speed.
  const double left_ns = static_cast<double>(DueNs(tick + 1) - now_ns);
  const std::int64_t tick_done_ns =
      now_ns + std::llround(left_ns * speed_ / speed) -
      std::llround(1e9 / (static_cast<double>(tick_rate_hz_) * speed));
  speed_ = speed;
  Anchor(tick, tick_done_ns);
  measured_ns_ = now_ns;
  debt_max_ns_ = std::max(kDebtMaxNs, now_ns - DueNs(tick + 1));
}

std::int64_t Pacer::DueNs(Tick tick) const {
  const double period_ns = 1e9 / (static_cast<double>(tick_rate_hz_) * speed_);
  return anchor_ns_ + std::llround(static_cast<double>(tick - anchor_tick_) * period_ns);
}

bool Pacer::ForgiveDebt(Tick next_tick, std::int64_t now_ns) {
  const std::int64_t debt_ns = now_ns - DueNs(next_tick);
  const std::int64_t forgiven_ns = debt_ns - debt_max_ns_;
  debt_max_ns_ = std::clamp(debt_ns, kDebtMaxNs, debt_max_ns_);
  if (forgiven_ns <= 0) return false;
  anchor_ns_ += forgiven_ns;
  return true;
}

void Pacer::Measure(Tick tick, std::int64_t now_ns) {
  const std::int64_t span_ns = now_ns - measured_ns_;
  if (span_ns < kMeasureMinNs) return;
  const double sea_s =
      static_cast<double>(tick - measured_tick_) / static_cast<double>(tick_rate_hz_);
  actual_speed_ = sea_s / (static_cast<double>(span_ns) * 1e-9);
  measured_tick_ = tick;
  measured_ns_ = now_ns;
  // Two ticks of slack: a second need not hold a whole number of them.
  const double slack =
      2.0 / static_cast<double>(tick_rate_hz_) / (static_cast<double>(span_ns) * 1e-9);
  if (actual_speed_ + slack < 0.98 * speed_) keeps_up_ = false;
  if (actual_speed_ + slack > 0.995 * speed_) keeps_up_ = true;
}

}  // namespace onesea::server
