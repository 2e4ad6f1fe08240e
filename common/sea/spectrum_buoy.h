#pragma once

#include <memory>

#include "common/sea/spectrum_grid.h"

namespace onesea::sea {

/// A buoy's spectrum as a table: directions by maximum entropy (max_entropy.h), or for 1-D data the
/// fallback direction and spreading, whose peak frequency is that of the highest density.
DirectionTable TableOf(const BuoySpectrum& spectrum);
std::unique_ptr<const WaveSpectrum> MakeBuoySpectrum(const BuoySpectrum& spectrum, double depth_m);

}  // namespace onesea::sea
