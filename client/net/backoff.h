#pragma once

#include <algorithm>
#include <cstdint>

namespace onesea::client {

/// Waiting times between attempts: doubling from kFirstNs to kMaxNs, each spread over half to
/// once itself so that a thousand viewers of one server don't come back in the same instant.
class Backoff {
 public:
  static constexpr std::int64_t kFirstNs = 100'000'000;
  static constexpr std::int64_t kMaxNs = 5'000'000'000;

  /// `uniform` in [0, 1). After n failures in a row: within [1/2, 1) of min(kFirstNs 2ⁿ, kMaxNs).
  std::int64_t NextNs(double uniform) {
    const std::int64_t full_ns = next_ns_;
    next_ns_ = std::min(2 * next_ns_, kMaxNs);
    return static_cast<std::int64_t>(static_cast<double>(full_ns) * (0.5 + 0.5 * uniform));
  }
  void Reset() { next_ns_ = kFirstNs; }

 private:
  std::int64_t next_ns_ = kFirstNs;
};

}  // namespace onesea::client
