#include "common/sea/component_statistics.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/sea/constants.h"

namespace onesea::sea {
namespace {

// Bins of 1 % from 0.005 Hz to 50 Hz.
constexpr double kBinWidth = 0.01;
constexpr double kFirstHz = 0.005;
constexpr int kBins = 921;
constexpr int kSmoothing = 5;  // standard deviation in bins

struct Wave {
  double variance_m2;
  double frequency_hz;
  double cosine, sine;  // direction of travel
};

// Every wave with energy, once per weather entry.
template <typename Visit>
void ForEachWave(const Components& components, SimTime time, Visit visit) {
  const std::vector<double> weights = WeatherWeights(components.recipe, time);
  const auto add = [&visit](double variance, double sigma, double kx, double ky) {
    if (!(variance > 0.0)) return;
    const double k = std::hypot(kx, ky);
    visit(Wave{variance, sigma / (2.0 * kPi), kx / k, ky / k});
  };
  for (std::size_t m = 0; m < weights.size(); ++m) {
    if (weights[m] == 0.0) continue;
    for (const CascadeComponents& c : components.cascades) {
      for (std::size_t n = 0; n < c.i.size(); ++n) {
        add(weights[m] * c.variance_m2[m][n], c.intrinsic_rad_per_s[n], c.kx_rad_per_m[n],
            c.ky_rad_per_m[n]);
      }
    }
    for (const RegularComponent& r : components.regular) {
      add(weights[m] * r.variance_m2[m], r.intrinsic_rad_per_s, r.kx_rad_per_m, r.ky_rad_per_m);
    }
  }
}

double BinCentreHz(double bin) { return kFirstHz * std::exp(kBinWidth * (bin + 0.5)); }

// S(f) up to a factor, from the energy per bin.
std::vector<double> SmoothedDensity(const std::vector<double>& energy) {
  std::vector<double> density(energy.size(), 0.0);
  for (int n = 0; n < kBins; ++n) {
    double sum = 0.0;
    double total = 0.0;
    for (int d = -3 * kSmoothing; d <= 3 * kSmoothing; ++d) {
      if (n + d < 0 || n + d >= kBins) continue;
      const double z = static_cast<double>(d) / kSmoothing;
      const double weight = std::exp(-0.5 * z * z);
      sum += weight * energy[static_cast<std::size_t>(n + d)] / BinCentreHz(n + d);
      total += weight;
    }
    density[static_cast<std::size_t>(n)] = sum / total;
  }
  return density;
}

// Period of the highest bin, and of the parabola through it and its neighbours.
void FindPeak(const std::vector<double>& density, SpectrumStatistics& out) {
  const auto peak = std::max_element(density.begin(), density.end());
  const auto bin = static_cast<double>(peak - density.begin());
  out.tp_s = out.tp_parabola_s = 1.0 / BinCentreHz(bin);
  if (peak == density.begin() || peak + 1 == density.end()) return;
  const double curvature = peak[-1] - 2.0 * peak[0] + peak[1];
  if (curvature < 0.0) {
    out.tp_parabola_s = 1.0 / BinCentreHz(bin + 0.5 * (peak[-1] - peak[1]) / curvature);
  }
}

}  // namespace

SpectrumStatistics ComputeStatistics(const Components& components, SimTime time) {
  std::vector<double> energy(kBins, 0.0);
  double m_minus1 = 0.0, m0 = 0.0, m1 = 0.0, m2 = 0.0, cosine = 0.0, sine = 0.0;
  ForEachWave(components, time, [&](const Wave& w) {
    m_minus1 += w.variance_m2 / w.frequency_hz;
    m0 += w.variance_m2;
    m1 += w.variance_m2 * w.frequency_hz;
    m2 += w.variance_m2 * w.frequency_hz * w.frequency_hz;
    cosine += w.variance_m2 * w.cosine;
    sine += w.variance_m2 * w.sine;
    const double bin = std::floor(std::log(w.frequency_hz / kFirstHz) / kBinWidth);
    energy[static_cast<std::size_t>(std::clamp(bin, 0.0, kBins - 1.0))] += w.variance_m2;
  });
  SpectrumStatistics out;
  if (!(m0 > 0.0)) return out;
  out.hs_m = 4.0 * std::sqrt(m0);
  out.tm01_s = m0 / m1;
  out.tm02_s = std::sqrt(m0 / m2);
  out.te_s = m_minus1 / m0;
  out.has_direction = true;
  out.mean_wave_to_rad = WaveTo(sine, cosine);
  out.spread_rad = std::sqrt(2.0 * (1.0 - std::min(1.0, std::hypot(cosine, sine) / m0)));
  FindPeak(SmoothedDensity(energy), out);
  double peak_cosine = 0.0, peak_sine = 0.0;
  ForEachWave(components, time, [&](const Wave& w) {
    if (std::fabs(std::log(w.frequency_hz * out.tp_s)) > kSmoothing * kBinWidth) return;
    peak_cosine += w.variance_m2 * w.cosine;
    peak_sine += w.variance_m2 * w.sine;
  });
  out.peak_wave_to_rad = WaveTo(peak_sine, peak_cosine);
  return out;
}

}  // namespace onesea::sea
