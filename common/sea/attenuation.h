#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/base/limits.h"
#include "common/base/sim_time.h"
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
/// The factor is that of the place where the water is seen, (x, y) after the displacement: a query
/// has one factor for each cascade, whatever its inversion tries, and the shore is where the map
/// shows it. With p the undisplaced point
///
///   (x, y) = p + Σ_c factor_c(x, y) D_c(p),   height = Σ_c factor_c(x, y) η_c(p)
///
/// Who goes the other way, from p to (x, y), finds it by iterating: factors at p, then at where
/// these put it.
///
/// Depths are those below the mean level: a tide does not move the grid.
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
  float largest = 1.0f;       ///< of the factors, at least 1

  /// Bilinear, in double, in a fixed order. Pre: the place is finite.
  double At(Vec2d place, int plane) const;
  /// The same of every plane, rounded to float: out[plane · stride]. Cost: some 50 ns.
  void AllAt(Vec2d place, float* out, std::size_t stride = 1) const;
  friend bool operator==(const AttenuationGrid&, const AttenuationGrid&) = default;
};

/// Immutable: share it. Cost: some 0.1 s for 400 x 400 samples. Components that have one are the
/// sea over that terrain, for all who synthesise or ask: see OverTerrain().
class Attenuation {
 public:
  /// Directions of travel that are told apart.
  static constexpr int kDirections = 32;
  /// Larger terrain is looked at in coarser cells.
  static constexpr int kSideMax = 512;

  /// Pre: `terrain` is valid.
  Attenuation(const Components& components, std::shared_ptr<const Terrain> terrain);

  const Terrain& terrain() const { return *terrain_; }
  const std::shared_ptr<const Terrain>& shared_terrain() const { return terrain_; }

  /// Pre: one weight for each weather entry, see WeatherWeights(). Cost: some 30 ns a cell; call it
  /// when the weather has changed, not at every tick.
  AttenuationGrid At(std::span<const double> weights) const;

 private:
  static constexpr int kPlanesMax = kCascadesMax + 1;
  using Shares = std::array<std::array<double, kPlanesMax>, kDirections>;

  Shares SharesOf(std::span<const double> weights) const;
  void SetDepths();
  void SetShares(const Components& components);
  void CarryAlong(int direction);

  std::shared_ptr<const Terrain> terrain_;
  std::size_t entries_;
  Shoaling shoaling_;
  AttenuationGrid shape_;             // without factors
  std::vector<float> depth_m_;        // (cells)
  std::vector<float> arriving_;       // (cells x kDirections)
  std::vector<double> direction_m2_;  // (planes x entries x kDirections) variance
};

/// The same waves over a terrain: a copy whose `attenuation` is that of `terrain`, or `components`
/// themselves if it is null. Cost: that of Attenuation.
std::shared_ptr<const Components> OverTerrain(std::shared_ptr<const Components> components,
                                              std::shared_ptr<const Terrain> terrain);

/// What the waves are over; null: the open sea.
std::shared_ptr<const Terrain> TerrainOf(const Components& components);

/// The grid of one time after another. A grid holds for a whole second of sea time and changes with
/// the weather alone, so that every process has the same one; in a change of weather over a minute
/// it moves by up to 1/25 of the difference a second. Not thread-safe.
class MovingAttenuation {
 public:
  explicit MovingAttenuation(std::shared_ptr<const Components> components)
      : components_(std::move(components)) {}

  /// Null without terrain; else the same object as long as the weather stays. Cost: nothing then.
  const std::shared_ptr<const AttenuationGrid>& At(SimTime time);

 private:
  std::shared_ptr<const Components> components_;
  std::vector<double> weights_, weights_of_grid_;
  std::shared_ptr<const AttenuationGrid> grid_;
};

}  // namespace onesea::sea
