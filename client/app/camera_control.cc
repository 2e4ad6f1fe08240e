#include "client/app/camera_control.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "absl/strings/str_cat.h"

namespace onesea::client {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kPixelRad = 0.0025;
constexpr double kClearanceM = 0.5;

struct Preset {
  const char* name;
  double height_m, pitch_deg, fov_deg;
  bool rides, orbits;
};
constexpr Preset kPresets[] = {
    {"deck", 4.0, -3.0, 45.0, true, false},    {"bridge", 20.0, -8.0, 45.0, false, false},
    {"mast", 50.0, -17.0, 45.0, false, false}, {"swimmer", 0.7, 2.0, 50.0, true, false},
    {"orbit", 14.0, -12.0, 45.0, false, true},
};

}  // namespace

absl::StatusOr<CameraControl> CameraControl::FromPreset(std::string_view preset,
                                                        double heading_rad) {
  std::string names;
  for (const Preset& known : kPresets) {
    if (preset == known.name) {
      CameraControl control;
      control.camera_.position_m = {0.0, 0.0, known.height_m};
      control.camera_.yaw_rad = heading_rad;
      control.camera_.pitch_rad = known.pitch_deg * kDegree;
      control.camera_.vertical_fov_rad = known.fov_deg * kDegree;
      control.rides_ = known.rides;
      if (known.orbits) control.ToggleOrbit();
      return control;
    }
    absl::StrAppend(&names, names.empty() ? "" : ", ", known.name);
  }
  return absl::InvalidArgumentError(
      absl::StrCat("--camera=", std::string(preset), ": choose one of ", names));
}

void CameraControl::PlaceAt(Vec3d position, double pitch_rad) {
  camera_.position_m = position;
  camera_.pitch_rad = pitch_rad;
  rides_ = orbiting_ = false;
}

void CameraControl::ToggleOrbit() {
  orbiting_ = !orbiting_;
  if (!orbiting_) return;
  const double reach = distance_m_ * std::cos(camera_.pitch_rad);
  centre_ = {camera_.position_m.x + reach * std::cos(camera_.yaw_rad),
             camera_.position_m.y + reach * std::sin(camera_.yaw_rad),
             camera_.position_m.z + distance_m_ * std::sin(camera_.pitch_rad)};
}

void CameraControl::TakeOver(const render::Camera& camera) {
  camera_ = camera;
  orbiting_ = false;
  rides_ = false;
}

void CameraControl::Move(const CameraInput& input, double seconds) {
  camera_.yaw_rad -= input.turn_px * kPixelRad;
  camera_.pitch_rad = std::clamp(camera_.pitch_rad - input.tilt_px * kPixelRad, -1.5, 1.5);
  const double c = std::cos(camera_.yaw_rad), s = std::sin(camera_.yaw_rad);
  if (orbiting_) {
    distance_m_ = std::clamp(distance_m_ * std::exp(-0.1 * input.zoom - input.forward * seconds),
                             3.0, 5000.0);
    camera_.yaw_rad += 0.5 * input.right * seconds;
    camera_.pitch_rad = std::clamp(camera_.pitch_rad - 0.5 * input.up * seconds, -1.5, 1.5);
    const double reach = distance_m_ * std::cos(camera_.pitch_rad);
    camera_.position_m = {centre_.x - reach * std::cos(camera_.yaw_rad),
                          centre_.y - reach * std::sin(camera_.yaw_rad),
                          centre_.z - distance_m_ * std::sin(camera_.pitch_rad)};
    return;
  }
  // Speed grows with height: a metre matters at the surface, not a kilometre up.
  const double speed = (4.0 + 0.6 * std::abs(camera_.position_m.z)) * (input.fast ? 6.0 : 1.0);
  const double step = speed * seconds;
  camera_.position_m.x += step * (input.forward * c + input.right * s);
  camera_.position_m.y += step * (input.forward * s - input.right * c);
  camera_.position_m.z = std::clamp(camera_.position_m.z + step * input.up, -30.0, 20'000.0);
  camera_.vertical_fov_rad =
      std::clamp(camera_.vertical_fov_rad * std::exp(-0.05 * input.zoom), 0.15, 1.6);
}

render::Camera CameraControl::At(double sea_height_m) const {
  render::Camera camera = camera_;
  if (camera.position_m.z < -1.0) return camera;
  if (rides_) camera.position_m.z += 0.6 * sea_height_m;
  camera.position_m.z = std::max(camera.position_m.z, sea_height_m + kClearanceM);
  return camera;
}

}  // namespace onesea::client
