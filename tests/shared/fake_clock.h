#pragma once

#include <atomic>
#include <cstdint>

#include "common/base/clock.h"

namespace onesea {

/// Time that moves only when the test says so; SleepUntil moves it. Thread-safe.
class FakeClock final : public Clock {
 public:
  std::int64_t MonotonicNs() const override { return now_ns_.load(); }
  std::int64_t UtcNs() const override { return kUtcStartNs + now_ns_.load(); }
  void SleepUntil(std::int64_t deadline_ns) const override {
    std::int64_t now_ns = now_ns_.load();
    while (now_ns < deadline_ns && !now_ns_.compare_exchange_weak(now_ns, deadline_ns)) {
    }
  }
  void Advance(std::int64_t span_ns) { now_ns_.fetch_add(span_ns); }

 private:
  static constexpr std::int64_t kUtcStartNs = 1'577'836'800'000'000'000;  // 2020-01-01
  mutable std::atomic<std::int64_t> now_ns_{5'000'000'000};
};

}  // namespace onesea
