#include "client/net/backoff.h"

#include <algorithm>

namespace onesea::client {

std::int64_t Backoff::NextNs() {
  std::int64_t limit_ns = std::min(options_.first_ns, options_.longest_ns);
  for (int n = 0; n < tries_ && limit_ns < options_.longest_ns; ++n) {
    limit_ns = limit_ns > options_.longest_ns / 2 ? options_.longest_ns : 2 * limit_ns;
  }
  ++tries_;
  const double share = 0.5 + 0.5 * static_cast<double>(random_() >> 11) * 0x1p-53;
  return static_cast<std::int64_t>(static_cast<double>(limit_ns) * share);
}

}  // namespace onesea::client
