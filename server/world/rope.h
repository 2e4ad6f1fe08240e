#pragma once

#include <cstdint>

#include "absl/status/status.h"
#include "server/world/body_loads.h"

/// Mooring lines and tow ropes: a spring that only pulls.
namespace onesea::world {

using BodyId = std::int64_t;  ///< 1, 2, ... in order of creation; never used again
inline constexpr BodyId kNoBody = 0;

struct RopeEnd {
  BodyId body = kNoBody;  ///< kNoBody: `point_m` stands still in the world
  Vec3d point_m{};        ///< body frame, or world
};
struct RopeSpec {
  RopeEnd from{}, to{};
  double length_m = 10.0;          ///< slack below; (0, 10000]
  double stiffness_n_per_m = 1e4;  ///< (0, 1e9]
  double damping_n_s_per_m = 1e3;  ///< [0, 1e9] while taut
};
/// InvalidArgument naming field, value and limit, or equal ends.
absl::Status ValidateRope(const RopeSpec& spec);

/// One end as the solver sees it; no model: the world.
struct RopeBody {
  const BodyModel* model = nullptr;  ///< null also for bodies that others integrate
  BodyState* state = nullptr;
  Vec3d at_m;  ///< the point now, world
};
/// Pulls for one step: the tension at the end of the step, so that any stiffness is stable for one
/// rope. Changes velocities only. Returns the tension [N].
double PullRope(const RopeSpec& spec, const RopeBody& from, const RopeBody& to, double step_s);

}  // namespace onesea::world
