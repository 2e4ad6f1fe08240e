#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "common/sea/interaction_field.h"
#include "common/sea/point_query.h"
#include "common/sea/terrain.h"
#include "server/world/displaced_columns.h"
#include "server/world/water_patch.h"

/// The water around every body at one time, sampled in one go.
namespace onesea::world {

/// The sea that isn't the interaction layer.
struct IncidentSea {
  const sea::SeaSnapshot* waves = nullptr;         ///< kVelocity; null: calm
  std::span<const double> wavenumber_rad_per_m{};  ///< of its bands
  double level_m = 0.0;                            ///< of the mean water above z = 0
  Vec2d current_m_per_s{};
  double depth_m = 0.0;  ///< below z = 0; 0: infinitely deep
  /// Makes it shallower where a body is: waves press on a hull as in that depth. Null: none.
  const sea::Terrain* terrain = nullptr;
};

/// Where a body needs to know the water.
struct WaterUnder {
  Vec2d centre_m;
  Vec2d half_m;           ///< reach along its heading and across
  Vec2d along{1.0, 0.0};  ///< its heading, unit
  /// It presses on the grid as it lies (Radiation::kGrid): it is told the heights without the
  /// layer, and the layer's velocity, which is its own waves', doesn't move it. Pre: heading east.
  bool is_in_grid = false;
};

/// Reuses its memory: allocates only when there are more bodies than ever. Not thread-safe.
class BodyWater {
 public:
  /// Forgets the bodies of the tick before.
  void Clear();
  /// Lays samples under a body: 3 to 13 along its heading and across, half its reach apart or
  /// `kSampleSpacingMinM`, so that waves shorter than the hull are seen, and those that it averages
  /// out may be missed. Returns its index.
  std::size_t Add(const WaterUnder& body);

  /// Where the samples of all bodies lie.
  std::span<const Vec2d> points_m() const { return points_m_; }
  /// Fills the patches, without the interaction layer. Cost: some 0.5 µs a sample.
  void Fill(const IncidentSea& sea);

  /// Puts what is felt of the interaction layer at points_m() into patches that are filled. That
  /// band is taken not to fade with depth: its pressure is what the grid was given.
  void AddInteraction(std::span<const sea::InteractionFelt> interaction);

  const WaterPatch& patch(std::size_t body) const { return places_[body].patch; }
  std::span<const Vec2d> points_m(std::size_t body) const {
    return {points_m_.data() + places_[body].first_point, places_[body].points()};
  }
  /// Height of the incident sea and the level, without the interaction layer. Pre: is_in_grid.
  const HeightPatch& incident(std::size_t body) const { return places_[body].incident; }

 private:
  struct Place {
    std::size_t first_point = 0;
    bool is_in_grid = false;
    WaterPatch patch{};
    HeightPatch incident{};
    std::size_t points() const { return static_cast<std::size_t>(patch.columns) * patch.rows; }
  };
  void FillOne(const IncidentSea& sea, Place& place) const;
  void FillIncident(double level_m, Place& place) const;

  std::vector<Place> places_;  // never shrinks; the first count_ are in use
  std::size_t count_ = 0;
  std::vector<Vec2d> points_m_;
  std::vector<float> bands_;  // (points x bands x 4)
};

inline constexpr double kSampleSpacingMinM = 0.75;

}  // namespace onesea::world
