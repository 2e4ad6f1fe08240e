#include "client/app/follow_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "client/model/boat_figures.h"

namespace onesea::client {
namespace {

constexpr double kPixelRad = 0.005;
constexpr double kElsewhereM = 50.0;
constexpr double kLookAboveM = 1.2;  // at the wheelhouse, not at the keel

double Share(double seconds, double lag_s) { return 1.0 - std::exp(-seconds / lag_s); }

}  // namespace

void FollowCamera::Move(const CameraInput& input) {
  around_rad_ = std::remainder(around_rad_ - kPixelRad * input.turn_px, 2.0 * std::numbers::pi);
  rise_ = std::clamp(rise_ + kPixelRad * input.tilt_px, 0.1, 6.0);
  zoom_ = std::clamp(zoom_ * std::exp(-0.1 * input.zoom), 0.4, 12.0);
}

void FollowCamera::Follow(const wire::BodyState& boat, double seconds) {
  const double heading = HeadingOf(boat.turn);
  if (!placed_ || !(Norm(boat.position_m - boat_m_) < kElsewhereM)) {
    placed_ = true;
    boat_m_ = boat.position_m;
    heading_rad_ = heading;
    return;
  }
  seconds = std::max(seconds, 0.0);
  heading_rad_ +=
      Share(seconds, kHeadingLagS) * std::remainder(heading - heading_rad_, 2.0 * std::numbers::pi);
  boat_m_ = {boat.position_m.x, boat.position_m.y,
             boat_m_.z + Share(seconds, kHeightLagS) * (boat.position_m.z - boat_m_.z)};
}

Vec2d FollowCamera::place() const {
  const double heading = heading_rad_ + around_rad_;
  return {boat_m_.x - zoom_ * kDistanceM * std::cos(heading),
          boat_m_.y - zoom_ * kDistanceM * std::sin(heading)};
}

render::Camera FollowCamera::At(double sea_height_m) const {
  const Vec2d here = place();
  render::Camera camera;
  camera.position_m = {here.x, here.y,
                       std::max(boat_m_.z + zoom_ * rise_ * kHeightM, sea_height_m + kClearanceM)};
  camera.yaw_rad = heading_rad_ + around_rad_;
  camera.pitch_rad = std::atan2(boat_m_.z + kLookAboveM - camera.position_m.z, zoom_ * kDistanceM);
  return camera;
}

}  // namespace onesea::client
