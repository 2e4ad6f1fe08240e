// Hulls that move ahead at an angle, and what that makes of boats that are driven.
#include "server/world/stern_flow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "server/world/body_from_wire.h"
#include "server/world/body_presets.h"
#include "server/world/hull_shapes.h"
#include "server/world/world.h"
#include "tests/sea/fake_sea.h"
#include "tests/world/wigley.h"

namespace onesea::world {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

Stern SternOfMesh(const TriangleMesh& mesh) { return SternOf(mesh, ComputeSolid(mesh), {}); }

TEST(SternOf, ABoxEndsWithItsWholeSection) {
  const Stern stern = SternOfMesh(BoxMesh({6, 2, 1}));
  EXPECT_NEAR(stern.share, 1.0, 1e-12);
  EXPECT_NEAR(stern.x_m, -3.0, 1e-12);
}

TEST(SternOf, APointedHullHasNone) {
  EXPECT_LT(SternOfMesh(WigleyMesh(10.0, 1.0, 0.6, 0.4, 40, 10)).share, 0.02);
}

// The transom of a boat is a little below its largest section, and its bow is fine: so more than
// the mean.
TEST(SternOf, ABoatHasATransom) {
  const double share = SternOfMesh(BoatMesh({})).share;
  EXPECT_GT(share, 0.9);
  EXPECT_LT(share, 1.8);
}

// Of a slender body with the same section from end to end, at an angle to its course, the momentum
// shed at the stern takes back half of Munk's moment: A U v at half a length.
TEST(SternDamping, TakesHalfOfMunksMomentFromABox) {
  Mat6 added{};
  added[1][1] = 900.0;
  added[2][2] = 2500.0;
  constexpr double kLengthM = 6.0, kAhead = 4.0, kAthwart = 0.3;
  const Mat6 damping = SternDamping({.x_m = -3.0, .share = 1.0}, kLengthM, added, kAhead);
  const double munk = added[1][1] * kAhead * kAthwart;
  EXPECT_NEAR(-damping[5][1] * kAthwart, 0.5 * munk, 1e-9);
  EXPECT_NEAR(std::abs(damping[4][2] * kAthwart), 0.5 * added[2][2] * kAhead * kAthwart, 1e-9);
  // A bow that points up: the hull sinks in its own axes, and the stern is pushed up.
  const double sinking = -0.3;
  EXPECT_GT(-damping[2][2] * sinking, 0.0);
  EXPECT_GT(-damping[4][2] * sinking, 0.0);  // about +y the bow goes down
}

TEST(SternDamping, TakesEnergyOnlyAndOnlyAhead) {
  Mat6 added{};
  added[1][1] = 900.0;
  added[2][2] = 2500.0;
  const Stern stern{.x_m = -2.5, .share = 1.3};
  for (double v : {-1.0, 0.4}) {
    for (double turn : {-0.7, 0.9}) {
      const Vec6 motion{3.0, v, 0.2 * v, 0.1, -turn, turn};
      EXPECT_GE(Dot(motion, SternDamping(stern, 5.0, added, 3.0) * motion), 0.0);
    }
  }
  for (double ahead : {0.0, -2.0, std::nan("")}) {
    EXPECT_EQ(SternDamping(stern, 5.0, added, ahead), Mat6{});
  }
}

// What a driver meets in calm water: full ahead, ten seconds hard over, and the wheel let go.
struct Trial {
  double speed_m_per_s = 0, pitch_max_deg = 0, heel_max_deg = 0, turn_rad_per_s = 0,
         turn_after_rad_per_s = 0;
};
Trial TryOut(const char* preset) {
  const auto calm =
      sea::FakeSea({.lengths_m = {97.0}, .index_max = 4, .hs_m = 1e-6, .query_grid_size = 64});
  World world{WorldOptions{}};
  PreparedBody body;
  body.model = *MakeBodyModel(*FromWire(*BodyPreset(preset)));
  const std::uint32_t id = *world.Spawn(body, {});
  Tick tick = 0;
  Trial trial;
  const auto run = [&](double seconds, double throttle, double rudder) {
    EXPECT_TRUE(world.Apply(wire::DriveBody{id, {throttle}, {rudder}}).ok());
    for (const Tick end = tick + std::lround(60.0 * seconds); tick < end;) {
      world.Step(++tick, calm);
      const Quaternion turn = world.view()->bodies[0].state.turn;
      trial.pitch_max_deg =
          std::max(trial.pitch_max_deg, std::abs(std::asin(Rotate(turn, {1, 0, 0}).z)) / kDegree);
      trial.heel_max_deg =
          std::max(trial.heel_max_deg, std::abs(std::asin(Rotate(turn, {0, 1, 0}).z)) / kDegree);
    }
    return world.view()->bodies[0].state;
  };
  run(5.0, 0.0, 0.0);
  trial.speed_m_per_s = Norm(run(20.0, 1.0, 0.0).velocity_m_per_s);
  trial.turn_rad_per_s = run(10.0, 1.0, 1.0).spin_rad_per_s.z;
  trial.turn_after_rad_per_s = run(5.0, 1.0, 0.0).spin_rad_per_s.z;
  return trial;
}

TEST(Driving, AMotorBoatKeepsItsTrimAndComesOutOfATurn) {
  const Trial trial = TryOut("boat");
  EXPECT_GT(trial.speed_m_per_s, 6.0);
  EXPECT_LT(trial.pitch_max_deg, 6.0);
  EXPECT_LT(trial.heel_max_deg, 30.0);
  EXPECT_GT(trial.turn_rad_per_s, 0.4);
  EXPECT_LT(std::abs(trial.turn_after_rad_per_s), 0.03);
}

TEST(Driving, AWorkBoatKeepsItsTrimAndComesOutOfATurn) {
  const Trial trial = TryOut("work-boat");
  EXPECT_GT(trial.speed_m_per_s, 4.0);
  EXPECT_LT(trial.pitch_max_deg, 6.0);
  EXPECT_LT(trial.heel_max_deg, 15.0);
  EXPECT_GT(trial.turn_rad_per_s, 0.2);
  EXPECT_LT(std::abs(trial.turn_after_rad_per_s), 0.03);
}

}  // namespace
}  // namespace onesea::world
