#include "common/sea/statistics.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/base/check.h"
#include "common/sea/constants.h"

namespace onesea::sea {
namespace {

constexpr double kTurn = 2.0 * kPi;

// One frequency, integrated over direction.
struct Band {
  double frequency_hz = 0.0;
  double density = 0.0;             // S [m²/Hz]
  double cosine = 0.0, sine = 0.0;  // ∫ S cos θ dθ, ∫ S sin θ dθ
};

// The top of the parabola through three points; the middle one where they lie on a line.
double ParabolaPeakHz(const Band& a, const Band& b, const Band& c) {
  const double slope_ab = (a.density - b.density) / (a.frequency_hz - b.frequency_hz);
  const double slope_ac = (a.density - c.density) / (a.frequency_hz - c.frequency_hz);
  const double curvature = (slope_ac - slope_ab) / (c.frequency_hz - b.frequency_hz);
  if (!(curvature < 0.0)) return b.frequency_hz;
  return 0.5 * (a.frequency_hz + b.frequency_hz - slope_ab / curvature);
}

struct Moments {
  double m_minus1 = 0.0, m0 = 0.0, m1 = 0.0, m2 = 0.0, cosine = 0.0, sine = 0.0;

  void Add(const Band& band, double width_hz) {
    const double f = band.frequency_hz, energy = band.density * width_hz;
    m_minus1 += energy / f;
    m0 += energy;
    m1 += energy * f;
    m2 += energy * f * f;
    cosine += band.cosine * width_hz;
    sine += band.sine * width_hz;
  }
};

SpectrumStatistics Summarise(const std::vector<Band>& bands, bool has_direction, double hs_m) {
  Moments m;
  for (std::size_t i = 1; i < bands.size(); ++i) {
    const double half_width_hz = 0.5 * (bands[i].frequency_hz - bands[i - 1].frequency_hz);
    m.Add(bands[i - 1], half_width_hz);
    m.Add(bands[i], half_width_hz);
  }
  SpectrumStatistics out;
  out.has_direction = has_direction;
  if (!(m.m0 > 0.0)) return out;
  const auto peak = std::max_element(bands.begin(), bands.end(), [](const Band& a, const Band& b) {
    return a.density < b.density;
  });
  const bool is_inside = peak != bands.begin() && peak + 1 != bands.end();
  out.hs_m = hs_m > 0.0 ? hs_m : 4.0 * std::sqrt(m.m0);
  out.tp_s = 1.0 / peak->frequency_hz;
  out.tp_parabola_s = is_inside ? 1.0 / ParabolaPeakHz(peak[-1], *peak, peak[1]) : out.tp_s;
  out.tm01_s = m.m0 / m.m1;
  out.tm02_s = std::sqrt(m.m0 / m.m2);
  out.te_s = m.m_minus1 / m.m0;
  if (!has_direction) return out;
  const double concentration = std::min(1.0, std::hypot(m.cosine, m.sine) / m.m0);
  out.mean_wave_to_rad = WaveTo(m.sine, m.cosine);
  out.spread_rad = std::sqrt(2.0 * (1.0 - concentration));
  out.peak_wave_to_rad = WaveTo(peak->sine, peak->cosine);
  return out;
}

}  // namespace

double WaveTo(double sine, double cosine) {
  const double angle = std::atan2(sine, cosine);
  return angle < 0.0 ? std::min(angle + kTurn, std::nextafter(kTurn, 0.0)) : angle;
}

SpectrumStatistics ComputeStatistics(const BuoySpectrum& spectrum) {
  const std::size_t n = spectrum.frequency_hz.size();
  const bool has_direction = !spectrum.mean_wave_to_rad.empty();
  ONESEA_CHECK(spectrum.density_m2_per_hz.size() == n);
  ONESEA_CHECK(!has_direction ||
               (spectrum.mean_wave_to_rad.size() == n && spectrum.r1.size() == n));
  std::vector<Band> bands(n);
  for (std::size_t i = 0; i < n; ++i) {
    bands[i].frequency_hz = spectrum.frequency_hz[i];
    bands[i].density = spectrum.density_m2_per_hz[i];
    if (!has_direction) continue;
    const double resultant = bands[i].density * spectrum.r1[i];
    bands[i].cosine = resultant * std::cos(static_cast<double>(spectrum.mean_wave_to_rad[i]));
    bands[i].sine = resultant * std::sin(static_cast<double>(spectrum.mean_wave_to_rad[i]));
  }
  return Summarise(bands, has_direction, spectrum.hs_m);
}

SpectrumStatistics ComputeStatistics(const GridSpectrum& spectrum) {
  const std::size_t n = spectrum.frequency_hz.size(), m = spectrum.wave_to_rad.size();
  ONESEA_CHECK(spectrum.density_m2_per_hz_rad.size() == n * m);
  std::vector<Band> bands(n);
  for (std::size_t i = 0; i < n; ++i) bands[i].frequency_hz = spectrum.frequency_hz[i];
  for (std::size_t j = 0; j < m; ++j) {
    const double angle = spectrum.wave_to_rad[j];
    const double before = j > 0 ? spectrum.wave_to_rad[j - 1] : spectrum.wave_to_rad[m - 1] - kTurn;
    const double after = j + 1 < m ? spectrum.wave_to_rad[j + 1] : spectrum.wave_to_rad[0] + kTurn;
    const double width = 0.5 * (after - before), cosine = std::cos(angle), sine = std::sin(angle);
    for (std::size_t i = 0; i < n; ++i) {
      const double density = spectrum.density_m2_per_hz_rad[i * m + j] * width;
      bands[i].density += density;
      bands[i].cosine += density * cosine;
      bands[i].sine += density * sine;
    }
  }
  return Summarise(bands, true, spectrum.hs_m);
}

}  // namespace onesea::sea
