#pragma once

#include "common/sea/components.h"
#include "common/sea/statistics.h"

namespace onesea::sea {

/// The figures of the sea that a process has, at `time`: sums over its waves by intrinsic
/// frequency, so a spectrum's own figures come back but for what the bands leave out
/// (lost_variance_m2) and for the lattice. Peaks come from the density smoothed by 5 % in
/// frequency, since a lattice has few waves near a long swell's peak; they are within 3 %. Not on
/// the determinism path. Cost: 1 ms.
SpectrumStatistics ComputeStatistics(const Components& components, SimTime time);

}  // namespace onesea::sea
