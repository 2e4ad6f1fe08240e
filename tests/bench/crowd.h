#pragma once

#include <sys/epoll.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <span>
#include <vector>

#include "common/base/clock.h"

namespace onesea::bench {

/// Percentiles of what was measured.
struct Spread {
  double p50 = 0.0, p99 = 0.0, p999 = 0.0;
};

inline Spread SpreadOf(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  return {at(0.50), at(0.99), at(0.999)};
}

/// What a crowd measured over a span of time.
struct CrowdResult {
  std::int64_t frames = 0;
  std::int64_t gaps = 0;  ///< frames that were skipped for some viewer
  std::int64_t bytes = 0;
  int lost = 0;        ///< viewers whose connection ended
  Spread lateness_ms;  ///< arrival minus when the tick was due, over all viewers and frames
};

/// Reads all `viewers` on this thread for `span_ns`. A viewer has fd(), bytes() and
/// OnReadable(seen), and tells each frame as something with `sequence` and `due_ns`.
template <typename Viewer>
CrowdResult Watch(std::vector<Viewer>& viewers, std::int64_t span_ns) {
  const int poll = epoll_create1(0);
  std::vector<std::int64_t> last(viewers.size(), -1);
  for (std::size_t n = 0; n < viewers.size(); ++n) {
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.u64 = n;
    epoll_ctl(poll, EPOLL_CTL_ADD, viewers[n].fd(), &event);
  }
  CrowdResult result;
  std::vector<double> lateness_ms;
  for (const Viewer& viewer : viewers) result.bytes -= viewer.bytes();
  const std::int64_t end_ns = SystemClock().MonotonicNs() + span_ns;
  std::vector<epoll_event> events(256);
  while (SystemClock().MonotonicNs() < end_ns) {
    const int count = epoll_wait(poll, events.data(), static_cast<int>(events.size()), 20);
    for (int n = 0; n < count; ++n) {
      const std::size_t index = events[n].data.u64;
      Viewer& viewer = viewers[index];
      const bool alive = viewer.OnReadable([&](const auto& frame) {
        const std::int64_t late_ns = SystemClock().MonotonicNs() - frame.due_ns;
        lateness_ms.push_back(static_cast<double>(late_ns) * 1e-6);
        ++result.frames;
        if (last[index] >= 0) result.gaps += frame.sequence - last[index] - 1;
        last[index] = frame.sequence;
      });
      if (alive) continue;
      ++result.lost;
      epoll_ctl(poll, EPOLL_CTL_DEL, viewer.fd(), nullptr);
    }
  }
  for (const Viewer& viewer : viewers) result.bytes += viewer.bytes();
  close(poll);
  result.lateness_ms = SpreadOf(std::move(lateness_ms));
  return result;
}

}  // namespace onesea::bench
