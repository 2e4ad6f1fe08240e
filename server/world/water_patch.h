#pragma once

#include <array>
#include <limits>
#include <vector>

#include "common/base/limits.h"
#include "common/base/vec.h"

/// The water around one body at one time: a small grid of samples over and around it.
///
/// Why bands: the pressure of a wave fades with depth as its wavenumber says, so the height alone
/// doesn't give the force on a deep keel. The sea is handed over as a few bands (a cascade each,
/// one for the interaction layer), each with one representative wavenumber k.
///   head   p / (rho g) = d - sum_b h_b (1 - C_b(d))    d: depth below the moving surface
///   velocity           = current + sum_b (u_b C_b, v_b C_b, w_b S_b)
///   C = cosh k(H - d) / cosh kH, S = sinh k(H - d) / sinh kH, or exp(-kd) in deep water
/// The head is 0 at the moving surface and hydrostatic where no wave is: Archimedes is exact.
/// Limits: one wavenumber a band, so a band of ratio 4 is off by up to 2^±1 in its decay scale;
/// stretched (the decay starts at the surface, not at the mean level), as Wheeler's.
namespace onesea::world {

inline constexpr int kWaterBandsMax = 12;
static_assert(kWaterBandsMax >= kCascadesMax + 2 &&
              kWaterBandsMax <= 16);  // cascades, regular waves, interaction layer

struct WaterPatch {
  Vec2d corner_m;             ///< place of the first sample
  Vec2d along{1.0, 0.0};      ///< way of a row of samples, unit; columns go to its left
  double cell_m = 1.0;        ///< distance of samples
  int columns = 0, rows = 0;  ///< at least 2 each, unless there are no bands
  double level_m = 0.0;       ///< mean level (tide) above z = 0
  Vec3d current_m_per_s;      ///< uniform here
  double depth_m = std::numeric_limits<double>::infinity();  ///< bottom below the mean level
  int bands = 0;
  std::array<double, kWaterBandsMax> wavenumber_rad_per_m{};
  /// (rows x columns x bands x 4) row-major from the corner: height above the mean level and
  /// velocity in the world's x, y, z at the surface [m, m/s], each band's share.
  std::vector<float> samples;

  /// No waves: the level and the current.
  void SetCalm();
  /// Makes room for the samples; keeps the memory of a larger patch. Pre: 2 <= columns, rows;
  /// 1 <= bands <= kWaterBandsMax.
  void Resize(int new_columns, int new_rows, int new_bands);
  Vec2d PlaceOf(double column, double row) const {
    const double x = column * cell_m, y = row * cell_m;
    return {corner_m.x + (x * along.x - y * along.y), corner_m.y + (x * along.y + y * along.x)};
  }
  float* At(int column, int row) { return samples.data() + 4 * bands * (row * columns + column); }
};

struct WaterPoint {
  double depth_m = 0.0;    ///< below the moving surface; negative in the air
  double head_m = 0.0;     ///< pressure over rho g, 0 in the air
  Vec3d velocity_m_per_s;  ///< in the air that of the surface below
};

/// What SampleWater needs of a patch; made once for many points.
struct WaterSampler {
  explicit WaterSampler(const WaterPatch& patch);

  const WaterPatch* patch;
  double cells_per_m;
  // Padded, so that whole vectors can be read.
  float wavenumber[16];
  float bottom_image[16];    ///< exp(-2kH)
  float least_decay[16];     ///< exp(-kH): at the bottom
  float per_sum[16];         ///< 1 / (1 + exp(-2kH))
  float per_difference[16];  ///< 1 / (1 - exp(-2kH)), 0 where that is none
  bool deep;                 ///< no band feels the bottom
};

/// Bilinear in the plane; outside the patch its edge. Cost: some 50 ns for 8 bands. Error of the
/// decays: 3e-7 of a band's height.
WaterPoint SampleWater(const WaterSampler& sampler, Vec3d place);

}  // namespace onesea::world
