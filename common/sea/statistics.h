#pragma once

#include "common/sea/sea_state.h"

namespace onesea::sea {

/// The figures by which seas are compared, of a spectrum over the frequencies it states (without
/// the tail that add_tail puts above them).
///
///   m_n = ∫ fⁿ S(f) df,   a = ∫∫ S cos θ dθ df,   b = ∫∫ S sin θ dθ df
///
/// Periods are 0 for a spectrum without energy. Source: moments as in Longuet-Higgins 1957; spread
/// as in Kuik et al. 1988.
struct SpectrumStatistics {
  double hs_m = 0.0;              ///< 4 √m0; the spectrum's own hs_m where it is given
  double tp_s = 0.0;              ///< centre of the highest band
  double tp_parabola_s = 0.0;     ///< from the parabola through the highest band and its neighbours
  double tm01_s = 0.0;            ///< m0/m1
  double tm02_s = 0.0;            ///< √(m0/m2), mean zero-crossing period (NDBC: APD)
  double te_s = 0.0;              ///< m₋₁/m0, energy period
  bool has_direction = false;     ///< false: 1-D data; the three below are 0
  double mean_wave_to_rad = 0.0;  ///< atan2(b, a), in [0, 2π)
  double spread_rad = 0.0;        ///< √(2 (1 - √(a² + b²)/m0)), in [0, √2]
  double peak_wave_to_rad = 0.0;  ///< mean direction of the highest band
};

/// Trapezoids over frequency; over direction cells that reach half-way to the neighbours. Sizes
/// must be consistent, as ValidateSeaState() checks. O(values), no allocation but for
/// O(frequencies).
SpectrumStatistics ComputeStatistics(const BuoySpectrum& spectrum);
SpectrumStatistics ComputeStatistics(const GridSpectrum& spectrum);

/// Direction of the vector (cosine, sine), in [0, 2π).
double WaveTo(double sine, double cosine);

}  // namespace onesea::sea
