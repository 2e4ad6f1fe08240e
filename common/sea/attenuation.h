#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/base/vec.h"
#include "common/sea/shoaling.h"
#include "common/sea/terrain.h"

/// The spectral sea over terrain: by how much each cascade's amplitude is multiplied at a place.
///
///   factor_c(x, y) = DepthFactors_c(depth(x, y)) √(Σ_θ s_c(θ) v(x, y; θ))
///
/// s_c(θ) is the share of the cascade's variance that travels to θ, v the share of it that arrives:
/// 1 in the open, 0 behind land. v is carried from cell to cell along θ, so that the spread of the
/// sea's directions (and some spreading sideways, which stands in for diffraction) fills the
/// shadow of an island or a breakwater. Heights, displacements, velocities and slopes of a cascade
/// are all multiplied; the factor's own slope is left out (it changes over many wavelengths).
///
/// Outside the terrain the factor is that of the nearest edge cell. Bits: the same on every
/// machine. Limits: see shoaling.h; no reflection, and shadows know the wave's direction off shore
/// only.
namespace onesea::sea {

/// The factors at one weather mix, one float for each cell and plane.
struct AttenuationGrid {
  double west_m = 0.0;
  double south_m = 0.0;
  double cell_m = 1.0;
  int columns = 0;
  int rows = 0;
  int planes = 0;
  std::vector<float> factor;  ///< (rows x columns x planes): a place's planes side by side

  /// Bilinear, in double, in a fixed order. Pre: the place is finite.
  double At(Vec2d place, int plane) const;
  friend bool operator==(const AttenuationGrid&, const AttenuationGrid&) = default;
};

/// Immutable: share it. Cost: some 0.1 s for 400 x 400 samples.
class Attenuation {
 public:
  /// Directions of travel that are told apart.
  static constexpr int kDirections = 32;
  /// Larger terrain is looked at in coarser cells.
  static constexpr int kSideMax = 512;

  Attenuation(std::shared_ptr<const Components> components, const Terrain& terrain);

  /// Pre: one weight for each weather entry, see WeatherWeights(). Cost: about 15 ns for each cell
  /// and plane; call it when the weather has changed, not at every tick.
  AttenuationGrid At(std::span<const double> weights) const;

 private:
  void SetShares();
  void CarryAlong(int direction);

  std::shared_ptr<const Components> components_;
  Shoaling shoaling_;
  AttenuationGrid shape_;             // without factors
  std::vector<float> depth_m_;        // (cells)
  std::vector<float> arriving_;       // (cells x kDirections)
  std::vector<double> direction_m2_;  // (planes x entries x kDirections) variance
};

}  // namespace onesea::sea
