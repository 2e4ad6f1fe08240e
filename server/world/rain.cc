#include "server/world/rain.h"

#include <cmath>

#include "common/base/rng.h"
#include "common/sea/constants.h"

namespace onesea::world {

double DropHeight(double cell_m) {
  constexpr double kRadiusM = 3e-3, kSpeedMPerS = 9.0;
  constexpr double kVolumeM3 = 4.0 / 3.0 * sea::kPi * kRadiusM * kRadiusM * kRadiusM;
  // rho/2 V v² = rho g/2 (1 + 4/16) h² cell²
  constexpr double kHeightCellM2 = kVolumeM3 * kSpeedMPerS * kSpeedMPerS / (1.25 * sea::kGravity);
  return std::sqrt(kHeightCellM2) / cell_m;
}

void RainOn(RegionForcing& forcing, std::uint64_t seed, Tick tick, double step_s) {
  const sea::CellRect& cells = forcing.cells;
  const double area_m2 = static_cast<double>(cells.cells()) * cells.cell_m * cells.cell_m;
  const double mean = forcing.traits.rain_drops_per_m2_s * area_m2 * step_s;
  if (!(mean > 0.0)) return;
  const std::array<std::uint32_t, 2> key{static_cast<std::uint32_t>(seed),
                                         static_cast<std::uint32_t>(seed >> 32)};
  const std::uint32_t now = static_cast<std::uint32_t>(tick);
  const std::uint32_t place = static_cast<std::uint32_t>(cells.west) * 0x9E3779B9u +
                              static_cast<std::uint32_t>(cells.south);
  const auto random = [&](std::uint32_t n) {
    return Philox4x32({n, now, place, 0x7261696Eu}, key);
  };
  // The fraction of a drop falls as often as it is large.
  const auto first = random(0);
  const auto count = static_cast<std::uint32_t>(mean + UnitInterval(first[0], first[1]));
  const auto height = static_cast<float>(DropHeight(cells.cell_m));
  for (std::uint32_t n = 1; n <= count; ++n) {
    const auto drop = random(n);
    // Not on the rim, whose neighbours are not there.
    const auto column = 1 + (std::uint64_t{drop[0]} * (cells.columns - 2) >> 32);
    const auto row = 1 + (std::uint64_t{drop[1]} * (cells.rows - 2) >> 32);
    float* at = &forcing.source_m[row * cells.columns + column];
    at[0] += height;
    for (const int to : {-1, 1, -cells.columns, cells.columns}) at[to] -= 0.25f * height;
  }
  forcing.has_source = forcing.has_source || count > 0;
}

}  // namespace onesea::world
