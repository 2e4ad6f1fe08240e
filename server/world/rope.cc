#include "server/world/rope.h"

namespace onesea::world {
namespace {

Vec3d VelocityAt(const RopeBody& body) {
  if (body.state == nullptr) return {};
  return body.state->velocity_m_per_s +
         Cross(body.state->spin_rad_per_s, body.at_m - body.state->pose.centre_m);
}

// Speed that a unit impulse along `direction` gives the point.
double Mobility(const RopeBody& body, Vec3d direction) {
  if (body.model == nullptr) return 0.0;
  const Mat3d turn = ToMatrix(body.state->pose.turn);
  const Vec3d arm = body.at_m - body.state->pose.centre_m;
  const Vec6 row = Join(turn.TransposeTimes(direction), turn.TransposeTimes(Cross(arm, direction)));
  Vec6 change = row;
  return SolveInPlace(MassNow(*body.model, *body.state), change) ? Dot(row, change) : 0.0;
}

}  // namespace

double PullRope(const wire::RopeSpec& spec, const RopeBody& from, const RopeBody& to,
                double step_s) {
  const Vec3d along = to.at_m - from.at_m;
  const double length = Norm(along);
  const double stretch = length - spec.length_m;
  if (!(stretch > 0.0)) return 0.0;
  const Vec3d direction = (1.0 / length) * along;
  const double parting = Dot(VelocityAt(to) - VelocityAt(from), direction);
  const double mobility = Mobility(from, direction) + Mobility(to, direction);
  // Backward Euler of T = k stretch + c parting.
  const double rate = spec.damping_n_s_per_m + step_s * spec.stiffness_n_per_m;
  const double tension =
      (spec.stiffness_n_per_m * stretch + rate * parting) / (1.0 + step_s * rate * mobility);
  if (!(tension > 0.0)) return 0.0;
  const Vec3d impulse = (tension * step_s) * direction;
  if (from.model != nullptr) ApplyImpulse(*from.model, impulse, from.at_m, *from.state);
  if (to.model != nullptr) ApplyImpulse(*to.model, -1.0 * impulse, to.at_m, *to.state);
  return tension;
}

}  // namespace onesea::world
