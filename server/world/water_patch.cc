#include "server/world/water_patch.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "common/base/check.h"
#include "common/base/real_math.h"

namespace onesea::world {
namespace {

// exp(-x) for x >= 0, relative error 3e-7 up to x = 10; 0 from 80 on.
float ExpMinus(float x) {
  const float turns = std::min(x, 80.0f) * 1.44269504f;
  // Not lround: this must become one vector instruction, and turns >= 0.
  const auto whole =
      static_cast<std::int32_t>(turns + 0.5f);  // NOLINT(bugprone-incorrect-roundings)
  const float g = (turns - static_cast<float>(whole)) * -0.693147181f;  // within ±0.347
  float p = 1.0f / 720.0f;
  p = p * g + 1.0f / 120.0f;
  p = p * g + 1.0f / 24.0f;
  p = p * g + 1.0f / 6.0f;
  p = p * g + 0.5f;
  p = p * g + 1.0f;
  p = p * g + 1.0f;
  return p * std::bit_cast<float>((127 - whole) << 23);
}

}  // namespace

void WaterPatch::SetCalm() {
  columns = rows = bands = 0;
  samples.clear();
}

void WaterPatch::Resize(int new_columns, int new_rows, int new_bands) {
  ONESEA_CHECK(new_columns >= 2 && new_rows >= 2 && new_bands >= 1 && new_bands <= kWaterBandsMax)
      << new_columns << " x " << new_rows << " x " << new_bands;
  columns = new_columns;
  rows = new_rows;
  bands = new_bands;
  constexpr int kPadding = 16;  // so that whole vectors can be read
  samples.resize(static_cast<std::size_t>(4) * bands * columns * rows + kPadding);
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
  const WaterPatch& patch = *sampler.patch;
  const double above_level_m = place.z - patch.level_m;
  if (patch.bands == 0) {
    const double depth = patch.level_m - place.z;
    return {depth, std::max(0.0, depth), patch.current_m_per_s};
  }
  const Vec2d from{place.x - patch.corner_m.x, place.y - patch.corner_m.y};
  const double x = from.x * patch.along.x + from.y * patch.along.y;
  const double y = from.y * patch.along.x - from.x * patch.along.y;
  const double u = std::clamp(x * sampler.cells_per_m, 0.0, static_cast<double>(patch.columns - 1));
  const double v = std::clamp(y * sampler.cells_per_m, 0.0, static_cast<double>(patch.rows - 1));
  const int column = std::min(static_cast<int>(u), patch.columns - 2);
  const int row = std::min(static_cast<int>(v), patch.rows - 2);
  const auto wu = static_cast<float>(u - column), wv = static_cast<float>(v - row);
  const int record = 4 * patch.bands;
  const float* low = patch.samples.data() + record * (row * patch.columns + column);
  const float* high = low + record * patch.columns;

  alignas(16) float bands[4 * kWaterBandsMax];
  for (int n = 0; n < record; ++n) {
    const float a = low[n] + wu * (low[n + record] - low[n]);
    const float b = high[n] + wu * (high[n + record] - high[n]);
    bands[n] = a + wv * (b - a);
  }
  float height = 0.0f;
  for (int b = 0; b < patch.bands; ++b) height += bands[4 * b];
  const double depth = double{height} - above_level_m;

  alignas(16) float sum[4] = {};  // the height that is felt here, and the velocity
  alignas(16) float decay[kWaterBandsMax], vertical[kWaterBandsMax];
  const auto d = static_cast<float>(std::max(0.0, depth));  // in the air that of the surface
  for (int b = 0; b < kWaterBandsMax; ++b) decay[b] = ExpMinus(sampler.wavenumber[b] * d);
  if (sampler.deep) {
    for (int b = 0; b < patch.bands; ++b) {
      for (int c = 0; c < 4; ++c) sum[c] += bands[4 * b + c] * decay[b];
    }
  } else {
    for (int b = 0; b < kWaterBandsMax; ++b) {
      const float image = sampler.bottom_image[b];
      // At or below the bottom: what is left there.
      const float down = std::max(decay[b], sampler.least_decay[b]);
      const float up = image / down;
      decay[b] = (down + up) * sampler.per_sum[b];
      vertical[b] = (down - up) * sampler.per_difference[b];
    }
    for (int b = 0; b < patch.bands; ++b) {
      for (int c = 0; c < 3; ++c) sum[c] += bands[4 * b + c] * decay[b];
      sum[3] += bands[4 * b + 3] * vertical[b];
    }
  }
  const double lost = double{height} - double{sum[0]};
  return {depth, depth > 0.0 ? std::max(0.0, depth - lost) : 0.0,
          patch.current_m_per_s + Vec3d{sum[1], sum[2], sum[3]}};
}

}  // namespace onesea::world
