#pragma once

#include <vector>

#include "common/sea/interaction_field.h"
#include "common/wire/world_update.h"
#include "server/world/body_loads.h"

/// Water thrown up, as events for those who draw it.
///
/// What spray carries is told, not taken: a slamming hull throws at most a twentieth of the water
/// that it displaces anew, at the speed at which they meet, and has already lost more momentum than
/// that to pressure and added mass. Crests throw a fiftieth of the water that rises through a cell.
namespace onesea::world {

/// How much of a hull was in the water.
struct Wetness {
  double volume_m3 = 0.0;
  double area_m2 = 0.0;
};

/// A hull slams where the water meets it from below faster than this,
inline constexpr double kSlamSpeedMPerS = 1.5;
/// and speed times growth of the wetted area is more than this.
inline constexpr double kSlamStrengthM3PerS2 = 10.0;

/// Appends four events around the hull (ahead, astern, on both sides) if it slams. `before`: of the
/// step before; `loads` of this one. Nothing of it is NaN.
void AddHullSpray(const BodyModel& model, const BodyState& state, const BodyLoads& loads,
                  Wetness before, const WaterPatch& water, double step_s,
                  std::vector<wire::Spray>& spray);

/// Crests break upwards where they rise faster than this,
inline constexpr double kCrestSpeedMPerS = 1.5;
/// and are steeper than this: height times curvature (down, of both axes), (ak)² of a long crest.
inline constexpr double kCrestSteepness = 0.15;

/// Appends at most one event for each 16 x 16 cells of a region, as of `span_s` of time.
/// Heights are those of the layer alone. Cost: reads the vertical velocities, 5 µs for 256 x 256
/// calm cells.
void AddCrestSpray(const sea::InteractionField& field, double span_s,
                   std::vector<wire::Spray>& spray);

/// What an explosion under a dome of this radius and volume throws up: a fiftieth of the dome, nine
/// events, as high as the dome is wide.
void AddPlume(Vec3d place_m, double radius_m, double volume_m3, std::vector<wire::Spray>& spray);

}  // namespace onesea::world
