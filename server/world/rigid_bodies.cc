#include "server/world/rigid_bodies.h"

#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/base/range_check.h"
#include "common/wire/bounds.h"

namespace onesea::world {
namespace {

static_assert(sizeof(btScalar) == sizeof(double));

btVector3 ToBullet(Vec3d v) { return {v.x, v.y, v.z}; }
Vec3d FromBullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
btTransform ToBullet(const Pose& pose) {
  return btTransform(btQuaternion(pose.turn.x, pose.turn.y, pose.turn.z, pose.turn.w),
                     ToBullet(pose.centre_m));
}
Pose FromBullet(const btTransform& at) {
  const btQuaternion q = at.getRotation();
  return {FromBullet(at.getOrigin()), Normalised({q.w(), q.x(), q.y(), q.z()})};
}

// The farthest vertices of a hull in 90 directions: 26 to the sides, edges and corners of a cube,
// so that boxes keep theirs, and 64 spread over the sphere.
std::vector<Vec3d> OutermostVertices(const TriangleMesh& mesh, Vec3d centre_m) {
  std::vector<Vec3d> directions;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x != 0 || y != 0 || z != 0) directions.push_back({1.0 * x, 1.0 * y, 1.0 * z});
      }
    }
  }
  constexpr int kSpread = 64;
  constexpr double kGoldenAngle = 2.39996322972865332;
  for (int n = 0; n < kSpread; ++n) {
    const double z = 1.0 - (2.0 * n + 1.0) / kSpread, r = std::sqrt(1.0 - z * z);
    const real::SinCosPair turn = real::SinCos(kGoldenAngle * n);
    directions.push_back({r * turn.cos, r * turn.sin, z});
  }
  std::set<std::size_t> chosen;
  for (const Vec3d& direction : directions) {
    std::size_t best = 0;
    for (std::size_t n = 1; n < mesh.vertices.size(); ++n) {
      if (Dot(mesh.vertices[n], direction) > Dot(mesh.vertices[best], direction)) best = n;
    }
    chosen.insert(best);
  }
  std::vector<Vec3d> out;
  out.reserve(chosen.size());
  for (std::size_t n : chosen) out.push_back(mesh.vertices[n] - centre_m);
  return out;
}

std::unique_ptr<btCollisionShape> MakeShape(const BodyModel& model) {
  if (model.spec.shape.kind == ShapeKind::kSphere && Norm(model.centre_of_mass_m) < 1e-9) {
    return std::make_unique<btSphereShape>(model.spec.shape.radius_m);
  }
  auto hull = std::make_unique<btConvexHullShape>();
  for (const Vec3d& v : OutermostVertices(model.mesh, model.centre_of_mass_m)) {
    hull->addPoint(ToBullet(v), false);
  }
  const Vec3d size = model.solid.high_m - model.solid.low_m;
  hull->setMargin(0.01 * std::min({size.x, size.y, size.z}));
  hull->recalcLocalAabb();
  return hull;
}

// Gives each body at most kBodyContactPairsMax partners a step, in the order of the pairs, so that
// a thousand bodies at one point cost no more than a pile.
class LimitedDispatcher : public btCollisionDispatcher {
 public:
  explicit LimitedDispatcher(btCollisionConfiguration* configuration)
      : btCollisionDispatcher(configuration) {
    setNearCallback(&LimitedDispatcher::Near);
  }
  void dispatchAllCollisionPairs(btOverlappingPairCache* cache, const btDispatcherInfo& info,
                                 btDispatcher* dispatcher) override {
    cache_ = cache;
    counts_.clear();
    btCollisionDispatcher::dispatchAllCollisionPairs(cache, info, dispatcher);
  }

 private:
  static void Near(btBroadphasePair& pair, btCollisionDispatcher& dispatcher,
                   const btDispatcherInfo& info) {
    auto& self = static_cast<LimitedDispatcher&>(dispatcher);
    int& a = self.counts_[pair.m_pProxy0->m_clientObject];
    int& b = self.counts_[pair.m_pProxy1->m_clientObject];
    if (std::max(a, b) < kBodyContactPairsMax) {
      defaultNearCallback(pair, dispatcher, info);
      if (pair.m_algorithm == nullptr) return;
      btManifoldArray manifolds;
      pair.m_algorithm->getAllContactManifolds(manifolds);
      bool touches = false;
      for (int n = 0; n < manifolds.size(); ++n) touches |= manifolds[n]->getNumContacts() > 0;
      a += touches;
      b += touches;
    } else if (pair.m_algorithm != nullptr) {
      self.cache_->cleanOverlappingPair(pair, &self);  // its old contacts must not stay
    }
  }

  btOverlappingPairCache* cache_ = nullptr;
  std::map<void*, int> counts_;  // looked up only, never walked: addresses have no say
};

}  // namespace

// The Bullet world. Transforms and velocities are set anew every step; what it remembers are
// contacts, and Rebuild() forgets them.
class RigidBodies::Contacts {
 public:
  Contacts(std::shared_ptr<const sea::Terrain> terrain)
      : dispatcher_(&configuration_),
        world_(&dispatcher_, &broadphase_, &solver_, &configuration_),
        terrain_(std::move(terrain)) {
    world_.setGravity(btVector3(0, 0, 0));  // part of the loads
    if (terrain_ != nullptr) AddTerrain();
  }
  ~Contacts() {
    for (auto& [id, object] : objects_) world_.removeRigidBody(object.body.get());
    if (ground_ != nullptr) world_.removeRigidBody(ground_.get());
  }

  void Add(BodyId id, const Entry& entry) {
    Object& object = objects_[id];
    object.shape = MakeShape(*entry.model);
    const bool kinematic = entry.model->spec.control == BodyControl::kByOwner;
    // Without mass and inertia: others can't move it. Those of the others are set at every step.
    const double unit = kinematic ? 0.0 : 1.0;
    btRigidBody::btRigidBodyConstructionInfo info(unit, nullptr, object.shape.get(),
                                                  btVector3(unit, unit, unit));
    info.m_startWorldTransform = ToBullet(entry.state.pose);
    info.m_friction = entry.model->spec.contact_friction;
    info.m_restitution = entry.model->spec.contact_restitution;
    object.body = std::make_unique<btRigidBody>(info);
    object.body->setFlags(0);  // gyroscopic moments are part of our own step
    object.body->setActivationState(DISABLE_DEACTIVATION);
    if (kinematic) {
      object.body->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
    }
    world_.addRigidBody(object.body.get());
  }
  void Remove(BodyId id) {
    world_.removeRigidBody(objects_.at(id).body.get());
    objects_.erase(id);
  }

  /// From the pose before the step and the state after it, to the state after contacts.
  void Step(std::map<BodyId, Entry>& entries, const std::map<BodyId, Pose>& starts, double step_s) {
    for (auto& [id, entry] : entries) Place(objects_.at(id), entry, starts.at(id), step_s);
    world_.stepSimulation(step_s, 0);
    for (int n = 0; n < dispatcher_.getNumManifolds(); ++n) {
      const btPersistentManifold* manifold = dispatcher_.getManifoldByIndexInternal(n);
      if (manifold->getNumContacts() == 0) continue;
      touched_.insert(manifold->getBody0());
      touched_.insert(manifold->getBody1());
    }
    for (auto& [id, entry] : entries) {
      const Object& object = objects_.at(id);
      if (entry.model->spec.control == BodyControl::kByOwner) continue;
      if (touched_.count(object.body.get()) != 0) TakeContacts(object, entry.state);
    }
    touched_.clear();
  }

 private:
  struct Object {
    std::unique_ptr<btCollisionShape> shape;
    std::unique_ptr<btRigidBody> body;
    Vec3d velocity, spin;  // that carry the pose from its start to its end
  };

  void AddTerrain() {
    const sea::Terrain& t = *terrain_;
    const auto [low, high] = std::minmax_element(t.elevation_m.begin(), t.elevation_m.end());
    ground_shape_ = std::make_unique<btHeightfieldTerrainShape>(
        t.columns, t.rows, t.elevation_m.data(), btScalar(*low), btScalar(*high), 2, false);
    ground_shape_->setLocalScaling(btVector3(t.cell_m, t.cell_m, 1));
    btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, ground_shape_.get());
    // Bullet's height field lies about its own middle.
    info.m_startWorldTransform = ToBullet(
        Pose{{t.west_m + 0.5 * (t.columns - 1) * t.cell_m,
              t.south_m + 0.5 * (t.rows - 1) * t.cell_m, 0.5 * (double{*low} + double{*high})},
             {}});
    info.m_friction = 0.6;
    ground_ = std::make_unique<btRigidBody>(info);
    world_.addRigidBody(ground_.get());
  }

  void Place(Object& object, const Entry& entry, const Pose& start, double step_s) {
    const BodyState& end = entry.state;
    btRigidBody& body = *object.body;
    if (entry.model->spec.control == BodyControl::kByOwner) {
      body.setInterpolationWorldTransform(ToBullet(start));  // from which Bullet takes its velocity
      body.setWorldTransform(ToBullet(end.pose));
      return;
    }
    const Mat6 mass = MassNow(*entry.model, end);
    const double mean = (mass[0][0] + mass[1][1] + mass[2][2]) / 3.0;
    body.setMassProps(mean, btVector3(mass[3][3], mass[4][4], mass[5][5]));
    body.setWorldTransform(ToBullet(start));
    body.setInterpolationWorldTransform(ToBullet(start));
    body.updateInertiaTensor();
    object.velocity = (1.0 / step_s) * (end.pose.centre_m - start.centre_m);
    object.spin = MeanSpin(start.turn, end.pose.turn, step_s);
    body.setLinearVelocity(ToBullet(object.velocity));
    body.setAngularVelocity(ToBullet(object.spin));
  }

  static Vec3d MeanSpin(const Quaternion& from, const Quaternion& to, double step_s) {
    Quaternion d = to * Quaternion{from.w, -from.x, -from.y, -from.z};
    if (d.w < 0.0) d = {-d.w, -d.x, -d.y, -d.z};
    const Vec3d axis{d.x, d.y, d.z};
    const double sine = Norm(axis);
    if (!(sine > 1e-300)) return {};
    return (2.0 * real::Atan2(sine, d.w) / (sine * step_s)) * axis;
  }

  static void TakeContacts(const Object& object, BodyState& state) {
    const Pose pose = FromBullet(object.body->getWorldTransform());
    const Vec3d velocity =
        state.velocity_m_per_s + FromBullet(object.body->getLinearVelocity()) - object.velocity;
    const Vec3d spin =
        state.spin_rad_per_s + FromBullet(object.body->getAngularVelocity()) - object.spin;
    if (!IsFinite(pose.centre_m) || !IsFinite(velocity) || !IsFinite(spin)) return;
    state.pose = pose;
    state.velocity_m_per_s = velocity;
    state.spin_rad_per_s = spin;
  }

  btDefaultCollisionConfiguration configuration_;
  LimitedDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  std::shared_ptr<const sea::Terrain> terrain_;
  std::unique_ptr<btHeightfieldTerrainShape> ground_shape_;
  std::unique_ptr<btRigidBody> ground_;
  std::map<BodyId, Object> objects_;
  std::set<const btCollisionObject*> touched_;
};

RigidBodies::RigidBodies(double step_s, std::shared_ptr<const sea::Terrain> terrain)
    : step_s_(step_s), terrain_(std::move(terrain)) {
  ONESEA_CHECK(step_s > 0.0) << "step " << step_s;
  Rebuild();
}
RigidBodies::~RigidBodies() = default;

namespace {

using wire::CheckVector;

absl::Status CheckMotion(const Pose& pose, Vec3d velocity_m_per_s, Vec3d spin_rad_per_s) {
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

RigidBodies::Entry* RigidBodies::Find(BodyId id) {
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
  if (absl::Status s = CheckMotion(state.pose, state.velocity_m_per_s, state.spin_rad_per_s);
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
  Entry& entry = bodies_[id];
  entry = {std::move(model), state, {}};
  entry.state.pose.turn = Normalised(state.pose.turn);
  contacts_->Add(id, entry);
  return id;
}

absl::Status RigidBodies::Remove(BodyId id) {
  if (Find(id) == nullptr) return NoBody(id);
  std::erase_if(ropes_, [&](const auto& rope) {
    return rope.second.spec.from.body == id || rope.second.spec.to.body == id;
  });
  contacts_->Remove(id);
  bodies_.erase(id);
  return absl::OkStatus();
}

absl::Status RigidBodies::SetDrive(BodyId id, const DriveCommand& command) {
  Entry* entry = Find(id);
  if (entry == nullptr) return NoBody(id);
  if (absl::Status s = ValidateDrive(command); !s.ok()) return s;
  entry->state.command = command;
  return absl::OkStatus();
}

absl::Status RigidBodies::ApplyImpulse(BodyId id, Vec3d impulse_n_s, Vec3d place_m) {
  Entry* entry = Find(id);
  if (entry == nullptr) return NoBody(id);
  if (absl::Status s = CheckVector("", "impulse_n_s", impulse_n_s, kBodyForceMaxN); !s.ok())
    return s;
  if (absl::Status s = CheckVector("", "place_m", place_m, kQueryCoordinateMaxM); !s.ok()) return s;
  if (!world::ApplyImpulse(*entry->model, impulse_n_s, place_m, entry->state)) {
    return absl::InvalidArgumentError("impulse_n_s is too large for this body");
  }
  return absl::OkStatus();
}

absl::Status RigidBodies::SetMotion(BodyId id, const Pose& pose, Vec3d velocity_m_per_s,
                                    Vec3d spin_rad_per_s) {
  Entry* entry = Find(id);
  if (entry == nullptr) return NoBody(id);
  if (entry->model->spec.control != BodyControl::kByOwner) {
    return absl::FailedPreconditionError(absl::StrCat("body ", id, " is integrated here"));
  }
  if (absl::Status s = CheckMotion(pose, velocity_m_per_s, spin_rad_per_s); !s.ok()) return s;
  entry->state.pose = {pose.centre_m, Normalised(pose.turn)};
  entry->state.velocity_m_per_s = velocity_m_per_s;
  entry->state.spin_rad_per_s = spin_rad_per_s;
  return absl::OkStatus();
}

absl::StatusOr<RopeId> RigidBodies::AddRope(const RopeSpec& spec) {
  if (absl::Status s = ValidateRope(spec); !s.ok()) return s;
  for (BodyId id : {spec.from.body, spec.to.body}) {
    if (id != kNoBody && Find(id) == nullptr) return NoBody(id);
  }
  if (ropes_.size() >= kRopesMax) {
    return absl::ResourceExhaustedError(
        absl::StrCat("the session has ", kRopesMax, " ropes, the most it can"));
  }
  const RopeId id = next_id_++;
  ropes_[id] = {spec, 0.0};
  return id;
}

absl::Status RigidBodies::RemoveRope(RopeId id) {
  if (ropes_.erase(id) == 0) return absl::NotFoundError(absl::StrCat("no rope ", id));
  return absl::OkStatus();
}

void RigidBodies::MoveAlone(Entry& entry, WaterSource& water, const Air& air) {
  const BodyModel& model = *entry.model;
  const WaterPatch& patch = water.Around(entry.state.pose.centre_m, model.hull.radius_m());
  if (model.spec.control == BodyControl::kByOwner) {
    entry.loads = ComputeLoads(model, entry.state, patch, air, scratch_);
    entry.state.immersion = entry.loads.immersion;
    entry.state.submersion = entry.loads.submersion;
    AdvanceDrive(model.spec.thrusters, model.spec.rudders, entry.state.command, step_s_,
                 entry.state.drive);
    AdvancePose(step_s_, entry.state);  // until the owner says otherwise
    return;
  }
  const int parts = SubSteps(model, step_s_);
  for (int n = 0; n < parts; ++n) {
    entry.loads = ComputeLoads(model, entry.state, patch, air, scratch_);
    if (!AdvanceVelocity(model, entry.loads, {}, {}, step_s_ / parts, entry.state)) ++faults_;
    AdvancePose(step_s_ / parts, entry.state);
  }
  // What sinks where there is no bottom stops somewhere.
  if (entry.state.pose.centre_m.z < -kDepthMaxM) {
    entry.state.pose.centre_m.z = -kDepthMaxM;
    entry.state.velocity_m_per_s.z = 0.0;
  }
}

RopeBody RigidBodies::EndOf(const RopeEnd& end) {
  Entry* entry = Find(end.body);
  if (entry == nullptr) return {nullptr, nullptr, end.point_m};
  const Pose& start = starts_.at(end.body);
  const Vec3d at =
      start.centre_m + ToMatrix(start.turn) * (end.point_m - entry->model->centre_of_mass_m);
  const bool ours = entry->model->spec.control == BodyControl::kIntegrated;
  return {ours ? entry->model.get() : nullptr, &entry->state, at};
}

// Stretch at the start of the step, velocities at its end.
void RigidBodies::PullRopes() {
  for (auto& [id, rope] : ropes_) {
    Entry* ends[2] = {Find(rope.spec.from.body), Find(rope.spec.to.body)};
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
  starts_.clear();
  for (auto& [id, entry] : bodies_) {
    starts_[id] = entry.state.pose;
    MoveAlone(entry, water, air);
  }
  PullRopes();
  contacts_->Step(bodies_, starts_, step_s_);
}

std::vector<BodyId> RigidBodies::Ids() const {
  std::vector<BodyId> ids;
  for (const auto& [id, entry] : bodies_) ids.push_back(id);
  return ids;
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
  for (const auto& body : state.bodies) bodies_[body.id] = {body.model, body.state, {}};
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
