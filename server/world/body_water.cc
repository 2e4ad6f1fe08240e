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
    const Vec2d middle{patch.west_m + 0.5 * (patch.columns - 1) * patch.cell_m,
                       patch.south_m + 0.5 * (patch.rows - 1) * patch.cell_m};
    depth_m = std::min(depth_m, -sea.terrain->ElevationAt(middle));
  }
  return std::max(depth_m + sea.level_m, 0.1);
}

}  // namespace

void BodyWater::Clear() {
  count_ = 0;
  points_m_.clear();
}

std::size_t BodyWater::Add(Vec2d centre_m, double radius_m, bool in_flow) {
  if (count_ == places_.size()) places_.emplace_back();
  Place& place = places_[count_];
  place.in_flow = in_flow;
  const double half_m = kMargin * radius_m;
  const double spacing_m = std::max(0.5 * radius_m, kSampleSpacingMinM);
  place.side =
      std::clamp(static_cast<int>(std::ceil(2.0 * half_m / spacing_m)) + 1, kSideMin, kSideMax);
  place.first_point = points_m_.size();
  place.patch.west_m = place.incident.west_m = centre_m.x - half_m;
  place.patch.south_m = place.incident.south_m = centre_m.y - half_m;
  place.patch.cell_m = place.incident.cell_m = 2.0 * half_m / (place.side - 1);
  for (int row = 0; row < place.side; ++row) {
    for (int column = 0; column < place.side; ++column) {
      points_m_.push_back({place.patch.west_m + column * place.patch.cell_m,
                           place.patch.south_m + row * place.patch.cell_m});
    }
  }
  return count_++;
}

void BodyWater::Fill(const IncidentSea& sea, std::span<const sea::InteractionFelt> interaction) {
  ONESEA_CHECK(interaction.empty() || interaction.size() == points_m_.size());
  if (sea.waves != nullptr) {
    ONESEA_CHECK(sea.wavenumber_rad_per_m.size() == static_cast<std::size_t>(sea.waves->bands()));
    bands_.resize(4 * points_m_.size() * sea.wavenumber_rad_per_m.size());
    sea.waves->SampleBands(points_m_, bands_);
  }
  for (std::size_t n = 0; n < count_; ++n) FillOne(sea, places_[n]);
  if (!interaction.empty()) AddInteraction(interaction);
}

void BodyWater::AddInteraction(std::span<const sea::InteractionFelt> interaction) {
  ONESEA_CHECK(interaction.size() == points_m_.size());
  for (std::size_t n = 0; n < count_; ++n) {
    Place& place = places_[n];
    WaterPatch& patch = place.patch;
    const std::size_t points = static_cast<std::size_t>(place.side) * place.side;
    for (std::size_t at = 0; at < points; ++at) {
      const sea::InteractionFelt& felt = interaction[place.first_point + at];
      float* to = patch.samples.data() + 4 * (patch.bands * at + patch.bands - 1);
      to[0] = static_cast<float>(felt.height_m);
      if (!place.in_flow) continue;
      to[1] = static_cast<float>(felt.velocity_m_per_s.x);
      to[2] = static_cast<float>(felt.velocity_m_per_s.y);
    }
  }
}

void BodyWater::FillOne(const IncidentSea& sea, Place& place) const {
  const std::size_t sea_bands = sea.waves == nullptr ? 0 : sea.wavenumber_rad_per_m.size();
  WaterPatch& patch = place.patch;
  patch.Resize(place.side, place.side, static_cast<int>(sea_bands) + 1);
  patch.level_m = sea.level_m;
  patch.current_m_per_s = {sea.current_m_per_s.x, sea.current_m_per_s.y, 0.0};
  patch.depth_m = DepthAt(sea, patch);
  for (std::size_t b = 0; b < sea_bands; ++b) {
    patch.wavenumber_rad_per_m[b] = sea.wavenumber_rad_per_m[b];
  }
  patch.wavenumber_rad_per_m[sea_bands] = kInteractionWavenumber;
  const std::size_t points = static_cast<std::size_t>(place.side) * place.side;
  place.incident.columns = place.incident.rows = place.side;
  place.incident.height_m.resize(points);
  for (std::size_t n = 0; n < points; ++n) {
    const float* from = bands_.data() + 4 * sea_bands * (place.first_point + n);
    float* to = patch.samples.data() + 4 * (sea_bands + 1) * n;
    double height_m = sea.level_m;
    for (std::size_t b = 0; b < sea_bands; ++b) height_m += from[4 * b];
    std::copy(from, from + 4 * sea_bands, to);
    to += 4 * sea_bands;
    std::fill(to, to + 4, 0.0f);
    place.incident.height_m[n] = static_cast<float>(height_m);
  }
}

}  // namespace onesea::world
