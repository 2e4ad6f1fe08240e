#include "client/app/cockpit.h"

#include <algorithm>

#include "common/base/clock.h"
#include "common/sea/attenuation.h"

namespace onesea::client {
namespace {

constexpr double kPictureSecondsMax = 0.2;  // of flight in one picture

}  // namespace

Cockpit::Cockpit(SeaSource& source, const CameraControl& camera)
    : source_(source), skipper_(source.commands()), camera_(camera) {}

void Cockpit::Update(const SkipperInput& keys, const CameraInput& camera, SimTime now,
                     double seconds) {
  const std::shared_ptr<const WorldView> world = source_.world();
  const WorldView nothing;
  const std::shared_ptr<const sea::Components> components = source_.components();
  terrain_ = sea::TerrainOf(*components);
  const Outlook outlook{place(), At(0.0).yaw_rad};
  skipper_.Update(keys, outlook, world != nullptr ? *world : nothing,
                  {.now = now,
                   .tick_rate_hz = components->recipe.tick_rate_hz,
                   .seconds = seconds,
                   .now_ns = SystemClock().MonotonicNs(),
                   .terrain = terrain_.get()});
  if (own()) {
    if (!had_boat_) {
      follow_ = FollowCamera();
      following_ = true;
    }
    follow_.Follow(*own(), seconds);
  } else if (following_) {
    ToggleFollow();
  }
  had_boat_ = own().has_value();
  if (following_) {
    follow_.Move(camera);
  } else {
    camera_.Move(camera, std::min(seconds, kPictureSecondsMax));
  }
}

void Cockpit::ToggleFollow() {
  if (following_) {
    camera_.TakeOver(follow_.At(0.0));
    following_ = false;
  } else {
    following_ = own().has_value();
  }
}

void Cockpit::ToggleOrbit() {
  if (following_) ToggleFollow();
  camera_.ToggleOrbit();
}

render::Camera Cockpit::At(double sea_height_m) const {
  if (!following_) return camera_.At(sea_height_m);
  // Behind a boat that leaves a quay there is land.
  return follow_.At(terrain_ == nullptr ? sea_height_m
                                        : std::max(sea_height_m, terrain_->ElevationAt(place())));
}

}  // namespace onesea::client
