// Many bodies: contacts, ropes, refusals, replay.
#include "server/world/rigid_bodies.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/ingest/mesh_file.h"
#include "server/world/body_from_wire.h"
#include "server/world/body_presets.h"
#include "server/world/hull_shapes.h"
#include "tests/world/body_run.h"
#include "tests/world/regular_wave_patch.h"

namespace onesea::world {
namespace {

constexpr double kStep = 1.0 / 60;

struct CalmWater : WaterSource {
  Vec3d current;
  WaterPatch patch;
  const WaterPatch& Around(Vec3d, double) override {
    patch.SetCalm();
    patch.current_m_per_s = current;
    return patch;
  }
};
struct Waves : WaterSource {
  double time_s = 0.0;
  WaterPatch patch;
  const WaterPatch& Around(Vec3d centre, double radius) override {
    PatchAround(centre, radius, 7, {.amplitude_m = 0.4, .wavenumber_rad_per_m = 0.3}, time_s,
                patch);
    return patch;
  }
};

BodySpec PresetSpec(const char* name) { return *FromWire(*BodyPreset(name)); }
std::shared_ptr<const BodyModel> Preset(const char* name) { return Model(PresetSpec(name), 1025); }
BodyState At(const BodyModel& model, double x, double y) {
  BodyState state = Afloat(model);
  state.pose.centre_m.x = x, state.pose.centre_m.y = y;
  return state;
}
void RunFor(RigidBodies& world, WaterSource& water, double seconds) {
  for (int n = 0; n < std::lround(seconds / kStep); ++n) world.Step(water, {});
}

TEST(BodyPreset, AllFloatUprightAndAreStable) {
  for (const BodyPresetEntry& preset : BodyPresets()) {
    const char* const name = preset.name.data();
    const auto model = Preset(name);
    EXPECT_TRUE(model->rest.floats) << name;
    EXPECT_GT(model->rest.roll_n_m_per_rad, 0) << name;
    EXPECT_GT(model->rest.pitch_n_m_per_rad, 0) << name;
    BodyRun run(PresetSpec(name), 1025);
    run.Run(60);
    EXPECT_GT(run.Up().z, 0.97) << name;
    EXPECT_LT(Norm(run.state.velocity_m_per_s), 0.05) << name;
  }
}

TEST(BodyPreset, UnknownOnesAreRefusedWithThoseThereAre) {
  const auto none = BodyPreset("submarine");
  EXPECT_EQ(none.status().code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(std::string(none.status().message()), testing::HasSubstr("\"submarine\""));
  for (const BodyPresetEntry& preset : BodyPresets()) {
    EXPECT_THAT(std::string(none.status().message()), testing::HasSubstr(preset.name.data()));
  }
}

// The file keeps the hull: floats round its vertices, that is all.
TEST(BodyPreset, TheFileOfAHullIsTheHull) {
  const TriangleMesh hull = BoatMesh({});
  const auto read = ingest::ReadMeshFile(BodyPreset("boat")->shape->mesh);
  ASSERT_TRUE(read.ok()) << read.status();
  EXPECT_TRUE(ValidateMesh(*read).ok());
  EXPECT_EQ(read->triangles.size(), hull.triangles.size());
  EXPECT_NEAR(ComputeSolid(*read).volume_m3, ComputeSolid(hull).volume_m3, 1e-5);
  EXPECT_NEAR(ComputeSolid(*read).centroid_m.y, 0.0, 1e-7);
}

// Full ahead gives a speed of its kind; hard over gives a circle that closes, of some lengths.
TEST(BodyPreset, BoatsDriveAndTurn) {
  for (const auto& [name, length_m, slowest, fastest] :
       {std::tuple("boat", 5.0, 4.0, 14.0), {"work-boat", 10.0, 2.5, 7.0}}) {
    BodyRun run(PresetSpec(name), 1025);
    run.state.command.throttle[0] = 1.0;
    run.Run(60);
    const double speed = Norm(run.state.velocity_m_per_s);
    EXPECT_GT(speed, slowest) << name;
    EXPECT_LT(speed, fastest) << name;
    EXPECT_NEAR(run.state.pose.centre_m.y, 0.0, 1.0) << name;  // straight
    EXPECT_GT(run.state.velocity_m_per_s.x, 0.95 * speed) << name;
    EXPECT_GT(run.Up().z, 0.9) << name;

    run.state.command.throttle[0] = 0.5;
    run.state.command.rudder[0] = 1.0;
    run.Run(60);
    double low = 1e9, high = -1e9, turned = 0;
    for (int n = 0; n < 60 * 90; ++n) {
      run.Step();
      low = std::min(low, run.state.pose.centre_m.y);
      high = std::max(high, run.state.pose.centre_m.y);
      turned += run.state.spin_rad_per_s.z * kStep;
    }
    EXPECT_GT(turned, 2 * sea::kPi) << name;  // to port, full circles
    EXPECT_GT(high - low, 0.5 * length_m) << name;
    EXPECT_LT(high - low, 12.0 * length_m) << name;
  }
}

TEST(RigidBodies, ABodyAloneMovesAsWithoutBullet) {
  RigidBodies world(kStep, nullptr);
  CalmWater water;
  const auto model = Preset("crate");
  BodyState state = At(*model, 3, 4);
  state.pose.centre_m.z += 1;
  state.spin_rad_per_s = {0.3, 0.2, 1};
  const BodyId id = *world.Add(model, state);
  BodyRun alone(PresetSpec("crate"), 1025);
  alone.state = state;
  for (int n = 0; n < 600; ++n) {
    world.Step(water, {});
    alone.Step();
  }
  EXPECT_EQ(*world.FindState(id), alone.state);
}

// Two crates of the same mass meet: they do not pass through, the first gives its way to the other,
// and nobody gets faster than the one that came.
TEST(RigidBodies, HullsCollide) {
  RigidBodies world(kStep, nullptr);
  CalmWater water;
  const auto model = Preset("crate");
  BodyState left = At(*model, 0, 0), right = At(*model, 3, 0);
  left.velocity_m_per_s.x = 3;
  const BodyId a = *world.Add(model, left), b = *world.Add(model, right);
  for (int n = 0; n < 240; ++n) {
    world.Step(water, {});
    const BodyState &first = *world.FindState(a), &second = *world.FindState(b);
    EXPECT_GT(second.pose.centre_m.x - first.pose.centre_m.x, 0.9);
    EXPECT_LT(Norm(first.velocity_m_per_s), 3.0);
    EXPECT_LT(Norm(second.velocity_m_per_s), 3.0);
  }
  EXPECT_GT(world.FindState(b)->velocity_m_per_s.x, 0.1);
  EXPECT_GT(world.FindState(b)->pose.centre_m.x, 3.2);
}

// A bank that rises above the water: what is dropped on it stays on it, what drives on it stops.
TEST(RigidBodies, TerrainHolds) {
  auto terrain = std::make_shared<sea::Terrain>();
  terrain->west_m = -50, terrain->south_m = -50, terrain->cell_m = 5;
  terrain->columns = terrain->rows = 41;
  for (int n = 0; n < 41 * 41; ++n) {
    terrain->elevation_m.push_back(static_cast<float>(-6.0 + 0.3 * (n % 41)));  // up to the east
  }
  RigidBodies world(kStep, terrain);
  CalmWater water;
  const auto crate = Preset("crate");
  BodyState state = At(*crate, 110, 0);
  state.pose.centre_m.z = 8;
  const BodyId dropped = *world.Add(crate, state);
  const auto boat = Preset("boat");
  BodyState driving = At(*boat, 0, 0);
  driving.command.throttle[0] = 0.4;
  const BodyId grounded = *world.Add(boat, driving);
  RunFor(world, water, 60);
  for (BodyId id : {dropped, grounded}) {
    const Vec3d at = world.FindState(id)->pose.centre_m;
    EXPECT_GT(at.z, terrain->ElevationAt({at.x, at.y})) << id;
  }
  EXPECT_NEAR(world.FindState(dropped)->pose.centre_m.z,
              terrain->ElevationAt({world.FindState(dropped)->pose.centre_m.x, 0}) + 0.4, 0.15);
  EXPECT_LT(Norm(world.FindState(dropped)->velocity_m_per_s), 0.05);
  EXPECT_LT(world.FindState(grounded)->pose.centre_m.x, 70.0);  // the water's edge is at x = 50
}

// In a current a moored raft lies down-stream of its anchor, and the line carries its drag.
TEST(RigidBodies, MooringHolds) {
  RigidBodies world(kStep, nullptr);
  CalmWater water;
  water.current = {1.0, 0, 0};
  const auto model = Preset("raft");
  const BodyId raft = *world.Add(model, At(*model, 0, 0));
  wire::RopeSpec line;
  line.from = {.body_id = static_cast<std::uint32_t>(raft), .point_m = {-1.5, 0, 0}};
  line.to = {.point_m = {-5, 0, 0}};
  line.length_m = 8;
  const RopeId rope = *world.AddRope(line);
  world.Step(water, {});
  EXPECT_EQ(world.TensionOf(rope), 0.0);  // slack
  RunFor(world, water, 120);
  const BodyState& state = *world.FindState(raft);
  EXPECT_NEAR(state.pose.centre_m.x, -5 + 8 + 1.5, 0.2);
  EXPECT_LT(Norm(state.velocity_m_per_s), 0.01);
  const BodyLoads& loads = *world.FindLoads(raft);
  const double drag = loads.drag[0] + loads.damping[0][0] * 1.0;
  EXPECT_NEAR(world.TensionOf(rope), drag, 0.05 * drag);
  EXPECT_GT(drag, 10.0);
}

// The stiffest rope between the lightest bodies stays finite, and a tow follows.
TEST(RigidBodies, TowFollowsOnAnyRope) {
  RigidBodies world(kStep, nullptr);
  CalmWater water;
  const auto boat = Preset("work-boat");
  const auto raft = Preset("raft");
  BodyState driving = At(*boat, 0, 0);
  driving.command.throttle[0] = 0.6;
  const BodyId tug = *world.Add(boat, driving), tow = *world.Add(raft, At(*raft, -12, 1));
  wire::RopeSpec rope;
  rope.from = {.body_id = static_cast<std::uint32_t>(tug), .point_m = {-5, 0, 1.5}};
  rope.to = {.body_id = static_cast<std::uint32_t>(tow), .point_m = {1.5, 0, 0}};
  rope.length_m = 6;
  rope.stiffness_n_per_m = 1e9;
  rope.damping_n_s_per_m = 0;
  ASSERT_TRUE(world.AddRope(rope).ok());
  RunFor(world, water, 60);
  const Vec3d a = world.FindState(tug)->velocity_m_per_s,
              b = world.FindState(tow)->velocity_m_per_s;
  EXPECT_GT(a.x, 1.0);
  EXPECT_NEAR(b.x, a.x, 0.2);
  EXPECT_EQ(world.fault_count(), 0);
}

TEST(RigidBodies, AThousandBodiesAtOnePointStayFinite) {
  RigidBodies world(kStep, nullptr);
  CalmWater water;
  BodySpec spec;
  spec.shape = {.kind = ShapeKind::kSphere, .radius_m = 0.5};
  spec.mass_kg = 200;
  const auto model = Model(spec);
  for (int n = 0; n < 1000; ++n) ASSERT_TRUE(world.Add(model, At(*model, 0, 0)).ok());
  for (int n = 0; n < 20; ++n) world.Step(water, {});
  double farthest = 0;
  for (BodyId id : world.Ids()) {
    const BodyState& s = *world.FindState(id);
    ASSERT_TRUE(IsFinite(s.pose.centre_m) && IsFinite(s.velocity_m_per_s));
    farthest = std::max(farthest, Norm(s.pose.centre_m));
  }
  EXPECT_LT(farthest, 100.0);
  EXPECT_EQ(world.fault_count(), 0);
}

TEST(RigidBodies, RefusesWhatIsNotANumberAndGoesOn) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  RigidBodies world(kStep, nullptr), untouched(kStep, nullptr);
  CalmWater water;
  const auto model = Preset("boat");
  const BodyId id = *world.Add(model, At(*model, 0, 0));
  ASSERT_TRUE(untouched.Add(model, At(*model, 0, 0)).ok());
  DriveCommand drive;
  drive.throttle[0] = nan;
  EXPECT_FALSE(world.SetDrive(id, drive).ok());
  EXPECT_FALSE(world.ApplyImpulse(id, {nan, 0, 0}, {}).ok());
  EXPECT_FALSE(world.ApplyImpulse(id, {1e300, 0, 0}, {}).ok());
  EXPECT_FALSE(world.ApplyImpulse(id, {0, 0, 1}, {0, nan, 0}).ok());
  EXPECT_FALSE(world.SetMotion(id, {}, {}, {}).ok());
  EXPECT_FALSE(world.SetDrive(99, {}).ok());
  BodyState bad = At(*model, nan, 0);
  EXPECT_FALSE(world.Add(model, bad).ok());
  wire::RopeSpec rope;
  EXPECT_FALSE(world.AddRope(rope).ok());
  rope.from.body_id = static_cast<std::uint32_t>(id);
  rope.length_m = nan;
  EXPECT_FALSE(world.AddRope(rope).ok());
  RunFor(world, water, 1);
  RunFor(untouched, water, 1);
  EXPECT_EQ(world.Hash(), untouched.Hash());

  // The largest impulse that is accepted only cuts the speed.
  EXPECT_TRUE(world.ApplyImpulse(id, {1e9, 1e9, -1e9}, {3, 1, 0}).ok());
  for (int n = 0; n < 600; ++n) {
    world.Step(water, {});
    ASSERT_TRUE(IsFinite(world.FindState(id)->pose.centre_m));
  }
}

// A heap of everything in waves, driven.
void Fill(RigidBodies& world) {
  for (int n = 0; n < 30; ++n) {
    const auto model = Preset(n % 3 == 0 ? "crate" : n % 3 == 1 ? "buoy" : "boat");
    BodyState state = At(*model, 1.5 * (n % 5), 1.5 * (n / 5));
    state.pose.centre_m.z += 0.7 * n;
    state.command.throttle[0] = 0.3;
    state.command.rudder[0] = 0.1 * (n % 7) - 0.3;
    ASSERT_TRUE(world.Add(model, state).ok());
  }
  wire::RopeSpec rope;
  rope.from.body_id = 1;
  rope.to.body_id = 4;
  rope.length_m = 4;
  ASSERT_TRUE(world.AddRope(rope).ok());
}

TEST(RigidBodies, ReplaysBitForBit) {
  RigidBodies a(kStep, nullptr), b(kStep, nullptr), later(kStep, nullptr);
  Fill(a);
  Fill(b);
  Waves water;
  for (int n = 0; n < 240; ++n) {
    water.time_s = n * kStep;
    a.Step(water, {});
    b.Step(water, {});
    ASSERT_EQ(a.Hash(), b.Hash()) << n;
  }
  // From here one goes on after Rebuild(), another starts from what was stored.
  a.Rebuild();
  later.Restore(a.State());
  for (int n = 240; n < 480; ++n) {
    water.time_s = n * kStep;
    a.Step(water, {});
    later.Step(water, {});
    ASSERT_EQ(a.Hash(), later.Hash()) << n;
  }
  EXPECT_EQ(a.fault_count(), 0);
}

// A body moved by its owner pushes others, and its wrench holds its weight.
TEST(RigidBodies, BodiesOfOthersPushAndFloat) {
  BodySpec spec = PresetSpec("work-boat");
  spec.control = BodyControl::kByOwner;
  const auto model = Model(spec, 1025);
  RigidBodies world(kStep, nullptr);
  CalmWater water;
  const BodyId owned = *world.Add(model, At(*model, -10, 0));
  const auto crate = Preset("crate");
  const BodyId pushed = *world.Add(crate, At(*crate, 0, 0));
  BodyState state = At(*model, -10, 0);
  for (int n = 0; n < 300; ++n) {
    state.pose.centre_m.x += 2 * kStep;
    ASSERT_TRUE(world.SetMotion(owned, state.pose, {2, 0, 0}, {}).ok());
    world.Step(water, {});
  }
  EXPECT_GT(world.FindState(pushed)->pose.centre_m.x, 3.0);
  EXPECT_NEAR(world.FindLoads(owned)->wet.pressure_force_n.z, 9000 * sea::kGravity,
              0.01 * 9000 * sea::kGravity);
}

TEST(RigidBodies, StopsAtTheEdgeOfTheWorld) {
  for (const BodyControl control : {BodyControl::kIntegrated, BodyControl::kByOwner}) {
    RigidBodies world(kStep, nullptr);
    BodySpec spec = PresetSpec("crate");
    spec.control = control;
    const auto model = Model(spec, 1025);
    BodyState state = At(*model, kQueryCoordinateMaxM - 1.0, 0);
    state.velocity_m_per_s = {100, 0, 0};
    const BodyId id = *world.Add(model, state);
    CalmWater water;
    for (int n = 0; n < 60; ++n) {
      world.Step(water, {});
      ASSERT_LE(world.FindState(id)->pose.centre_m.x, kQueryCoordinateMaxM);
    }
    EXPECT_GT(world.FindState(id)->pose.centre_m.x,
              kQueryCoordinateMaxM - 2.0);  // it tumbles there
  }
}

}  // namespace
}  // namespace onesea::world
