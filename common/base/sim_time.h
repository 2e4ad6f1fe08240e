#pragma once

#include <compare>
#include <cstdint>

namespace onesea {

/// Simulated time as an exact count of flicks, 1 flick = 1 / 705 600 000 s.
///
/// The flick divides every usual rate (24, 25, 30, 50, 60, 64, 90, 100, 120, 144, 1000 Hz, ...), so
/// a tick is a whole number of flicks, a time is never accumulated, and the phase of a wave is one
/// wrapping 64-bit product (see sea/components.h). The range is ±414 years around tick 0.
using Tick = std::int64_t;

inline constexpr std::int64_t kFlicksPerSecond = 705'600'000;

struct SimTime {
  std::int64_t flicks = 0;

  friend auto operator<=>(SimTime a, SimTime b) = default;
  friend SimTime operator+(SimTime a, SimTime b) { return {a.flicks + b.flicks}; }
  friend SimTime operator-(SimTime a, SimTime b) { return {a.flicks - b.flicks}; }

  double Seconds() const {
    return static_cast<double>(flicks) / static_cast<double>(kFlicksPerSecond);
  }
  /// Rounds to the nearest flick (0.7 ns of sea time). Pre: |seconds| < 1e10.
  static SimTime FromSeconds(double seconds);
};

/// A whole number of flicks to a tick? Only such rates are accepted in a recipe.
constexpr bool IsTickRateExact(std::int64_t tick_rate_hz) {
  return tick_rate_hz > 0 && kFlicksPerSecond % tick_rate_hz == 0;
}

/// Pre: IsTickRateExact(tick_rate_hz).
constexpr SimTime TimeOfTick(Tick tick, std::int64_t tick_rate_hz) {
  return {tick * (kFlicksPerSecond / tick_rate_hz)};
}

/// Within the ±100 years that 64 bits of flicks hold with room for sums? A tick from outside must
/// be asked this first.
/// Pre: IsTickRateExact(tick_rate_hz).
constexpr bool IsTickInRange(Tick tick, std::int64_t tick_rate_hz) {
  constexpr std::int64_t kSecondsMax = 3'200'000'000;
  return tick >= -kSecondsMax * tick_rate_hz && tick <= kSecondsMax * tick_rate_hz;
}

/// The last tick at or before `time`.
constexpr Tick TickAtOrBefore(SimTime time, std::int64_t tick_rate_hz) {
  const std::int64_t per_tick = kFlicksPerSecond / tick_rate_hz;
  const std::int64_t quotient = time.flicks / per_tick;
  return quotient - (time.flicks % per_tick < 0 ? 1 : 0);
}

}  // namespace onesea
