#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/sea/point_query.h"

namespace onesea::sea {
namespace {

struct Mean {
  void Add(double variance_m2, double kx, double ky) {
    weight += variance_m2;
    sum += variance_m2 * std::sqrt(kx * kx + ky * ky);
  }
  double weight = 0.0, sum = 0.0;
};

}  // namespace

std::vector<double> BandWavenumbers(const Components& components, SimTime time) {
  const std::vector<double> weights = WeatherWeights(components.recipe, time);
  std::vector<double> wavenumbers;
  for (const CascadeComponents& waves : components.cascades) {
    Mean mean;
    for (std::size_t m = 0; m < weights.size(); ++m) {
      if (weights[m] == 0.0) continue;
      for (std::size_t n = 0; n < waves.i.size(); ++n) {
        mean.Add(weights[m] * waves.variance_m2[m][n], waves.kx_rad_per_m[n],
                 waves.ky_rad_per_m[n]);
      }
    }
    const Cascade& band = waves.cascade;
    const double lowest =
        std::max(band.wavenumber_min_rad_per_m, 2.0 * std::numbers::pi / band.length_m);
    wavenumbers.push_back(mean.weight > 0.0 ? mean.sum / mean.weight
                                            : std::sqrt(lowest * band.wavenumber_max_rad_per_m));
  }
  if (components.regular.empty()) return wavenumbers;
  Mean mean;
  for (const RegularComponent& wave : components.regular) {
    // A wave that isn't there at this time still has a place in the band.
    double variance_m2 = 1e-30;
    for (std::size_t m = 0; m < weights.size(); ++m)
      variance_m2 += weights[m] * wave.variance_m2[m];
    mean.Add(variance_m2, wave.kx_rad_per_m, wave.ky_rad_per_m);
  }
  wavenumbers.push_back(mean.sum / mean.weight);
  return wavenumbers;
}

}  // namespace onesea::sea
