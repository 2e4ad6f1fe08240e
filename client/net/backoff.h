#pragma once

#include <cstdint>
#include <random>

namespace onesea::client {

struct BackoffOptions {
  std::int64_t first_ns = 100'000'000;  ///< > 0; so that a restarted server is found again at once
  std::int64_t longest_ns =
      5'000'000'000;  ///< a person does not wait longer for a server that came back
};

/// How long to wait before the next try: doubling up to a limit, each time a random share in [1/2,
/// 1] of it, so that a thousand viewers of a restarted server do not come back in the same
/// millisecond.
class Backoff {
 public:
  Backoff(BackoffOptions options, std::uint64_t seed) : options_(options), random_(seed) {}

  std::int64_t NextNs();
  /// After a success.
  void Reset() { tries_ = 0; }

 private:
  BackoffOptions options_;
  std::mt19937_64 random_;
  int tries_ = 0;
};

}  // namespace onesea::client
