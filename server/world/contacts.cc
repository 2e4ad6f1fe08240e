#include "server/world/contacts.h"

#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "common/base/limits.h"

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

struct Contacts::Impl {
  explicit Impl(std::shared_ptr<const sea::Terrain> terrain)
      : dispatcher_(&configuration_),
        world_(&dispatcher_, &broadphase_, &solver_, &configuration_),
        terrain_(std::move(terrain)) {
    world_.setGravity(btVector3(0, 0, 0));  // part of the loads
    if (terrain_ != nullptr) AddTerrain();
  }
  ~Impl() {
    for (auto& [id, object] : objects_) world_.removeRigidBody(object.body.get());
    if (ground_ != nullptr) world_.removeRigidBody(ground_.get());
  }

  void Add(BodyId id, const SteppedBody& entry) {
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

  void Step(std::map<BodyId, SteppedBody>& entries, double step_s) {
    for (auto& [id, entry] : entries) Place(objects_.at(id), entry, step_s);
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

  void Place(Object& object, const SteppedBody& entry, double step_s) {
    const BodyState& end = entry.state;
    const Pose& start = entry.start;
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
    Quaternion d = to * Inverse(from);
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

Contacts::Contacts(std::shared_ptr<const sea::Terrain> terrain)
    : impl_(std::make_unique<Impl>(std::move(terrain))) {}
Contacts::~Contacts() = default;
void Contacts::Add(BodyId id, const SteppedBody& body) { impl_->Add(id, body); }
void Contacts::Remove(BodyId id) { impl_->Remove(id); }
void Contacts::Step(std::map<BodyId, SteppedBody>& bodies, double step_s) {
  impl_->Step(bodies, step_s);
}

}  // namespace onesea::world
