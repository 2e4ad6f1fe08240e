#pragma once

#include <algorithm>

namespace onesea::ingest {

/// Second Fourier coefficient r2 of the cos^2s distribution whose first is r1: for files that state
/// only one spread. From r_n = s (s-1) ... (s-n+1) / ((s+1) ... (s+n)); no less than 0. Exact: r1 =
/// 0.9 (s = 9) gives r2 = 72/110.
inline double SecondMomentOfCosine2s(double r1) {
  if (!(r1 < 1.0)) return 1.0;
  const double s = r1 / (1.0 - r1);
  return std::max(0.0, s * (s - 1.0) / ((s + 1.0) * (s + 2.0)));
}

}  // namespace onesea::ingest
