// Which regions there are: those that stand, and those that follow bodies which aren't at rest.
//
// People come and go, and their boats stay. A session has few regions, so one that follows a boat
// which nobody drives is given back (rest_after_s), and comes back with the first command, push or
// tow that brings the boat to life. Everything follows from commands and motion, none from leases:
// these run in real time, and a world must replay.

#include <algorithm>
#include <vector>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "server/world/world.h"

namespace onesea::world {
namespace {

// Slower through the water than this, in the mean over some seconds: the waves' own motion, to and
// fro, doesn't count.
constexpr double kRestSpeedMPerS = 0.5;
constexpr double kRestMeanS = 10.0;
// Of those at rest there may be one for each body.
constexpr std::size_t kRegionAsksMax = kRegionsMax + kBodiesMax;

bool IsDriven(const DriveCommand& command) {
  return std::any_of(command.throttle.begin(), command.throttle.end(),
                     [](double throttle) { return throttle != 0.0; });
}

}  // namespace

void World::NoteActivity() {
  const double share = step_s_ / (kRestMeanS + step_s_);
  for (auto& [id, body] : bodies_) {
    const BodyState& state = body.stepped->state;
    const Vec2d through{state.velocity_m_per_s.x - options_.current_m_per_s.x,
                        state.velocity_m_per_s.y - options_.current_m_per_s.y};
    body.mean_m_per_s = body.mean_m_per_s + share * (through - body.mean_m_per_s);
    if (IsDriven(state.command) || Norm(body.mean_m_per_s) > kRestSpeedMPerS) {
      body.active_tick = tick_;
    }
  }
}

// A command for a body is a sign of life: who holds a lease gives one every now and then.
void World::NoteCommand(const wire::WorldCommand& command) {
  const auto note = [this](std::uint32_t id) {
    if (const auto body = bodies_.find(id); body != bodies_.end()) {
      body->second.active_tick = tick_;
    }
  };
  if (const auto* tie = std::get_if<wire::AddRope>(&command)) {
    note(tie->rope.from.body_id);
    note(tie->rope.to.body_id);
    return;
  }
  std::visit(
      [&note](const auto& one) {
        if constexpr (requires { one.body_id; }) note(one.body_id);
      },
      command);
}

bool World::IsAtRest(const wire::RegionSpec& region) const {
  const auto body = bodies_.find(region.follow_body_id);
  if (!(region.rest_after_s > 0.0) || body == bodies_.end()) return false;
  const auto still_ticks = static_cast<double>(tick_ - body->second.active_tick);
  return still_ticks > region.rest_after_s * options_.tick_rate_hz;
}

void World::WakeRegions() {
  std::erase_if(regions_, [this](const auto& entry) {
    return entry.second.end_tick && *entry.second.end_tick <= tick_;
  });
  for (auto& [id, region] : regions_) {
    const bool rests = IsAtRest(region.spec);
    if (region.resting && !rests) region.since_tick = tick_;
    region.resting = rests;
  }
}

RegionAsk World::AskFor(std::uint32_t id, const wire::RegionSpec& spec) const {
  RegionAsk ask{.id = id,
                .kind = static_cast<SolverKind>(spec.solver),
                .cell_m = spec.cell_m,
                .columns = spec.columns,
                .rows = spec.rows,
                .centre_m = spec.middle_m,
                .damping_per_s = spec.damping_per_s,
                .traits = {.height_step_m = spec.height_step_m,
                           .frames_per_update = spec.frames_per_update,
                           .rain_drops_per_m2_s = spec.rain_drops_per_m2_s}};
  if (const BodyState* body = rigid_.FindState(spec.follow_body_id); body != nullptr) {
    ask.centre_m = {body->pose.centre_m.x, body->pose.centre_m.y};
  }
  return ask;
}

absl::Status World::PlaceRegions() {
  std::vector<std::pair<Tick, std::uint32_t>> awake;  // who came first is first
  for (const auto& [id, region] : regions_) {
    if (!region.resting) awake.emplace_back(region.since_tick, id);
  }
  std::sort(awake.begin(), awake.end());
  if (awake.size() > kRegionsMax) awake.resize(kRegionsMax);
  std::vector<RegionAsk> asks;
  for (const auto& [since, id] : awake) {
    asks.push_back(AskFor(id, regions_[id].spec));
  }
  return layer_.Place(asks);
}

absl::StatusOr<std::uint32_t> World::Do(const wire::AddRegion& command) {
  std::size_t awake = 0;
  std::int64_t cells = std::int64_t{command.region.columns} * command.region.rows;
  for (const auto& [id, region] : regions_) {
    if (region.resting) continue;
    ++awake;
    cells += std::int64_t{region.spec.columns} * region.spec.rows;
  }
  // One that others may have for a while can wait for its turn; who asks for good is told.
  const bool waits = command.region.follow_body_id != 0 && command.region.rest_after_s > 0.0;
  if ((awake >= kRegionsMax && !waits) || regions_.size() >= kRegionAsksMax) {
    return absl::ResourceExhaustedError(
        absl::StrCat("the session has ", kRegionsMax, " regions, the most there can be"));
  }
  if (cells > kRegionCellsMax && !waits) {
    return absl::ResourceExhaustedError(absl::StrCat("region: with it the session would have ",
                                                     cells, " cells, the limit is ",
                                                     kRegionCellsMax));
  }
  const std::uint32_t follows = command.region.follow_body_id;
  if (follows != 0 && !HasBody(follows)) {
    return absl::NotFoundError(absl::StrCat("body_id: there is no body ", follows));
  }
  const std::uint32_t id = next_region_id_;
  ONESEA_RETURN_IF_ERROR(ValidateRegionAsk(AskFor(id, command.region)));
  regions_[id] = {.spec = command.region, .since_tick = tick_};
  if (follows != 0) bodies_[follows].active_tick = tick_;
  if (absl::Status placed = PlaceRegions(); !placed.ok()) {
    regions_.erase(id);
    PlaceRegions().IgnoreError();
    return placed;
  }
  ++next_region_id_;
  return id;
}

absl::StatusOr<std::uint32_t> World::Do(const wire::RemoveRegion& command) {
  if (regions_.erase(command.region_id) == 0) {
    return absl::NotFoundError(absl::StrCat("region_id: there is no region ", command.region_id));
  }
  PlaceRegions().IgnoreError();
  return command.region_id;
}

// The wake of a body that is taken away goes on where it was.
void World::LeaveRegionsOf(std::uint32_t body_id, Vec2d place_m) {
  for (auto& [id, region] : regions_) {
    wire::RegionSpec& spec = region.spec;
    if (spec.follow_body_id != body_id) continue;
    spec.follow_body_id = 0;
    spec.middle_m = place_m;
    if (spec.rest_after_s > 0.0) {
      region.end_tick = tick_ + static_cast<Tick>(spec.rest_after_s * options_.tick_rate_hz);
    }
  }
}

}  // namespace onesea::world
