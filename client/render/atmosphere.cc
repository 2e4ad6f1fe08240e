#include "client/render/atmosphere.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

namespace onesea::render {
namespace {

constexpr float kPi = 3.14159265f;
constexpr float kGround = 6'360'000.0f;
constexpr float kTop = 6'460'000.0f;
constexpr float kSeaLevelEye = kGround + 5.0f;
constexpr float kMieScaleHeight = 1200.0f;
constexpr float kMieAsymmetry = 0.77f;
constexpr float kMieSingleAlbedo = 0.96f;  // sea salt absorbs little
constexpr float kGroundAlbedo = 0.07f;     // of the sea, seen from above
constexpr float kMieOpticalDepthMax = 0.5f;
const glm::vec3 kRayleigh(5.80e-6f, 13.56e-6f, 33.1e-6f);
const glm::vec3 kOzone(0.65e-6f, 1.88e-6f, 0.085e-6f);

constexpr int kHeights = 32, kAngles = 128;
constexpr int kMultiHeights = 12, kMultiAngles = 24;

float DistanceToTop(float radius, float mu) {
  const float discriminant = radius * radius * (mu * mu - 1.0f) + kTop * kTop;
  return std::max(0.0f, -radius * mu + std::sqrt(std::max(0.0f, discriminant)));
}

// Negative when the ray misses the ground.
float DistanceToGround(float radius, float mu) {
  const float discriminant = radius * radius * (mu * mu - 1.0f) + kGround * kGround;
  if (mu >= 0.0f || discriminant < 0.0f) return -1.0f;
  return -radius * mu - std::sqrt(discriminant);
}

float RayleighPhase(float cosine) { return 3.0f / (16.0f * kPi) * (1.0f + cosine * cosine); }

float MiePhase(float cosine) {
  const float g = kMieAsymmetry;
  const float base = 1.0f + g * g - 2.0f * g * cosine;
  return 3.0f / (8.0f * kPi) * (1.0f - g * g) * (1.0f + cosine * cosine) /
         ((2.0f + g * g) * base * std::sqrt(base));
}

// Table coordinates: angles crowd around the horizon, heights around the ground.
float AngleToUnit(float mu) { return 0.5f + 0.5f * std::copysign(std::sqrt(std::abs(mu)), mu); }
float UnitToAngle(float unit) {
  const float x = 2.0f * unit - 1.0f;
  return std::copysign(x * x, x);
}
float HeightToUnit(float radius) {
  return std::sqrt(std::clamp((radius - kGround) / (kTop - kGround), 0.0f, 1.0f));
}
float UnitToHeight(float unit) { return kGround + unit * unit * (kTop - kGround); }

glm::vec3 Bilinear(const std::vector<glm::vec3>& table, int width, int height, float x, float y) {
  const float column = std::clamp(x, 0.0f, 1.0f) * static_cast<float>(width - 1);
  const float row = std::clamp(y, 0.0f, 1.0f) * static_cast<float>(height - 1);
  const int i = std::min(static_cast<int>(column), width - 2);
  const int j = std::min(static_cast<int>(row), height - 2);
  const float fx = column - static_cast<float>(i), fy = row - static_cast<float>(j);
  const glm::vec3* at = &table[static_cast<std::size_t>(j * width + i)];
  return glm::mix(glm::mix(at[0], at[1], fx), glm::mix(at[width], at[width + 1], fx), fy);
}

}  // namespace

Atmosphere::Atmosphere(double visibility_m) {
  const float total = 3.912f / static_cast<float>(visibility_m);
  mie_extinction_per_m_ =
      std::clamp(total - kRayleigh.y, 2.0e-6f, kMieOpticalDepthMax / kMieScaleHeight);
  FillTransmittance();
  FillMultipleScattering();
}

Atmosphere::Medium Atmosphere::At(float radius_m) const {
  const float height = std::max(0.0f, radius_m - kGround);
  const float mie = mie_extinction_per_m_ * std::exp(-height / kMieScaleHeight);
  const float ozone = std::max(0.0f, 1.0f - std::abs(height - 25'000.0f) / 15'000.0f);
  Medium medium;
  medium.rayleigh = kRayleigh * std::exp(-height / 8000.0f);
  medium.mie = glm::vec3(mie * kMieSingleAlbedo);
  medium.extinction = medium.rayleigh + glm::vec3(mie) + kOzone * ozone;
  return medium;
}

glm::vec3 Atmosphere::OpticalDepth(float radius_m, float mu) const {
  constexpr int kSteps = 48;
  const float length = DistanceToTop(radius_m, mu);
  glm::vec3 depth(0.0f);
  for (int i = 0; i < kSteps; ++i) {
    // Steps grow with distance: most of the air is near the ground end.
    const float a = static_cast<float>(i) / kSteps, b = static_cast<float>(i + 1) / kSteps;
    const float t = length * 0.5f * (a * a + b * b), dt = length * (b * b - a * a);
    const float r = std::sqrt(radius_m * radius_m + t * t + 2.0f * radius_m * mu * t);
    depth += At(r).extinction * dt;
  }
  return depth;
}

void Atmosphere::FillTransmittance() {
  transmittance_.resize(kHeights * kAngles);
  for (int j = 0; j < kHeights; ++j) {
    const float radius = UnitToHeight(static_cast<float>(j) / (kHeights - 1));
    for (int i = 0; i < kAngles; ++i) {
      const float mu = UnitToAngle(static_cast<float>(i) / (kAngles - 1));
      transmittance_[static_cast<std::size_t>(j * kAngles + i)] =
          glm::exp(-OpticalDepth(std::max(radius, kSeaLevelEye), std::max(mu, -0.2f)));
    }
  }
}

// Zero below the geometric horizon, with the softness of the sun's disc.
glm::vec3 Atmosphere::Transmittance(float radius_m, float mu) const {
  const float sine = kGround / radius_m;
  const float horizon = -std::sqrt(std::max(0.0f, 1.0f - sine * sine));
  const float visible = std::clamp((mu - horizon + 0.0045f) / 0.009f, 0.0f, 1.0f);
  if (visible <= 0.0f) return glm::vec3(0.0f);
  return visible *
         Bilinear(transmittance_, kAngles, kHeights, AngleToUnit(mu), HeightToUnit(radius_m));
}

glm::vec3 Atmosphere::MultipleScattering(float radius_m, float mu_sun) const {
  return Bilinear(multiple_, kMultiAngles, kMultiHeights, 0.5f * mu_sun + 0.5f,
                  HeightToUnit(radius_m));
}

// Ψ at one point: light that arrives after two or more scatterings, per solar irradiance.
glm::vec3 Atmosphere::IntegrateIsotropic(float radius_m, float mu_sun) const {
  constexpr int kDirections = 48, kSteps = 14;
  const float sun_sine = std::sqrt(std::max(0.0f, 1.0f - mu_sun * mu_sun));
  glm::vec3 second(0.0f), fraction(0.0f);
  for (int n = 0; n < kDirections; ++n) {
    // A Fibonacci spiral covers the sphere evenly.
    const float mu = 1.0f - (2.0f * static_cast<float>(n) + 1.0f) / kDirections;
    const float azimuth = 2.39996323f * static_cast<float>(n);
    const float sun_cosine = mu * mu_sun + std::sqrt(1.0f - mu * mu) * sun_sine * std::cos(azimuth);
    const float ground = DistanceToGround(radius_m, mu);
    const float length = ground >= 0.0f ? ground : DistanceToTop(radius_m, mu);
    glm::vec3 through(1.0f);
    for (int i = 0; i < kSteps; ++i) {
      const float a = static_cast<float>(i) / kSteps, b = static_cast<float>(i + 1) / kSteps;
      const float t = length * 0.5f * (a * a + b * b), dt = length * (b * b - a * a);
      const float r = std::sqrt(radius_m * radius_m + t * t + 2.0f * radius_m * mu * t);
      const Medium medium = At(r);
      const glm::vec3 step = glm::exp(-medium.extinction * dt);
      const glm::vec3 scattered =
          (medium.rayleigh + medium.mie) * (1.0f - step) / medium.extinction;
      const glm::vec3 sun = Transmittance(r, (radius_m * mu_sun + t * sun_cosine) / r);
      second += through * scattered * sun / (4.0f * kPi);
      fraction += through * scattered;
      through *= step;
    }
    if (ground >= 0.0f) {
      const float mu_ground = (radius_m * mu_sun + length * sun_cosine) / kGround;
      second += through * Transmittance(kSeaLevelEye, mu_ground) * std::max(0.0f, mu_ground) *
                (kGroundAlbedo / kPi);
    }
  }
  second /= static_cast<float>(kDirections);
  fraction /= static_cast<float>(kDirections);
  return second / (1.0f - fraction);
}

void Atmosphere::FillMultipleScattering() {
  multiple_.resize(kMultiHeights * kMultiAngles);
  for (int j = 0; j < kMultiHeights; ++j) {
    const float radius = UnitToHeight(static_cast<float>(j) / (kMultiHeights - 1));
    for (int i = 0; i < kMultiAngles; ++i) {
      multiple_[static_cast<std::size_t>(j * kMultiAngles + i)] =
          IntegrateIsotropic(std::clamp(radius, kSeaLevelEye, kTop - 10.0f),
                             2.0f * static_cast<float>(i) / (kMultiAngles - 1) - 1.0f);
    }
  }
}

glm::vec3 Atmosphere::SunTransmittance(double sun_elevation_rad) const {
  return Transmittance(kSeaLevelEye, static_cast<float>(std::sin(sun_elevation_rad)));
}

glm::vec3 Atmosphere::SkyRadiance(double elevation_rad, double azimuth_rad,
                                  double sun_elevation_rad) const {
  constexpr int kSteps = 36;
  const float mu = static_cast<float>(std::sin(elevation_rad));
  const float mu_sun = static_cast<float>(std::sin(sun_elevation_rad));
  const float cosine = static_cast<float>(std::sin(elevation_rad) * std::sin(sun_elevation_rad) +
                                          std::cos(elevation_rad) * std::cos(sun_elevation_rad) *
                                              std::cos(azimuth_rad));
  const float rayleigh_phase = RayleighPhase(cosine), mie_phase = MiePhase(cosine);
  const float length = DistanceToTop(kSeaLevelEye, mu);
  glm::vec3 radiance(0.0f), through(1.0f);
  for (int i = 0; i < kSteps; ++i) {
    const float a = static_cast<float>(i) / kSteps, b = static_cast<float>(i + 1) / kSteps;
    const float t = length * 0.5f * (a * a + b * b), dt = length * (b * b - a * a);
    const float r = std::sqrt(kSeaLevelEye * kSeaLevelEye + t * t + 2.0f * kSeaLevelEye * mu * t);
    const float mu_here = (kSeaLevelEye * mu_sun + t * cosine) / r;
    const Medium medium = At(r);
    const glm::vec3 step = glm::exp(-medium.extinction * dt);
    const glm::vec3 source =
        (medium.rayleigh * rayleigh_phase + medium.mie * mie_phase) * Transmittance(r, mu_here) +
        (medium.rayleigh + medium.mie) * MultipleScattering(r, mu_here);
    radiance += through * source * (1.0f - step) / medium.extinction;
    through *= step;
  }
  return radiance;
}

glm::vec3 Atmosphere::SeaLevelExtinction() const {
  return kRayleigh + glm::vec3(mie_extinction_per_m_);
}

}  // namespace onesea::render
