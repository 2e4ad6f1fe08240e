#include "client/app/camera_control.h"

#include <gtest/gtest.h>

#include <cmath>

namespace onesea::client {
namespace {

TEST(CameraControl, UnknownPresetNamesTheKnownOnes) {
  const auto control = CameraControl::FromPreset("moon", 0.0);
  ASSERT_FALSE(control.ok());
  EXPECT_NE(control.status().message().find("deck"), std::string_view::npos);
}

TEST(CameraControl, FliesWhereItLooks) {
  CameraControl control = *CameraControl::FromPreset("bridge", M_PI / 2);  // north
  control.Move({.forward = 1.0}, 1.0);
  EXPECT_NEAR(control.place().x, 0.0, 1e-9);
  EXPECT_GT(control.place().y, 1.0);
  const double north = control.place().y;
  control.Move({.right = 1.0}, 1.0);  // east
  EXPECT_GT(control.place().x, 1.0);
  EXPECT_NEAR(control.place().y, north, 1e-9);
}

TEST(CameraControl, OrbitKeepsItsDistanceAndPoint) {
  CameraControl control = *CameraControl::FromPreset("orbit", 0.3);
  const auto centre = [&] {
    const render::Camera camera = control.At(-1000.0);
    const double c = std::cos(camera.pitch_rad);
    return Vec3d{camera.position_m.x + 60 * c * std::cos(camera.yaw_rad),
                 camera.position_m.y + 60 * c * std::sin(camera.yaw_rad),
                 camera.position_m.z + 60 * std::sin(camera.pitch_rad)};
  };
  const Vec3d before = centre();
  for (int n = 0; n < 20; ++n) control.Move({.right = 1.0, .turn_px = 30, .tilt_px = -10}, 0.1);
  const Vec3d after = centre();
  EXPECT_NEAR(before.x, after.x, 1e-9);
  EXPECT_NEAR(before.y, after.y, 1e-9);
  EXPECT_NEAR(before.z, after.z, 1e-9);
}

TEST(CameraControl, StaysAboveTheWaves) {
  const CameraControl control = *CameraControl::FromPreset("deck", 0.0);
  EXPECT_GE(control.At(9.0).position_m.z, 9.5);
  EXPECT_NEAR(control.At(1.0).position_m.z, 4.6, 1e-9);  // rides six tenths of the swell
}

}  // namespace
}  // namespace onesea::client
