#include "client/render/ocean_grid.h"

#include <algorithm>
#include <cmath>

namespace onesea::render {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kNearestRadiusM = 0.3;
constexpr int kColumnsMax = 640;
constexpr int kRowsMax = 192;
// Rows are this much denser than square cells: waves are seen edge on.
constexpr double kRowDensity = 0.55;

struct Span {
  double low, high;
};

struct Ray {
  double x, y, z;
};

// The ray through a point of the picture, x and y in [-1, 1]; not normalised.
Ray PictureRay(const Camera& camera, double aspect, double x, double y) {
  const double tangent = std::tan(0.5 * camera.vertical_fov_rad);
  const double cr = std::cos(camera.roll_rad), sr = std::sin(camera.roll_rad);
  const double right = tangent * (aspect * x * cr + y * sr);
  const double up = tangent * (-aspect * x * sr + y * cr);
  const double cp = std::cos(camera.pitch_rad), sp = std::sin(camera.pitch_rad);
  // Yaw 0: forward is +x, right is -y.
  return {cp - up * sp, -right, sp + up * cp};
}

// Azimuths relative to the yaw that the picture covers, and the steepest view downwards.
Span CoveredAzimuth(const Camera& camera, double aspect, double& lowest_elevation_rad) {
  Span span{0.0, 0.0};
  lowest_elevation_rad = kPi / 2;
  bool nadir = false;
  constexpr int kSteps = 16;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const Ray ray = PictureRay(camera, aspect, 2.0 * i / kSteps - 1.0, 2.0 * j / kSteps - 1.0);
      const double flat = std::hypot(ray.x, ray.y);
      const double elevation = std::atan2(ray.z, flat);
      lowest_elevation_rad = std::min(lowest_elevation_rad, elevation);
      if (elevation > 0.2) continue;
      if (elevation < -1.2) nadir = true;
      const double azimuth = std::atan2(ray.y, ray.x);
      span.low = std::min(span.low, azimuth);
      span.high = std::max(span.high, azimuth);
    }
  }
  if (nadir || span.high - span.low > 1.6 * kPi) return {-kPi, kPi};
  return span;
}

}  // namespace

double HorizonDistanceM(double height_m) {
  return std::max(500.0, std::sqrt(2.0 * kEarthRadiusM * std::max(height_m, 0.0)));
}

OceanGrid FitOceanGrid(const Camera& camera, int width, int height, double pixels_per_column,
                       double displacement_max_m) {
  const double aspect = static_cast<double>(width) / height;
  const double eye_height = std::max(std::abs(camera.position_m.z), 0.5);
  double lowest = 0.0;
  Span azimuth = CoveredAzimuth(camera, aspect, lowest);

  // Waves may lean into the picture from the side and from below.
  const double reach = displacement_max_m + 1.0;
  const double crest_height = std::max(camera.position_m.z - displacement_max_m, 0.3);
  const double first_radius =
      lowest > -0.01
          ? kNearestRadiusM
          : std::max(kNearestRadiusM, crest_height / std::tan(std::min(-lowest, 1.55)) - reach);
  const double side = std::min(0.6, std::atan(reach / std::max(first_radius + reach, 1.0)));
  azimuth.low -= side + 0.02;
  azimuth.high += side + 0.02;
  const bool full = azimuth.high - azimuth.low >= 2.0 * kPi;
  if (full) azimuth = {-kPi, kPi};

  const double pixel_rad = 2.0 * std::tan(0.5 * camera.vertical_fov_rad) / height;
  double step = pixel_rad * pixels_per_column;
  // Steps double, so that a lattice is a subset of the next and no vertex wanders.
  const double base = 2.0 * kPi / 4096.0;
  step = base * std::exp2(std::round(std::log2(step / base) * 2.0) / 2.0);
  while ((azimuth.high - azimuth.low) / step > kColumnsMax - 2) step *= std::sqrt(2.0);

  OceanGrid grid;
  const double turns = full ? std::ceil(2.0 * kPi / step) : 0.0;
  if (full) step = 2.0 * kPi / turns;
  grid.azimuth_step_rad = step;
  const double first = std::floor((camera.yaw_rad + azimuth.low) / step);
  grid.first_azimuth_rad = first * step;
  grid.columns =
      full ? static_cast<int>(turns) + 1
           : static_cast<int>(std::ceil((camera.yaw_rad + azimuth.high) / step) - first) + 1;

  const double last_radius = 1.35 * HorizonDistanceM(eye_height + displacement_max_m) + 2000.0;
  grid.log_radius_step =
      std::max(kRowDensity * step, std::log(last_radius / first_radius) / (kRowsMax - 3));
  const double first_row = std::floor(std::log(first_radius) / grid.log_radius_step) - 1.0;
  grid.first_log_radius = first_row * grid.log_radius_step;
  grid.has_nadir = first_radius <= kNearestRadiusM;
  grid.rows = std::min(kRowsMax,
                       static_cast<int>(std::ceil((std::log(last_radius) - grid.first_log_radius) /
                                                  grid.log_radius_step)) +
                           1);
  return grid;
}

}  // namespace onesea::render
