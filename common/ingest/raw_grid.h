#pragma once

#include <string>
#include <vector>

/// What a terrain file says before it is brought into the world frame.
namespace onesea::ingest {

struct RawGrid {
  double x0 = 0.0;  ///< of the first column of samples, in the file's unit
  double y0 = 0.0;  ///< of the first row; rows run north
  double dx = 0.0;
  double dy = 0.0;
  int columns = 0;
  int rows = 0;
  std::vector<float> value;  ///< (rows x columns) as written; NaN where the file has none
};

}  // namespace onesea::ingest
