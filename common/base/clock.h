#pragma once

#include <cstdint>

namespace onesea {

/// Real time as an argument: the loop, the clock synchronisation and their tests take one of these.
class Clock {
 public:
  virtual ~Clock() = default;
  /// Monotonic nanoseconds since an arbitrary start.
  virtual std::int64_t MonotonicNs() const = 0;
  /// UTC nanoseconds since 1970-01-01; may step.
  virtual std::int64_t UtcNs() const = 0;
  /// Sleeps until MonotonicNs() >= deadline_ns.
  virtual void SleepUntil(std::int64_t deadline_ns) const = 0;
};

/// The machine's clock. Thread-safe.
const Clock& SystemClock();

}  // namespace onesea
