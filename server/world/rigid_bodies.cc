#include "server/world/rigid_bodies.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/base/range_check.h"
#include "common/wire/bounds.h"

namespace onesea::world {

RigidBodies::RigidBodies(double step_s, std::shared_ptr<const sea::Terrain> terrain)
    : step_s_(step_s), terrain_(std::move(terrain)) {
  ONESEA_CHECK(step_s > 0.0) << "step " << step_s;
  Rebuild();
}
RigidBodies::~RigidBodies() = default;

namespace {

using wire::CheckVector;

absl::Status IsMotion(const Pose& pose, Vec3d velocity_m_per_s, Vec3d spin_rad_per_s) {
  for (const absl::Status& s :
       {CheckVector("", "pose.centre_m", pose.centre_m, kQueryCoordinateMaxM),
        CheckVector("", "velocity_m_per_s", velocity_m_per_s, kBodySpeedMaxMPerS),
        CheckVector("", "spin_rad_per_s", spin_rad_per_s, kBodySpinMaxRadPerS)}) {
    if (!s.ok()) return s;
  }
  return CheckInRange("pose.turn (its norm)", std::sqrt(Dot(pose.turn, pose.turn)), 0.9, 1.1);
}

absl::Status NoBody(BodyId id) { return absl::NotFoundError(absl::StrCat("no body ", id)); }

}  // namespace

SteppedBody* RigidBodies::Find(BodyId id) {
  const auto found = bodies_.find(id);
  return found == bodies_.end() ? nullptr : &found->second;
}

absl::StatusOr<BodyId> RigidBodies::Add(std::shared_ptr<const BodyModel> model,
                                        const BodyState& state) {
  ONESEA_CHECK(model != nullptr);
  if (bodies_.size() >= kBodiesMax) {
    return absl::ResourceExhaustedError(
        absl::StrCat("the session has ", kBodiesMax, " bodies, the most it can"));
  }
  if (absl::Status s = IsMotion(state.pose, state.velocity_m_per_s, state.spin_rad_per_s);
      !s.ok()) {
    return s;
  }
  if (absl::Status s = ValidateDrive(state.command); !s.ok()) return s;
  const RadiationKernel& memory = model->spec.heave_memory;
  if (!memory.kernel.empty() && std::abs(memory.step_s - step_s_) > 1e-9) {
    return absl::InvalidArgumentError(absl::StrCat(
        "heave_memory is made for steps of ", memory.step_s, " s, the session's are ", step_s_));
  }
  const BodyId id = next_id_++;
  SteppedBody& entry = bodies_[id];
  entry = {std::move(model), state, {}, state.pose};
  entry.state.pose.turn = Normalised(state.pose.turn);
  contacts_->Add(id, entry);
  return id;
}

absl::Status RigidBodies::Remove(BodyId id) {
  if (Find(id) == nullptr) return NoBody(id);
  std::erase_if(ropes_, [&](const auto& rope) {
    return rope.second.spec.from.body_id == id || rope.second.spec.to.body_id == id;
  });
  contacts_->Remove(id);
  bodies_.erase(id);
  return absl::OkStatus();
}

absl::Status RigidBodies::SetDrive(BodyId id, const DriveCommand& command) {
  SteppedBody* entry = Find(id);
  if (entry == nullptr) return NoBody(id);
  if (absl::Status s = ValidateDrive(command); !s.ok()) return s;
  entry->state.command = command;
  return absl::OkStatus();
}

absl::Status RigidBodies::Raise(BodyId id, double metres, double rise_m_per_s) {
  SteppedBody* entry = Find(id);
  if (entry == nullptr) return NoBody(id);
  entry->state.pose.centre_m.z += metres;
  entry->state.velocity_m_per_s.z += rise_m_per_s;
  return absl::OkStatus();
}

absl::Status RigidBodies::ApplyImpulse(BodyId id, Vec3d impulse_n_s, Vec3d place_m) {
  SteppedBody* entry = Find(id);
  if (entry == nullptr) return NoBody(id);
  if (absl::Status s = CheckVector("", "impulse_n_s", impulse_n_s, kBodyForceMaxN); !s.ok())
    return s;
  if (absl::Status s = CheckVector("", "place_m", place_m, kQueryCoordinateMaxM); !s.ok()) return s;
  if (!world::ApplyImpulse(*entry->model, impulse_n_s, place_m, entry->state)) {
    return absl::InvalidArgumentError("impulse_n_s is too large for this body");
  }
  return absl::OkStatus();
}

absl::Status RigidBodies::CheckMotion(BodyId id, const Pose& pose, Vec3d velocity_m_per_s,
                                      Vec3d spin_rad_per_s) const {
  const BodyModel* model = FindModel(id);
  if (model == nullptr) return NoBody(id);
  if (model->spec.control != BodyControl::kByOwner) {
    return absl::FailedPreconditionError(
        absl::StrCat("body ", id, " is integrated here; spawn it with control CONTROL_BY_OWNER"));
  }
  return IsMotion(pose, velocity_m_per_s, spin_rad_per_s);
}

absl::Status RigidBodies::SetMotion(BodyId id, const Pose& pose, Vec3d velocity_m_per_s,
                                    Vec3d spin_rad_per_s) {
  if (absl::Status s = CheckMotion(id, pose, velocity_m_per_s, spin_rad_per_s); !s.ok()) return s;
  SteppedBody* entry = Find(id);
  entry->state.pose = {pose.centre_m, Normalised(pose.turn)};
  entry->state.velocity_m_per_s = velocity_m_per_s;
  entry->state.spin_rad_per_s = spin_rad_per_s;
  return absl::OkStatus();
}

absl::StatusOr<RopeId> RigidBodies::AddRope(const wire::RopeSpec& spec) {
  if (absl::Status s = wire::ValidateRopeSpec("rope.", spec); !s.ok()) return s;
  for (BodyId id : {spec.from.body_id, spec.to.body_id}) {
    if (id != kNoBody && Find(id) == nullptr) return NoBody(id);
  }
  if (ropes_.size() >= kRopesMax) {
    return absl::ResourceExhaustedError(
        absl::StrCat("the session has ", kRopesMax, " ropes, the most it can"));
  }
  // As a catapult it would be of no use to sailors.
  const double apart_m = Norm(PlaceOf(spec.to) - PlaceOf(spec.from));
  if (apart_m > kRopeStretchMax * spec.length_m) {
    return absl::InvalidArgumentError(
        absl::StrCat("rope.length_m: ", spec.length_m, ", but its ends are ", apart_m,
                     " m apart; at most ", kRopeStretchMax, " times the length"));
  }
  const RopeId id = next_id_++;
  ropes_[id] = {spec, 0.0};
  return id;
}

absl::Status RigidBodies::RemoveRope(RopeId id) {
  if (ropes_.erase(id) != 0) return absl::OkStatus();
  return absl::NotFoundError(absl::StrCat("rope_id: there is no rope ", id));
}

const wire::RopeSpec* RigidBodies::FindRope(RopeId id) const {
  const auto found = ropes_.find(id);
  return found == ropes_.end() ? nullptr : &found->second.spec;
}

namespace {

// What sinks where there is no bottom, or drifts out of the world, stops at its edge.
void KeepInTheWorld(BodyState& state) {
  const auto keep = [](double low, double high, double& place, double& velocity) {
    if (place >= low && place <= high) return;
    place = std::clamp(place, low, high);
    velocity = 0.0;
  };
  Vec3d& place = state.pose.centre_m;
  Vec3d& velocity = state.velocity_m_per_s;
  keep(-kQueryCoordinateMaxM, kQueryCoordinateMaxM, place.x, velocity.x);
  keep(-kQueryCoordinateMaxM, kQueryCoordinateMaxM, place.y, velocity.y);
  keep(-kDepthMaxM, kQueryCoordinateMaxM, place.z, velocity.z);
}

}  // namespace

void RigidBodies::MoveAlone(SteppedBody& entry, WaterSource& water, const Air& air) {
  const BodyModel& model = *entry.model;
  const WaterPatch& patch = water.Around(entry.state.pose.centre_m, model.hull.radius_m());
  if (model.spec.control == BodyControl::kByOwner) {
    entry.loads = ComputeLoads(model, entry.state, patch, air, scratch_);
    entry.state.immersion = entry.loads.immersion;
    entry.state.submersion = entry.loads.submersion;
    AdvanceDrive(model.spec.thrusters, model.spec.rudders, entry.state.command, step_s_,
                 entry.state.drive);
    AdvancePose(step_s_, entry.state);  // until the owner says otherwise
    KeepInTheWorld(entry.state);
    return;
  }
  const int parts = SubSteps(model, step_s_);
  for (int n = 0; n < parts; ++n) {
    entry.loads = ComputeLoads(model, entry.state, patch, air, scratch_);
    if (!AdvanceVelocity(model, entry.loads, {}, {}, step_s_ / parts, entry.state)) ++faults_;
    AdvancePose(step_s_ / parts, entry.state);
  }
  KeepInTheWorld(entry.state);
}

Vec3d RigidBodies::PlaceOf(const wire::RopeEnd& end) {
  const SteppedBody* entry = Find(end.body_id);
  if (entry == nullptr) return end.point_m;
  const Pose& pose = entry->state.pose;
  return pose.centre_m + ToMatrix(pose.turn) * (end.point_m - entry->model->centre_of_mass_m);
}

RopeBody RigidBodies::EndOf(const wire::RopeEnd& end) {
  SteppedBody* entry = Find(end.body_id);
  if (entry == nullptr) return {nullptr, nullptr, end.point_m};
  const Pose& start = entry->start;
  const Vec3d at =
      start.centre_m + ToMatrix(start.turn) * (end.point_m - entry->model->centre_of_mass_m);
  const bool ours = entry->model->spec.control == BodyControl::kIntegrated;
  return {ours ? entry->model.get() : nullptr, &entry->state, at};
}

// Stretch at the start of the step, velocities at its end.
void RigidBodies::PullRopes() {
  for (auto& [id, rope] : ropes_) {
    SteppedBody* ends[2] = {Find(rope.spec.from.body_id), Find(rope.spec.to.body_id)};
    Vec3d velocity[2], spin[2];
    for (int n = 0; n < 2; ++n) {
      if (ends[n] == nullptr) continue;
      velocity[n] = ends[n]->state.velocity_m_per_s;
      spin[n] = ends[n]->state.spin_rad_per_s;
    }
    rope.tension_n = PullRope(rope.spec, EndOf(rope.spec.from), EndOf(rope.spec.to), step_s_);
    for (int n = 0; n < 2; ++n) {
      if (ends[n] == nullptr || rope.tension_n == 0.0) continue;
      BodyState moved;  // the poses were advanced before: by what the pull adds
      BodyState& state = ends[n]->state;
      moved.pose = state.pose;
      moved.velocity_m_per_s = state.velocity_m_per_s - velocity[n];
      moved.spin_rad_per_s = state.spin_rad_per_s - spin[n];
      AdvancePose(step_s_, moved);
      state.pose = moved.pose;
    }
  }
}

void RigidBodies::Step(WaterSource& water, const Air& air) {
  for (auto& [id, entry] : bodies_) {
    entry.start = entry.state.pose;
    MoveAlone(entry, water, air);
  }
  PullRopes();
  contacts_->Step(bodies_, step_s_);
}

std::vector<BodyId> RigidBodies::Ids() const {
  std::vector<BodyId> ids;
  for (const auto& [id, entry] : bodies_) ids.push_back(id);
  return ids;
}
const SteppedBody* RigidBodies::FindBody(BodyId id) const {
  const auto found = bodies_.find(id);
  return found == bodies_.end() ? nullptr : &found->second;
}
const BodyState* RigidBodies::FindState(BodyId id) const {
  const auto found = bodies_.find(id);
  return found == bodies_.end() ? nullptr : &found->second.state;
}
const BodyModel* RigidBodies::FindModel(BodyId id) const {
  const auto found = bodies_.find(id);
  return found == bodies_.end() ? nullptr : found->second.model.get();
}
const BodyLoads* RigidBodies::FindLoads(BodyId id) const {
  const auto found = bodies_.find(id);
  return found == bodies_.end() ? nullptr : &found->second.loads;
}
double RigidBodies::TensionOf(RopeId id) const {
  const auto found = ropes_.find(id);
  return found == ropes_.end() ? 0.0 : found->second.tension_n;
}

RigidBodiesState RigidBodies::State() const {
  RigidBodiesState out;
  out.next_id = next_id_;
  for (const auto& [id, entry] : bodies_) out.bodies.push_back({id, entry.model, entry.state});
  for (const auto& [id, rope] : ropes_) out.ropes.push_back({id, rope.spec});
  return out;
}

void RigidBodies::Restore(const RigidBodiesState& state) {
  next_id_ = state.next_id;
  bodies_.clear();
  ropes_.clear();
  for (const auto& body : state.bodies)
    bodies_[body.id] = {body.model, body.state, {}, body.state.pose};
  for (const auto& rope : state.ropes) ropes_[rope.id] = {rope.spec, 0.0};
  Rebuild();
}

void RigidBodies::Rebuild() {
  contacts_.reset();
  contacts_ = std::make_unique<Contacts>(terrain_);
  for (const auto& [id, entry] : bodies_) contacts_->Add(id, entry);
}

std::uint64_t RigidBodies::Hash() const {
  Hash64 hash;
  const auto add = [&](Vec3d v) {
    for (double value : {v.x, v.y, v.z}) hash.Add(value);
  };
  hash.Add(next_id_);
  for (const auto& [id, entry] : bodies_) {
    const BodyState& s = entry.state;
    hash.Add(id);
    add(s.pose.centre_m);
    for (double value : {s.pose.turn.w, s.pose.turn.x, s.pose.turn.y, s.pose.turn.z}) {
      hash.Add(value);
    }
    add(s.velocity_m_per_s);
    add(s.spin_rad_per_s);
    for (double value : s.command.throttle) hash.Add(value);
    for (double value : s.command.rudder) hash.Add(value);
    for (double value : s.drive.turns_per_s) hash.Add(value);
    for (double value : s.drive.steer_rad) hash.Add(value);
    for (double value : s.drive.rudder_rad) hash.Add(value);
    hash.Add(s.immersion);
    hash.Add(s.submersion);
    for (double value : s.heave_history_m_per_s) hash.Add(value);
  }
  for (const auto& [id, rope] : ropes_) hash.Add(id);
  return hash.value();
}

}  // namespace onesea::world
