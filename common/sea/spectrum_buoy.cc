#include "common/sea/spectrum_buoy.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "common/base/real_math.h"
#include "common/sea/constants.h"
#include "common/sea/max_entropy.h"
#include "common/sea/spectrum_jonswap.h"
#include "common/sea/spreading.h"

namespace onesea::sea {
namespace {

// The spreading of 1-D data. Its wave age is that of a JONSWAP sea of the same height and period.
SpreadingModel FallbackModel(const BuoySpectrum& spectrum, const DirectionTable& table) {
  const auto highest =
      std::max_element(table.density_m2_per_hz.begin(), table.density_m2_per_hz.end());
  const double peak_hz =
      table.frequency_hz[static_cast<std::size_t>(highest - table.density_m2_per_hz.begin())];
  JonswapSystem alike;
  alike.hs_m = 4.0 * std::sqrt(VarianceOf(table));
  alike.tp_s = 1.0 / peak_hz;
  const double age = InverseWaveAgeOfAlpha(JonswapShapeOf(alike, 0.0).alpha);
  return {spectrum.fallback_spreading, 2.0 * kPi * peak_hz, age};
}

void FillFallback(const SpreadingModel& model, double frequency_hz, double wave_to_rad,
                  std::span<double> out) {
  const SpreadingModel::Shape shape = model.At(2.0 * kPi * frequency_hz);
  const auto n = static_cast<double>(out.size());
  double sum = 0.0;
  for (std::size_t m = 0; m < out.size(); ++m) {
    const double theta = 2.0 * kPi * static_cast<double>(m) / n;
    out[m] = model.Density(shape, real::Cos(theta - wave_to_rad));
    sum += out[m];
  }
  const double scale = n / (2.0 * kPi * sum);
  for (double& d : out) d *= scale;
}

}  // namespace

DirectionTable TableOf(const BuoySpectrum& spectrum) {
  DirectionTable table;
  table.add_tail = spectrum.add_tail;
  table.frequency_hz.assign(spectrum.frequency_hz.begin(), spectrum.frequency_hz.end());
  table.density_m2_per_hz.assign(spectrum.density_m2_per_hz.begin(),
                                 spectrum.density_m2_per_hz.end());
  ScaleToHs(table, spectrum.hs_m);
  const std::size_t n = table.frequency_hz.size();
  table.distribution.resize(n * kTableDirections);
  const std::span<double> all(table.distribution);
  if (spectrum.mean_wave_to_rad.empty()) {
    const SpreadingModel model = FallbackModel(spectrum, table);
    for (std::size_t m = 0; m < n; ++m) {
      FillFallback(model, table.frequency_hz[m], spectrum.fallback_wave_to_rad,
                   all.subspan(m * kTableDirections, kTableDirections));
    }
    return table;
  }
  for (std::size_t m = 0; m < n; ++m) {
    MaxEntropyDistribution({spectrum.mean_wave_to_rad[m], spectrum.principal_wave_to_rad[m],
                            spectrum.r1[m], spectrum.r2[m]},
                           all.subspan(m * kTableDirections, kTableDirections));
  }
  return table;
}

std::unique_ptr<const WaveSpectrum> MakeBuoySpectrum(const BuoySpectrum& spectrum, double depth_m) {
  return MakeTableSpectrum(TableOf(spectrum), depth_m);
}

}  // namespace onesea::sea
