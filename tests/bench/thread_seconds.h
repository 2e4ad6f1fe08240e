#pragma once

#include <time.h>

#include <algorithm>
#include <vector>

namespace onesea {

inline double ThreadSeconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// CPU seconds of one call: the median of nine batches of at least 10 ms. Thread time does not
/// count what the neighbours take, except in the caches.
template <typename Run>
double MedianThreadSeconds(const Run& run) {
  run();
  int calls = 1;
  for (;; calls *= 2) {
    const double start = ThreadSeconds();
    for (int n = 0; n < calls; ++n) run();
    if (ThreadSeconds() - start > 0.01) break;
  }
  std::vector<double> batches;
  for (int batch = 0; batch < 9; ++batch) {
    const double start = ThreadSeconds();
    for (int n = 0; n < calls; ++n) run();
    batches.push_back((ThreadSeconds() - start) / calls);
  }
  std::nth_element(batches.begin(), batches.begin() + 4, batches.end());
  return batches[4];
}

}  // namespace onesea
