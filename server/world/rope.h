#pragma once

#include <cstdint>

#include "common/wire/world_spec.h"
#include "server/world/body_loads.h"

/// Mooring lines and tow ropes: a spring that only pulls.
namespace onesea::world {

using BodyId = std::int64_t;  ///< 1, 2, ... in order of creation; never used again
inline constexpr BodyId kNoBody = 0;

/// One end as the solver sees it; no model: the world.
struct RopeBody {
  const BodyModel* model = nullptr;  ///< null also for bodies that others integrate
  BodyState* state = nullptr;
  Vec3d at_m;  ///< the point now, world
};
/// Pulls for one step: the tension at the end of the step, so that any stiffness is stable for one
/// rope. Changes velocities only. Returns the tension [N].
double PullRope(const wire::RopeSpec& spec, const RopeBody& from, const RopeBody& to,
                double step_s);

}  // namespace onesea::world
