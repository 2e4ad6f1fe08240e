#include "server/world/body_water.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/check.h"

namespace onesea::world {
namespace {

constexpr int kSideMin = 3, kSideMax = 13;
// A hull moves on while its samples stand still, and a mesh vertex may lie on its very rim.
constexpr double kMargin = 1.15;
// As good as 0 at any depth of a hull, and harmless times infinity.
constexpr double kInteractionWavenumber = 1e-6;

// Under the middle of a patch, below the mean level.
double DepthAt(const IncidentSea& sea, const WaterPatch& patch) {
  double depth_m = sea.depth_m > 0.0 ? sea.depth_m : std::numeric_limits<double>::infinity();
  if (sea.terrain != nullptr) {
    const Vec2d middle = patch.PlaceOf(0.5 * (patch.columns - 1), 0.5 * (patch.rows - 1));
    depth_m = std::min(depth_m, -sea.terrain->ElevationAt(middle));
  }
  return std::max(depth_m + sea.level_m, 0.1);
}

}  // namespace

void BodyWater::Clear() {
  count_ = 0;
  points_m_.clear();
}

std::size_t BodyWater::Add(const WaterUnder& body) {
  if (count_ == places_.size()) places_.emplace_back();
  Place& place = places_[count_];
  place.is_in_grid = body.is_in_grid;
  place.first_point = points_m_.size();
  const double longer_m = kMargin * std::max(body.half_m.x, body.half_m.y);
  const double spacing_m = std::max(0.5 * longer_m / kMargin, kSampleSpacingMinM);
  const auto samples = [](double half_m, double apart_m) {
    return std::clamp(static_cast<int>(std::ceil(2.0 * half_m / apart_m)) + 1, kSideMin, kSideMax);
  };
  WaterPatch& patch = place.patch;
  patch.cell_m = 2.0 * longer_m / (samples(longer_m, spacing_m) - 1);
  // Rounding must not ask for a sample more along the longer side.
  const double apart_m = 1.000001 * patch.cell_m;
  patch.columns = samples(kMargin * body.half_m.x, apart_m);
  patch.rows = samples(kMargin * body.half_m.y, apart_m);
  patch.along = body.along;
  patch.corner_m = body.centre_m;
  patch.corner_m = patch.PlaceOf(-0.5 * (patch.columns - 1), -0.5 * (patch.rows - 1));
  for (int row = 0; row < patch.rows; ++row) {
    for (int column = 0; column < patch.columns; ++column) {
      points_m_.push_back(patch.PlaceOf(column, row));
    }
  }
  return count_++;
}

void BodyWater::Fill(const IncidentSea& sea) {
  if (sea.waves != nullptr) {
    ONESEA_CHECK(sea.wavenumber_rad_per_m.size() == static_cast<std::size_t>(sea.waves->bands()));
    bands_.resize(4 * points_m_.size() * sea.wavenumber_rad_per_m.size());
    sea.waves->SampleBands(points_m_, bands_);
  }
  for (std::size_t n = 0; n < count_; ++n) FillOne(sea, places_[n]);
}

void BodyWater::AddInteraction(std::span<const sea::InteractionFelt> interaction) {
  ONESEA_CHECK(interaction.size() == points_m_.size());
  for (std::size_t n = 0; n < count_; ++n) {
    Place& place = places_[n];
    WaterPatch& patch = place.patch;
    for (std::size_t at = 0; at < place.points(); ++at) {
      const sea::InteractionFelt& felt = interaction[place.first_point + at];
      float* to = patch.samples.data() + 4 * (patch.bands * at + patch.bands - 1);
      to[0] = static_cast<float>(felt.height_m);
      if (place.is_in_grid) continue;
      to[1] = static_cast<float>(felt.velocity_m_per_s.x);
      to[2] = static_cast<float>(felt.velocity_m_per_s.y);
    }
  }
}

void BodyWater::FillOne(const IncidentSea& sea, Place& place) const {
  const std::size_t sea_bands = sea.waves == nullptr ? 0 : sea.wavenumber_rad_per_m.size();
  WaterPatch& patch = place.patch;
  patch.Resize(patch.columns, patch.rows, static_cast<int>(sea_bands) + 1);
  patch.level_m = sea.level_m;
  patch.current_m_per_s = {sea.current_m_per_s.x, sea.current_m_per_s.y, 0.0};
  patch.depth_m = DepthAt(sea, patch);
  for (std::size_t b = 0; b < sea_bands; ++b) {
    patch.wavenumber_rad_per_m[b] = sea.wavenumber_rad_per_m[b];
  }
  patch.wavenumber_rad_per_m[sea_bands] = kInteractionWavenumber;
  for (std::size_t n = 0; n < place.points(); ++n) {
    const float* from = bands_.data() + 4 * sea_bands * (place.first_point + n);
    float* to = patch.samples.data() + 4 * (sea_bands + 1) * n;
    std::copy(from, from + 4 * sea_bands, to);
    std::fill(to + 4 * sea_bands, to + 4 * sea_bands + 4, 0.0f);
  }
  if (place.is_in_grid) FillIncident(sea.level_m, place);
}

void BodyWater::FillIncident(double level_m, Place& place) const {
  const WaterPatch& patch = place.patch;
  HeightPatch& incident = place.incident;
  incident.west_m = patch.corner_m.x;
  incident.south_m = patch.corner_m.y;
  incident.cell_m = patch.cell_m;
  incident.columns = patch.columns;
  incident.rows = patch.rows;
  incident.height_m.resize(place.points());
  for (std::size_t n = 0; n < place.points(); ++n) {
    double height_m = level_m;
    for (int b = 0; b + 1 < patch.bands; ++b) {
      height_m += patch.samples[4 * (patch.bands * n + b)];
    }
    incident.height_m[n] = static_cast<float>(height_m);
  }
}

}  // namespace onesea::world
