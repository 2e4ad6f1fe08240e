#include "common/base/sim_time.h"

#include <cmath>

namespace onesea {

SimTime SimTime::FromSeconds(double seconds) {
  return {std::llround(seconds * static_cast<double>(kFlicksPerSecond))};
}

}  // namespace onesea
