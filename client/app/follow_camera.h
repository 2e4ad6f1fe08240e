#pragma once

#include "client/app/camera_control.h"
#include "client/render/render_frame.h"
#include "common/wire/body_state.h"

namespace onesea::client {

/// A camera behind a boat, as if on a soft rod: it comes round after the bow, rises and falls less
/// than the boat, never rolls. The mouse turns it about the boat, the wheel changes the distance.
class FollowCamera {
 public:
  static constexpr double kDistanceM = 16.0, kHeightM = 5.0;
  static constexpr double kHeadingLagS = 0.7, kHeightLagS = 0.8;
  static constexpr double kClearanceM = 0.7;  ///< over the water below it

  void Move(const CameraInput& input);
  /// The boat now, `seconds` after the last call. The first call, and one after a boat that is more
  /// than 50 m away from the last, takes its place at once.
  void Follow(const wire::BodyState& boat, double seconds);
  /// Over a sea that is `sea_height_m` high at place().
  render::Camera At(double sea_height_m) const;
  Vec2d place() const;

 private:
  bool placed_ = false;
  Vec3d boat_m_;  // its height smoothed
  double heading_rad_ = 0.0;
  double around_rad_ = 0.0, rise_ = 1.0, zoom_ = 1.0;
};

}  // namespace onesea::client
