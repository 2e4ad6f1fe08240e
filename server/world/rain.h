#pragma once

#include <cstdint>

#include "common/base/sim_time.h"
#include "server/world/interaction_layer.h"

/// Rain on a region: rings of single heavy drops.
namespace onesea::world {

/// Adds the drops of one tick to the sources: each lifts a cell and lowers its four neighbours by
/// as much water, so rain changes no volume. The potential energy of that is the kinetic energy of
/// a drop of 6 mm at 9 m/s: an upper bound, since nature spends most of it on spray and sound.
/// Where drops fall follows from the seed, the tick and the region's place alone.
/// Cost: some 20 ns a drop.
void RainOn(RegionForcing& forcing, std::uint64_t seed, Tick tick, double step_s);

/// By how much a drop lifts its cell.
double DropHeight(double cell_m);

}  // namespace onesea::world
