#pragma once

#include <algorithm>

namespace onesea::sea {

/// Where a place lies along one side of a grid: between sample `cell` and the next.
struct GridPlace {
  int cell = 0;           ///< 0 .. samples - 2
  double fraction = 0.0;  ///< 0 .. 1
};

/// `cells` from the first sample; beyond the ends it is the end. Pre: finite, samples >= 2.
inline GridPlace LocateOnGrid(double cells, int samples) {
  const double clamped = std::clamp(cells, 0.0, static_cast<double>(samples - 1));
  const int cell = std::min(static_cast<int>(clamped), samples - 2);
  return {cell, clamped - cell};
}

}  // namespace onesea::sea
