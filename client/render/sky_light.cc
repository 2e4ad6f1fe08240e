#include "client/render/sky_light.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace onesea::render {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kColumns = SkyLight::kColumns, kRows = SkyLight::kRows;
constexpr double kMeteredRadiance = 0.42;
constexpr double kBrightMax = 1.1;
// Thick cloud is neutral once the film is balanced for sun and blue sky together.
const glm::vec3 kCloudTint(0.975f, 1.0f, 0.99f);
// Airglow and stars, so that a moonless night is dark and not black.
const glm::vec3 kNightRadiance(0.9e-6f, 1.2e-6f, 2.0e-6f);
const glm::vec3 kLuminance(0.2126f, 0.7152f, 0.0722f);

double RowElevation(int row) {
  const double unit = static_cast<double>(row) / (kRows - 1);
  return std::asin(unit * unit);
}

std::size_t At(int level, int row, int column) {
  return static_cast<std::size_t>((level * kRows + row) * kColumns + column);
}

// Solid angle of a map cell.
double CellSr(int row) {
  const double below = row == 0 ? 0.0 : 0.5 * (RowElevation(row) + RowElevation(row - 1));
  const double above =
      row == kRows - 1 ? 0.5 * kPi : 0.5 * (RowElevation(row) + RowElevation(row + 1));
  return (std::sin(above) - std::sin(below)) * 2.0 * kPi / kColumns;
}

void FillClearSky(const Atmosphere& atmosphere, double sun_elevation_rad, SkyLight& light) {
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column <= kColumns / 2; ++column) {
      const glm::vec3 value =
          atmosphere.SkyRadiance(RowElevation(row), 2.0 * kPi * column / kColumns,
                                 sun_elevation_rad) +
          kNightRadiance;
      light.radiance[At(0, row, column)] = value;
      light.radiance[At(0, row, (kColumns - column) % kColumns)] = value;
    }
  }
}

glm::vec3 HorizontalIrradiance(const SkyLight& light) {
  glm::vec3 sum(0.0f);
  for (int row = 0; row < kRows; ++row) {
    const float weight = static_cast<float>(CellSr(row) * std::sin(RowElevation(row)));
    for (int column = 0; column < kColumns; ++column)
      sum += weight * light.radiance[At(0, row, column)];
  }
  return sum;
}

// Clouds as the blurred reflection sees them: their share of the sky at each elevation. Seen
// slantwise a broken layer closes up, so the share grows towards the horizon.
void AddMeanClouds(double cover, SkyLight& light) {
  if (cover <= 0.0) return;
  for (int row = 0; row < kRows; ++row) {
    const double sine = std::sin(RowElevation(row));
    const double share =
        std::pow(cover, 1.0 + 1.6 * sine) * std::min(1.0, 0.25 + 0.75 * cover + sine);
    const glm::vec3 cloud = light.cloud_radiance * static_cast<float>(0.72 + 0.56 * sine);
    for (int column = 0; column < kColumns; ++column) {
      glm::vec3& value = light.radiance[At(0, row, column)];
      value = glm::mix(value, cloud, static_cast<float>(std::clamp(share, 0.0, 1.0)));
    }
  }
}

// Gaussian over azimuth (wider near the zenith) then over elevation, mirrored at the horizon: a
// reflected ray that would go below it is bent up again by the next wave.
void Blur(int level, SkyLight& light) {
  const double sigma = SkyLight::kBlurRad[level];
  std::vector<glm::vec3> turned(static_cast<std::size_t>(kRows) * kColumns);
  for (int row = 0; row < kRows; ++row) {
    const double width =
        std::min(sigma / std::max(0.05, std::cos(RowElevation(row))), 3.0) * kColumns / (2 * kPi);
    const int reach = std::min(kColumns / 2, static_cast<int>(std::ceil(2.5 * width)));
    for (int column = 0; column < kColumns; ++column) {
      glm::vec3 sum(0.0f);
      float weights = 0.0f;
      for (int d = -reach; d <= reach; ++d) {
        const float w = static_cast<float>(std::exp(-0.5 * d * d / (width * width)));
        sum += w * light.radiance[At(0, row, (column + d + kColumns) % kColumns)];
        weights += w;
      }
      turned[static_cast<std::size_t>(row * kColumns + column)] = sum / weights;
    }
  }
  for (int row = 0; row < kRows; ++row) {
    std::vector<float> weights(kRows);
    float total = 0.0f;
    for (int other = 0; other < kRows; ++other) {
      const auto gauss = [&](double d) { return std::exp(-0.5 * d * d / (sigma * sigma)); };
      weights[static_cast<std::size_t>(other)] =
          static_cast<float>(CellSr(other) * (gauss(RowElevation(row) - RowElevation(other)) +
                                              gauss(RowElevation(row) + RowElevation(other))));
      total += weights[static_cast<std::size_t>(other)];
    }
    for (int column = 0; column < kColumns; ++column) {
      glm::vec3 sum(0.0f);
      for (int other = 0; other < kRows; ++other) {
        sum += weights[static_cast<std::size_t>(other)] *
               turned[static_cast<std::size_t>(other * kColumns + column)];
      }
      light.radiance[At(level, row, column)] = sum / total;
    }
  }
}

// Mean of the logarithm over the sky between 2° and 40°; the sun's glow is part of what is seen.
double MeterExposure(const SkyLight& light, double cover) {
  double sum = 0.0, weights = 0.0;
  std::vector<std::pair<double, double>> brightness;  // with its solid angle
  for (int row = 0; row < kRows; ++row) {
    const double elevation = RowElevation(row);
    if (elevation < 0.035 || elevation > 0.70) continue;
    for (int column = 0; column < kColumns; ++column) {
      const double luminance = glm::dot(light.radiance[At(0, row, column)], kLuminance);
      sum += CellSr(row) * std::log(std::max(luminance, 1e-9));
      weights += CellSr(row);
      brightness.emplace_back(luminance, CellSr(row));
    }
  }
  const double mean = std::exp(sum / weights);
  // The eye does not adapt fully: dusk stays darker than noon.
  constexpr double kNoonRadiance = 0.06;
  // A grey day is exposed to be grey-white, not middle grey.
  const double metered = (kMeteredRadiance + 0.25 * cover * cover) /
                         (std::pow(mean, 0.86) * std::pow(kNoonRadiance, 0.14));
  // A low sun's glow fills a part of the sky: all but the brightest twelfth must keep its colour.
  std::sort(brightness.begin(), brightness.end());
  double below = 0.0;
  for (const auto& [luminance, solid_angle] : brightness) {
    below += solid_angle;
    if (below > weights * 11 / 12) return std::min(metered, kBrightMax / luminance);
  }
  return metered;
}

}  // namespace

SkyLight ComputeSkyLight(const Atmosphere& atmosphere, const Sun& sun, double cloud_cover,
                         double visibility_m) {
  SkyLight light;
  light.radiance.resize(static_cast<std::size_t>(SkyLight::kBlurLevels) * kRows * kColumns);
  FillClearSky(atmosphere, sun.elevation_rad, light);
  const double cover = std::clamp(cloud_cover, 0.0, 1.0);
  const glm::vec3 clear_sun = atmosphere.SunTransmittance(sun.elevation_rad);
  const glm::vec3 clear_sky = HorizontalIrradiance(light);
  const float sine = static_cast<float>(std::max(0.0, std::sin(sun.elevation_rad)));
  // A closed deck passes about a third of the light; broken clouds are lit from the side as well.
  const glm::vec3 total = clear_sun * (sine + 0.06f * static_cast<float>(1.0 - cover)) + clear_sky;
  light.cloud_radiance = total * kCloudTint * static_cast<float>((0.62 - 0.30 * cover) / kPi);
  const double veil = std::clamp((cover - 0.55) / 0.4, 0.0, 1.0);
  light.sun_irradiance = clear_sun * static_cast<float>((1.0 - veil * veil * (3.0 - 2.0 * veil)));
  AddMeanClouds(cover, light);
  light.sky_irradiance = HorizontalIrradiance(light);
  for (int level = 1; level < SkyLight::kBlurLevels; ++level) Blur(level, light);
  light.extinction_per_m = glm::max(atmosphere.SeaLevelExtinction(),
                                    glm::vec3(static_cast<float>(3.912 / visibility_m)));
  light.exposure = MeterExposure(light, cover);
  return light;
}

}  // namespace onesea::render
