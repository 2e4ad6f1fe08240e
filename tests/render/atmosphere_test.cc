#include "client/render/atmosphere.h"

#include <gtest/gtest.h>

#include <cmath>

#include "client/render/sky_light.h"

namespace onesea::render {
namespace {

// Straight up, optical depth is the sum of scale height times sea-level extinction; ozone is a
// triangle of half-width 15 km. Koschmieder gives the aerosol: 3.912/V less the air itself.
TEST(Atmosphere, ZenithTransmittanceIsClosedForm) {
  const double visibility_m = 40'000.0;
  const Atmosphere atmosphere(visibility_m);
  const glm::vec3 rayleigh =
      atmosphere.SeaLevelExtinction() - glm::vec3(atmosphere.SeaLevelExtinction().y - 13.56e-6f);
  const double mie = 3.912 / visibility_m - 13.56e-6;
  const glm::vec3 transmittance = atmosphere.SunTransmittance(M_PI / 2);
  const double green = std::exp(-(13.56e-6 * 8000.0 + mie * 1200.0 + 1.88e-6 * 15'000.0));
  EXPECT_NEAR(transmittance.y, green, 0.004);
  EXPECT_GT(transmittance.x, transmittance.z) << "the sun reddens";
  EXPECT_GT(rayleigh.z, rayleigh.x);
}

TEST(Atmosphere, SunReddensAndFadesTowardsTheHorizon) {
  const Atmosphere atmosphere(35'000.0);
  glm::vec3 before = atmosphere.SunTransmittance(1.2);
  for (double elevation : {0.8, 0.4, 0.2, 0.1, 0.03}) {
    const glm::vec3 now = atmosphere.SunTransmittance(elevation);
    EXPECT_LT(now.y, before.y);
    EXPECT_LT(now.z / now.x, before.z / before.x);
    before = now;
  }
  EXPECT_EQ(atmosphere.SunTransmittance(-0.05), glm::vec3(0.0f));
}

TEST(Atmosphere, SkyIsFiniteAndPositiveForEverySun) {
  for (double visibility_m : {500.0, 5000.0, 35'000.0, 200'000.0}) {
    const Atmosphere atmosphere(visibility_m);
    for (double sun = -0.2; sun <= M_PI / 2; sun += 0.11) {
      for (double elevation = 0.0; elevation <= M_PI / 2; elevation += 0.2) {
        for (double azimuth = 0.0; azimuth <= M_PI; azimuth += 0.5) {
          const glm::vec3 sky = atmosphere.SkyRadiance(elevation, azimuth, sun);
          for (int c = 0; c < 3; ++c) {
            ASSERT_TRUE(std::isfinite(sky[c]) && sky[c] >= 0.0f) << visibility_m << " " << sun;
            ASSERT_LT(sky[c], 30.0f);
          }
        }
      }
    }
  }
}

// No light is made: what reaches the ground is at most what entered, and a clear noon passes 70 to
// 95 % of it (clear-sky global irradiance, ASHRAE: 0.75 or so over the visible).
TEST(SkyLight, EnergyAtNoonIsPlausible) {
  const Atmosphere atmosphere(60'000.0);
  const double elevation = 1.0;
  const SkyLight light = ComputeSkyLight(atmosphere, {0.0, elevation}, 0.0, 60'000.0);
  const float incoming = static_cast<float>(std::sin(elevation));
  for (int c = 0; c < 3; ++c) {
    const float total = light.sun_irradiance[c] * incoming + light.sky_irradiance[c];
    EXPECT_LT(total, incoming * 1.02f);
    EXPECT_GT(total, incoming * 0.6f);
  }
  EXPECT_GT(light.sky_irradiance.z, light.sky_irradiance.x) << "the sky is blue";
}

// Blurring spreads light but hardly changes its mean.
TEST(SkyLight, BlurKeepsMeanRadiance) {
  const Atmosphere atmosphere(35'000.0);
  const SkyLight light = ComputeSkyLight(atmosphere, {0.3, 0.6}, 0.2, 35'000.0);
  double mean[SkyLight::kBlurLevels] = {};
  for (int level = 0; level < SkyLight::kBlurLevels; ++level) {
    double weights = 0.0;
    for (int row = 1; row < SkyLight::kRows; ++row) {
      const double low = std::pow((row - 1.0) / (SkyLight::kRows - 1), 2);
      const double high = std::pow(static_cast<double>(row) / (SkyLight::kRows - 1), 2);
      for (int column = 0; column < SkyLight::kColumns; ++column) {
        mean[level] +=
            (high - low) * light
                               .radiance[static_cast<std::size_t>(
                                   (level * SkyLight::kRows + row) * SkyLight::kColumns + column)]
                               .y;
        weights += high - low;
      }
    }
    mean[level] /= weights;
  }
  for (int level = 1; level < SkyLight::kBlurLevels; ++level) {
    EXPECT_NEAR(mean[level] / mean[0], 1.0, 0.12) << level;
  }
}

}  // namespace
}  // namespace onesea::render
