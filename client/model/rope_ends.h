#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "client/model/local_world.h"

namespace onesea::client {

/// Between which places a rope hangs at one moment; world frame.
struct RopeNow {
  std::uint32_t id = 0;
  Vec3d from_m, to_m;
  double length_m = 0.0;  ///< > 0; it is straight where the ends are further apart
};

/// The ropes at `time`, their ends on the bodies as these are drawn then: the one of `own` as that
/// says. Ropes of bodies that the view doesn't have are left out. Cost: finds two bodies a rope.
std::vector<RopeNow> RopesAt(const WorldView& world, SimTime time,
                             const std::optional<wire::BodyState>& own = std::nullopt);

}  // namespace onesea::client
