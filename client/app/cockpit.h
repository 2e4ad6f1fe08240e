#pragma once

#include "client/app/camera_control.h"
#include "client/app/follow_camera.h"
#include "client/app/sea_source.h"
#include "client/app/skipper.h"

namespace onesea::client {

/// Hands and eyes of the person at a viewer: the boat and the camera. A new boat is followed; the
/// camera goes free where it is when its boat has gone, or by ToggleFollow(). One thread.
class Cockpit {
 public:
  /// `source` outlives this.
  Cockpit(SeaSource& source, const CameraControl& camera);

  /// Once a picture, at its time `now`; `seconds` of real time since the last call.
  void Update(const SkipperInput& keys, const CameraInput& camera, SimTime now, double seconds);
  /// Follows the boat, or flies; without a boat it flies.
  void ToggleFollow();
  void ToggleOrbit();

  const std::optional<wire::BodyState>& own() const { return skipper_.own(); }
  HelmReport report() const { return skipper_.report(); }
  bool following() const { return following_; }
  Vec2d place() const { return following_ ? follow_.place() : camera_.place(); }
  /// Over a sea that is `sea_height_m` high at place().
  render::Camera At(double sea_height_m) const;

 private:
  SeaSource& source_;
  Skipper skipper_;
  CameraControl camera_;
  FollowCamera follow_;
  std::shared_ptr<const sea::Terrain> terrain_;  // as of the last Update()
  bool following_ = false, had_boat_ = false;
};

}  // namespace onesea::client
