#pragma once

#include <string_view>

#include "absl/status/statusor.h"
#include "client/render/render_frame.h"

namespace onesea::client {

/// One frame's worth of what a person's hands did.
struct CameraInput {
  double forward = 0, right = 0, up = 0;  ///< [-1, 1], keys held
  double turn_px = 0, tilt_px = 0;        ///< mouse drag
  double zoom = 0;                        ///< wheel steps
  bool fast = false;
};

/// A camera that flies or circles a point, and may ride the waves.
class CameraControl {
 public:
  /// Presets: "deck" (4 m, rides the swell), "bridge" (20 m), "mast" (50 m), "swimmer" (0.7 m),
  /// "orbit" (circles a point 60 m away). InvalidArgument listing them for another name.
  static absl::StatusOr<CameraControl> FromPreset(std::string_view preset, double heading_rad);

  /// A camera that stays at a place.
  void PlaceAt(Vec3d position_m, double pitch_rad);

  void Move(const CameraInput& input, double seconds);
  void ToggleOrbit();
  /// Flies from where another camera is.
  void TakeOver(const render::Camera& camera);
  /// The camera over a sea that is `sea_height_m` high below it: never closer than 0.5 m unless it
  /// was flown under water on purpose (below -1 m).
  render::Camera At(double sea_height_m) const;
  Vec2d place() const { return {camera_.position_m.x, camera_.position_m.y}; }
  bool orbiting() const { return orbiting_; }

 private:
  render::Camera camera_;
  bool orbiting_ = false;
  bool rides_ = false;
  Vec3d centre_;
  double distance_m_ = 60.0;
};

}  // namespace onesea::client
