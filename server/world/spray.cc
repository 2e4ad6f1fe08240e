#include "server/world/spray.h"

#include <algorithm>
#include <cmath>

#include "common/sea/constants.h"

namespace onesea::world {
namespace {

constexpr double kHullShareMax = 0.05;    // of the newly displaced water
constexpr double kCrestShare = 0.02;      // of the water that rises
constexpr double kMassMinKg = 0.05;       // less isn't worth an event
constexpr double kMassMaxKg = 1e6;        // of the wire
constexpr double kSpeedMaxMPerS = 100.0;  // of drops; faster is no water
constexpr int kBlock = 16;

Vec3d Limited(Vec3d velocity) {
  const double speed = Norm(velocity);
  return speed > kSpeedMaxMPerS ? (kSpeedMaxMPerS / speed) * velocity : velocity;
}

void Add(Vec3d position_m, Vec3d velocity_m_per_s, double mass_kg,
         std::vector<wire::Spray>& spray) {
  if (!(mass_kg >= kMassMinKg)) return;
  spray.push_back({position_m, Limited(velocity_m_per_s), std::min(mass_kg, kMassMaxKg)});
}

}  // namespace

void AddHullSpray(const BodyModel& model, const BodyState& state, const BodyLoads& loads,
                  Wetness before, const WaterPatch& water, double step_s,
                  std::vector<wire::Spray>& spray) {
  const WetForces& wet = loads.wet;
  const double volume_m3 = wet.volume_m3 - before.volume_m3;
  const double area_m2 = wet.wet_area_m2 - before.area_m2;
  if (!(volume_m3 > 0.0 && area_m2 > 0.0)) return;
  const Mat3d turn = ToMatrix(state.pose.turn);
  const Vec3d arm = turn * wet.volume_centre_m;
  const Vec3d hull = state.velocity_m_per_s + Cross(state.spin_rad_per_s, arm);
  const double speed = (turn * wet.water_velocity_m_per_s - hull).z;
  if (!(speed > kSlamSpeedMPerS && speed * area_m2 > kSlamStrengthM3PerS2 * step_s)) return;

  const double share = kHullShareMax * std::min(1.0, (speed - kSlamSpeedMPerS) / 3.0);
  const double mass_kg = 0.25 * share * model.density_kg_per_m3 * volume_m3;
  const WaterSampler sampler(water);
  const Vec3d low = model.rest.wet_low_m, high = model.rest.wet_high_m;
  for (const Vec3d rim :
       {Vec3d{high.x, 0, 0}, Vec3d{low.x, 0, 0}, Vec3d{0, high.y, 0}, Vec3d{0, low.y, 0}}) {
    const Vec3d way = turn * rim;
    const double length = std::sqrt(way.x * way.x + way.y * way.y);
    if (!(length > 0.0)) continue;
    Vec3d place = state.pose.centre_m + way;
    place.z += SampleWater(sampler, place).depth_m;
    const Vec3d away{0.8 * speed * way.x / length, 0.8 * speed * way.y / length, speed};
    Add(place, away + Vec3d{0.5 * hull.x, 0.5 * hull.y, 0.0}, mass_kg, spray);
  }
}

void AddCrestSpray(const sea::InteractionField& field, double span_s,
                   std::vector<wire::Spray>& spray) {
  const sea::CellRect& cells = field.cells;
  if (field.flow == nullptr) return;
  const std::vector<float>& up = field.flow->z;
  const auto fast = static_cast<float>(kCrestSpeedMPerS);
  const auto steepness = [&](std::size_t at) {
    const double here = field.height_m[at];
    const double sum = double{field.height_m[at - 1]} + field.height_m[at + 1] +
                       field.height_m[at - cells.columns] + field.height_m[at + cells.columns];
    return here > 0.0 ? here * (4.0 * here - sum) / (cells.cell_m * cells.cell_m) : 0.0;
  };
  // The fastest of each block; the rim has no neighbours.
  for (int south = 0; south < cells.rows; south += kBlock) {
    for (int west = 0; west < cells.columns; west += kBlock) {
      std::size_t best = 0;
      float best_up = fast;
      for (int row = std::max(south, 1); row < std::min(south + kBlock, cells.rows - 1); ++row) {
        const int end = std::min(west + kBlock, cells.columns - 1);
        for (int column = std::max(west, 1); column < end; ++column) {
          const std::size_t at = static_cast<std::size_t>(row) * cells.columns + column;
          if (!(up[at] > best_up) || !(steepness(at) > kCrestSteepness)) continue;
          best = at;
          best_up = up[at];
        }
      }
      if (best == 0) continue;
      const Vec2d place = cells.PlaceOfIndex(best);
      const double mass_kg =
          kCrestShare * sea::kWaterDensityKgPerM3 * cells.cell_m * cells.cell_m * best_up * span_s;
      Add({place.x, place.y, field.height_m[best]},
          {field.flow->x[best], field.flow->y[best], best_up}, mass_kg, spray);
    }
  }
}

void AddPlume(Vec3d place_m, double radius_m, double volume_m3, std::vector<wire::Spray>& spray) {
  constexpr int kAround = 8;
  const double mass_kg = kCrestShare * sea::kWaterDensityKgPerM3 * volume_m3 / (kAround + 1);
  const double up = std::sqrt(2.0 * sea::kGravity * 2.0 * radius_m);
  Add(place_m, {0.0, 0.0, up}, mass_kg, spray);
  for (int n = 0; n < kAround; ++n) {
    const real::SinCosPair way = real::SinCos(2.0 * sea::kPi * n / kAround);
    const Vec3d out{way.cos, way.sin, 0.0};
    Add(place_m + 0.5 * radius_m * out, Vec3d{0, 0, 0.8 * up} + 0.3 * up * out, mass_kg, spray);
  }
}

}  // namespace onesea::world
