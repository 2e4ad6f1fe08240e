#pragma once

#include <glm/vec3.hpp>
#include <vector>

/// A clear sky by physics: Rayleigh and Mie single scattering plus a closed-form sum of all higher
/// orders, in a spherical atmosphere seen from sea level. RGB stands for 610, 550 and 465 nm.
///
///   L(v) = ∫ T(t) [ (σ_R p_R + σ_M p_M) T_sun + (σ_R + σ_M) Ψ ] dt,   Ψ = L_2 / (1 - f_ms)
///
/// All radiances are per unit of solar irradiance above the atmosphere, so they are in 1/sr.
/// Aerosol density follows the meteorological range V: β = 3.912 / V at sea level (Koschmieder).
/// Source: Hillaire, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique", 2020
///   (multiple scattering, eq. 5-10); coefficients: Bucholtz 1995, ozone after Serdyuchenko 2014.
namespace onesea::render {

class Atmosphere {
 public:
  /// Cost: about 60 ms, one core. `visibility_m` in [500, 200000].
  explicit Atmosphere(double visibility_m);

  /// Of the direct sun at sea level, [0, 1]; fades over the disc's radius at the horizon.
  glm::vec3 SunTransmittance(double sun_elevation_rad) const;

  /// Radiance of the sky [1/sr], without the sun's disc. `elevation_rad` in [0, π/2],
  /// `azimuth_rad` from the sun's. Cost: about 5 µs.
  glm::vec3 SkyRadiance(double elevation_rad, double azimuth_rad, double sun_elevation_rad) const;

  /// Extinction at sea level [1/m].
  glm::vec3 SeaLevelExtinction() const;

 private:
  struct Medium {
    glm::vec3 rayleigh, mie, extinction;
  };
  Medium At(float radius_m) const;
  glm::vec3 OpticalDepth(float radius_m, float mu) const;
  glm::vec3 Transmittance(float radius_m, float mu) const;
  glm::vec3 MultipleScattering(float radius_m, float mu_sun) const;
  void FillTransmittance();
  void FillMultipleScattering();
  glm::vec3 IntegrateIsotropic(float radius_m, float mu_sun) const;

  float mie_extinction_per_m_;
  std::vector<glm::vec3> transmittance_;  // (kHeights x kAngles)
  std::vector<glm::vec3> multiple_;       // (kMultiHeights x kMultiAngles), [1/sr] per irradiance
};

}  // namespace onesea::render
