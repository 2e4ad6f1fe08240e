// Commands on a session's world: when they act, who may give them, who is answered.

#include <array>
#include <iterator>
#include <utility>

#include "common/base/check.h"
#include "server/session/session_runner.h"

namespace onesea::server {
namespace {

// How far ahead a command may name its tick.
constexpr std::int64_t kAheadMaxS = 60;
// Of whoever spawned the body.
constexpr double kSpawnLeaseS = 60.0;

// The bodies that a command acts on; 0 is none.
std::array<std::uint32_t, 2> BodiesOf(const wire::WorldCommand& command,
                                      const world::World& world) {
  const auto ends_of = [](const wire::RopeSpec& rope) -> std::array<std::uint32_t, 2> {
    return {rope.from.body_id, rope.to.body_id};
  };
  if (const auto* add = std::get_if<wire::AddRope>(&command)) return ends_of(add->rope);
  if (const auto* remove = std::get_if<wire::RemoveRope>(&command)) {
    const wire::RopeSpec* rope = world.FindRope(remove->rope_id);
    return rope == nullptr ? std::array<std::uint32_t, 2>{} : ends_of(*rope);
  }
  return std::visit(
      [](const auto& one) -> std::array<std::uint32_t, 2> {
        if constexpr (requires { one.body_id; }) return {one.body_id, 0};
        return {};
      },
      command);
}

}  // namespace

int SessionRunner::TicksPerAdvance() const {
  return session_.world().view()->empty() ? kTicksPerAdvance : kTicksPerAdvanceWithWorld;
}

void SessionRunner::MakeTick(std::int64_t now_ns) {
  for (const CommandQueue::Due& due : commands_.TakeDue(session_.tick() + 1)) Do(due, now_ns);
  session_.Step();
}

void SessionRunner::Command(CommandRequest request, CommandDone done, std::int64_t now_ns,
                            Deferred& deferred) {
  CommandDone later = [this, done = std::move(done)](const absl::StatusOr<CommandResult>& result) {
    answered_.push_back([done, result] { done(result); });
  };
  const std::int64_t ahead_max = kAheadMaxS * session_.spec().recipe.tick_rate_hz;
  for (const CommandQueue::Due& due :
       commands_.Submit(std::move(request), std::move(later), session_.tick(), ahead_max)) {
    Do(due, now_ns);
  }
  HandOver(deferred);
}

void SessionRunner::Do(const CommandQueue::Due& due, std::int64_t now_ns) {
  commands_.Answer(due.ticket, Act(due.request, now_ns));
}

absl::StatusOr<CommandResult> SessionRunner::Act(const CommandRequest& request,
                                                 std::int64_t now_ns) {
  world::World& world = session_.world();
  const std::string& shown = request.header.lease;
  CommandResult result;
  result.tick = session_.tick() + 1;
  if (request.body != nullptr) {
    const auto& spawn = std::get<wire::SpawnBody>(request.command);
    ONESEA_ASSIGN_OR_RETURN(result.id, world.Spawn(*request.body, spawn.start));
    ONESEA_ASSIGN_OR_RETURN(result.lease,
                            leases_.Take(result.id, "", spawn.body.owner, kSpawnLeaseS, now_ns));
    result.body = request.body;
    return result;
  }
  if (const auto* take = std::get_if<wire::TakeLease>(&request.command)) {
    ONESEA_ASSIGN_OR_RETURN(result.id, world.Apply(request.command));
    ONESEA_ASSIGN_OR_RETURN(
        result.lease, leases_.Take(take->body_id, shown, take->holder, take->duration_s, now_ns));
    return result;
  }
  const std::array<std::uint32_t, 2> bodies = BodiesOf(request.command, world);
  for (const std::uint32_t body : bodies) {
    if (world.HasBody(body)) ONESEA_RETURN_IF_ERROR(leases_.Use(body, shown, now_ns));
  }
  ONESEA_ASSIGN_OR_RETURN(result.id, world.Apply(request.command));
  if (std::holds_alternative<wire::ReleaseLease>(request.command)) {
    ONESEA_RETURN_IF_ERROR(leases_.Release(bodies[0], shown, now_ns));
  }
  if (std::holds_alternative<wire::RemoveBody>(request.command)) leases_.Forget(bodies[0]);
  return result;
}

absl::StatusOr<PosesResult> SessionRunner::SetPoses(std::span<const wire::BodyPose> poses,
                                                    std::int64_t now_ns) {
  world::World& world = session_.world();
  for (const wire::BodyPose& pose : poses) {
    if (!world.HasBody(pose.body_id)) continue;  // the world says so
    ONESEA_RETURN_IF_ERROR(leases_.Use(pose.body_id, pose.lease, now_ns));
  }
  PosesResult result;
  result.tick = session_.tick();
  ONESEA_ASSIGN_OR_RETURN(result.wrenches, world.SetPoses(poses, session_.components()));
  return result;
}

void SessionRunner::HandOver(Deferred& deferred) {
  std::move(answered_.begin(), answered_.end(), std::back_inserter(deferred));
  answered_.clear();
}

}  // namespace onesea::server
