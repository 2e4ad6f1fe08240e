#pragma once

#include <memory>
#include <vector>

#include "common/sea/wave_spectrum.h"

namespace onesea::sea {

inline constexpr int kTableDirections = 360;

/// A measured or modelled directional spectrum on a table of frequency by direction.
struct DirectionTable {
  std::vector<double> frequency_hz;       ///< (n) ascending, > 0
  std::vector<double> density_m2_per_hz;  ///< (n) S(f), the integral of each row
  std::vector<double> distribution;  ///< (n x kTableDirections) D(θ) [1/rad], θ from 0 in degrees
  bool add_tail = true;              ///< S falls as f⁻⁵ above the last frequency, D as there
};

/// E(f, θ) = S(f) D(f, θ), linear in f and θ between the table's values of E; nothing below the
/// first frequency, above the last the tail or nothing. m0 is the trapezoidal sum of S, and with
/// the tail S_n f_n / 4 more.
std::unique_ptr<const WaveSpectrum> MakeTableSpectrum(const DirectionTable& table, double depth_m);

/// Directions resampled to the table's 360 by linear interpolation around the turn, every row's
/// energy kept; then scaled to hs_m, if that is given.
DirectionTable TableOf(const GridSpectrum& spectrum);
std::unique_ptr<const WaveSpectrum> MakeGridSpectrum(const GridSpectrum& spectrum, double depth_m);

/// Trapezoidal m0 [m²] of S, without the tail.
double VarianceOf(const DirectionTable& table);

/// Scales S so that the trapezoidal m0 is hs_m²/16; leaves it for hs_m = 0.
void ScaleToHs(DirectionTable& table, double hs_m);

}  // namespace onesea::sea
