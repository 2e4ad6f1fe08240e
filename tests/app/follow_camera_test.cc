#include "client/app/follow_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace onesea::client {
namespace {

wire::BodyState BoatAt(Vec3d position_m, double heading_rad) {
  wire::BodyState boat;
  boat.position_m = position_m;
  boat.turn = TurnBy({0, 0, heading_rad});
  return boat;
}

TEST(FollowCamera, StandsAsternAndLooksAtTheBoat) {
  FollowCamera camera;
  const double heading = 0.5 * std::numbers::pi;  // north
  camera.Follow(BoatAt({10, 20, 0}, heading), 0.0);
  const render::Camera view = camera.At(0.0);
  EXPECT_NEAR(view.position_m.x, 10.0, 1e-9);
  EXPECT_NEAR(view.position_m.y, 20.0 - FollowCamera::kDistanceM, 1e-9);
  EXPECT_NEAR(view.yaw_rad, heading, 1e-9);
  // The line of sight meets the boat's place within its height.
  const double z = view.position_m.z + FollowCamera::kDistanceM * std::tan(view.pitch_rad);
  EXPECT_GT(z, 0.0);
  EXPECT_LT(z, 2.0);
}

TEST(FollowCamera, ComesRoundAfterTheBowWithoutAJump) {
  FollowCamera camera;
  camera.Follow(BoatAt({}, 3.0), 0.0);
  double last = camera.At(0.0).yaw_rad;
  for (int n = 0; n < 300; ++n) {
    camera.Follow(BoatAt({}, -3.0), 1.0 / 60.0);  // over the side where the angle wraps
    const double yaw = camera.At(0.0).yaw_rad;
    EXPECT_LT(std::abs(std::remainder(yaw - last, 2.0 * std::numbers::pi)), 0.02);
    last = yaw;
  }
  EXPECT_NEAR(std::remainder(last + 3.0, 2.0 * std::numbers::pi), 0.0, 1e-3);
}

TEST(FollowCamera, KeepsAboveTheWater) {
  FollowCamera camera;
  camera.Follow(BoatAt({0, 0, -1}, 0.0), 0.0);
  camera.Move({.tilt_px = -10'000});
  EXPECT_GE(camera.At(6.0).position_m.z, 6.0 + FollowCamera::kClearanceM);
}

TEST(FollowCamera, HeavesLessThanTheBoat) {
  FollowCamera camera;
  double lowest = 1e9, highest = -1e9;
  for (int n = 0; n < 1200; ++n) {
    const double t = n / 60.0, heave_m = std::sin(2.0 * std::numbers::pi * t / 3.0);
    camera.Follow(BoatAt({5.0 * t, 0, heave_m}, 0.0), 1.0 / 60.0);
    if (t < 10.0) continue;
    lowest = std::min(lowest, camera.At(-100.0).position_m.z);
    highest = std::max(highest, camera.At(-100.0).position_m.z);
  }
  // A first-order lag passes 1/sqrt(1 + (2 pi 0.8/3)²) = 0.51 of a wave of 3 s.
  EXPECT_NEAR(highest - lowest, 2.0 * 0.51, 0.05);
}

TEST(FollowCamera, TurnsAroundTheBoatAndZooms) {
  FollowCamera camera;
  camera.Follow(BoatAt({}, 0.0), 0.0);
  camera.Move({.turn_px = 300, .zoom = 3});
  const render::Camera view = camera.At(-100.0);
  const double distance = std::hypot(view.position_m.x, view.position_m.y);
  EXPECT_NEAR(distance, FollowCamera::kDistanceM * std::exp(-0.3), 1e-9);
  // It still looks at the boat.
  EXPECT_NEAR(view.position_m.x + distance * std::cos(view.yaw_rad), 0.0, 1e-9);
  EXPECT_NEAR(view.position_m.y + distance * std::sin(view.yaw_rad), 0.0, 1e-9);
  EXPECT_GT(std::abs(view.yaw_rad), 0.5);
}

TEST(FollowCamera, AnotherPlaceIsTakenAtOnce) {
  FollowCamera camera;
  camera.Follow(BoatAt({}, 0.0), 0.0);
  camera.Follow(BoatAt({900, 0, 0}, 2.0), 1.0 / 60.0);
  EXPECT_NEAR(camera.At(0.0).yaw_rad, 2.0, 1e-9);
}

}  // namespace
}  // namespace onesea::client
