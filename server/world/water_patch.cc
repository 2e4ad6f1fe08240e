#include "server/world/water_patch.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/base/real_math.h"
#include "server/world/water_sample-inl.h"

namespace onesea::world {

void WaterPatch::SetCalm() {
  columns = rows = bands = 0;
  samples.clear();
  highest_m = level_m;
}

void WaterPatch::Resize(int new_columns, int new_rows, int new_bands) {
  ONESEA_CHECK(new_columns >= 2 && new_rows >= 2 && new_bands >= 1 && new_bands <= kWaterBandsMax)
      << new_columns << " x " << new_rows << " x " << new_bands;
  columns = new_columns;
  rows = new_rows;
  bands = new_bands;
  constexpr int kPadding = 16;  // so that whole vectors can be read
  samples.resize(static_cast<std::size_t>(4) * bands * columns * rows + kPadding);
  highest_m = std::numeric_limits<double>::infinity();
}

void WaterPatch::FindHighest() {
  double highest = bands == 0 ? 0.0 : -std::numeric_limits<double>::infinity();
  for (int n = 0; n < columns * rows; ++n) {
    float height = 0.0f;
    for (int b = 0; b < bands; ++b) height += samples[4 * (n * bands + b)];
    highest = std::max(highest, double{height});
  }
  highest_m = level_m + highest;
}

WaterSampler::WaterSampler(const WaterPatch& of)
    : patch(&of),
      cells_per_m(1.0 / of.cell_m),
      wavenumber{},
      bottom_image{},
      least_decay{},
      per_sum{},
      per_difference{},
      deep(true) {
  // Longer than that, a wave's vertical velocity is linear in depth anyway, and 1 - image keeps its
  // digits.
  constexpr double kWavenumberDepthMin = 1e-2;
  for (int b = 0; b < of.bands; ++b) {
    double k = of.wavenumber_rad_per_m[b];
    const bool bottomless = !(of.depth_m < std::numeric_limits<double>::infinity());
    if (!bottomless && k * of.depth_m < kWavenumberDepthMin) k = kWavenumberDepthMin / of.depth_m;
    wavenumber[b] = static_cast<float>(k);
    bottom_image[b] = bottomless ? 0.0f : static_cast<float>(real::Exp(-2.0 * k * of.depth_m));
    least_decay[b] = std::sqrt(bottom_image[b]);
    per_sum[b] = 1.0f / (1.0f + bottom_image[b]);
    per_difference[b] = 1.0f / (1.0f - bottom_image[b]);
    deep = deep && bottom_image[b] < 1e-7f;
  }
}

WaterPoint SampleWater(const WaterSampler& sampler, Vec3d place) {
  return internal::Sample(sampler, place);
}

}  // namespace onesea::world
