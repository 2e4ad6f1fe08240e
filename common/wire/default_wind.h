#pragma once

#include "common/sea/sea_state.h"

/// The wind that a sea lets us guess when nobody states it: for foam and for shading, not for
/// waves.
namespace onesea::wire {

struct Wind {
  double speed_m_per_s = 0.0;  ///< U10
  double to_rad = 0.0;
};

/// Of the systems' winds the strongest. A system given by height has the wind U10 = sqrt(g Hs /
/// 0.22) under which a fully developed sea is that high (Pierson & Moskowitz 1964); swell (swell >
/// 0) has none. Exactly rounded operations only.
Wind DefaultWind(const sea::SeaState& sea);

}  // namespace onesea::wire
