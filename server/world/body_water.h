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

/// Reuses its memory: allocates only when there are more bodies than ever. Not thread-safe.
class BodyWater {
 public:
  /// Forgets the bodies of the tick before.
  void Clear();
  /// Lays samples under a body that stays within `radius_m` of `centre_m`: between 3 x 3 and
  /// 13 x 13, half a radius apart or `kSampleSpacingMinM`, so that waves shorter than the hull are
  /// seen, and those that it averages out may be missed. `in_flow`: the layer's velocity moves it.
  /// Returns its index.
  std::size_t Add(Vec2d centre_m, double radius_m, bool in_flow = true);

  /// Where the samples of all bodies lie.
  std::span<const Vec2d> points_m() const { return points_m_; }
  /// Fills the patches. `interaction`: what is felt of that layer at points_m(), or none.
  /// That band is taken not to fade with depth: its pressure is what the grid was given.
  /// Cost: some 0.5 µs a sample.
  void Fill(const IncidentSea& sea, std::span<const sea::InteractionFelt> interaction);

  /// Puts the interaction layer into patches that were filled without it.
  void AddInteraction(std::span<const sea::InteractionFelt> interaction);

  const WaterPatch& patch(std::size_t body) const { return places_[body].patch; }
  /// Height of the incident sea and the level, without the interaction layer.
  const HeightPatch& incident(std::size_t body) const { return places_[body].incident; }

 private:
  struct Place {
    std::size_t first_point = 0;
    int side = 0;
    bool in_flow = true;
    WaterPatch patch{};
    HeightPatch incident{};
  };
  void FillOne(const IncidentSea& sea, Place& place) const;

  std::vector<Place> places_;  // never shrinks; the first count_ are in use
  std::size_t count_ = 0;
  std::vector<Vec2d> points_m_;
  std::vector<float> bands_;  // (points x bands x 4)
};

inline constexpr double kSampleSpacingMinM = 0.75;

}  // namespace onesea::world
