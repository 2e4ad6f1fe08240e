#include "common/sea/attenuation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "common/base/check.h"
#include "common/base/real_math.h"
#include "common/sea/constants.h"
#include "common/sea/grid_place.h"

namespace onesea::sea {
namespace {

constexpr int kDirections = Attenuation::kDirections;
// Water shallower than this lets less than all through, none at the shore [m].
constexpr double kBarDepthM = 0.5;

// Share of a difference that evens out sideways from line to line: the shadow's edge is
// √(n / 2) cells wide after n of them.
constexpr double kSpread = 0.25;

// Adds variance to the two directions beside the wave's.
void AddDirection(double kx, double ky, double variance_m2, double* sums_m2) {
  const double turns = real::Atan2(ky, kx) / (2.0 * kPi);
  const double place = (turns < 0.0 ? turns + 1.0 : turns) * kDirections;
  const int low = std::min(static_cast<int>(place), kDirections - 1);
  sums_m2[low] += (1.0 - (place - low)) * variance_m2;
  sums_m2[(low + 1) % kDirections] += (place - low) * variance_m2;
}

}  // namespace

double AttenuationGrid::At(Vec2d place, int plane) const {
  const GridPlace x = LocateOnGrid((place.x - west_m) / cell_m, columns);
  const GridPlace y = LocateOnGrid((place.y - south_m) / cell_m, rows);
  const float* at = &factor[(static_cast<std::size_t>(y.cell) * columns + x.cell) * planes + plane];
  const std::size_t up = static_cast<std::size_t>(columns) * planes;
  const double south = at[0] + x.fraction * (double{at[planes]} - at[0]);
  const double north = at[up] + x.fraction * (double{at[up + planes]} - at[up]);
  return south + y.fraction * (north - south);
}

void AttenuationGrid::AllAt(Vec2d place, float* out, std::size_t stride) const {
  const GridPlace x = LocateOnGrid((place.x - west_m) / cell_m, columns);
  const GridPlace y = LocateOnGrid((place.y - south_m) / cell_m, rows);
  const float* at = &factor[(static_cast<std::size_t>(y.cell) * columns + x.cell) * planes];
  const float* up = at + static_cast<std::size_t>(columns) * planes;
  for (int p = 0; p < planes; ++p) {
    const double south = at[p] + x.fraction * (double{at[planes + p]} - at[p]);
    const double north = up[p] + x.fraction * (double{up[planes + p]} - up[p]);
    out[p * stride] = static_cast<float>(south + y.fraction * (north - south));
  }
}

Attenuation::Attenuation(const Components& components, std::shared_ptr<const Terrain> terrain)
    : terrain_(std::move(terrain)),
      entries_(components.recipe.timeline.size()),
      shoaling_(components) {
  SetDepths();
  arriving_.resize(depth_m_.size() * kDirections);
  for (int direction = 0; direction < kDirections; ++direction) CarryAlong(direction);
  SetShares(components);
}

void Attenuation::SetDepths() {
  const Terrain& terrain = *terrain_;
  const int side = std::max(terrain.columns, terrain.rows);
  const int stride = (side - 1 + kSideMax - 1) / kSideMax;
  shape_.west_m = terrain.west_m;
  shape_.south_m = terrain.south_m;
  shape_.cell_m = terrain.cell_m * stride;
  shape_.columns = std::max(2, (terrain.columns - 1) / stride + 1);
  shape_.rows = std::max(2, (terrain.rows - 1) / stride + 1);
  shape_.planes = shoaling_.planes();
  for (int j = 0; j < shape_.rows; ++j) {
    for (int i = 0; i < shape_.columns; ++i) {
      // The mean of what a coarse cell covers, so that a narrow wall still counts.
      double sum_m = 0.0;
      for (int b = 0; b < stride; ++b) {
        for (int a = 0; a < stride; ++a) {
          sum_m += terrain.ElevationAt({shape_.west_m + (i * stride + a) * terrain.cell_m,
                                        shape_.south_m + (j * stride + b) * terrain.cell_m});
        }
      }
      depth_m_.push_back(static_cast<float>(-sum_m / (stride * stride)));
    }
  }
}

// Every cell takes what its upstream neighbours have, line by line across the main axis of travel.
void Attenuation::CarryAlong(int direction) {
  const real::SinCosPair to = real::SinCos(2.0 * kPi * direction / kDirections);
  const bool along_x = std::abs(to.cos) >= std::abs(to.sin);
  const int lines = along_x ? shape_.columns : shape_.rows;
  const int places = along_x ? shape_.rows : shape_.columns;
  const double main = along_x ? to.cos : to.sin, side = along_x ? to.sin : to.cos;
  const double shift = side / std::abs(main);  // cells aside for one line
  std::vector<double> line(places, 1.0), next(places), wet(places);
  for (int n = 0; n < lines; ++n) {
    const int l = main > 0.0 ? n : lines - 1 - n;
    const auto cell = [&](int p) {
      return along_x ? static_cast<std::size_t>(p) * shape_.columns + l
                     : static_cast<std::size_t>(l) * shape_.columns + p;
    };
    for (int p = 0; p < places; ++p) {
      const double from = p - shift;
      const int low = static_cast<int>(std::floor(from));
      const auto value = [&](int at) { return at < 0 || at >= places ? 1.0 : line[at]; };
      wet[p] = std::clamp(depth_m_[cell(p)] / kBarDepthM, 0.0, 1.0);
      next[p] = wet[p] * (value(low) + (from - low) * (value(low + 1) - value(low)));
    }
    // What one cell gives another cell gets, across water only.
    for (int p = 0; p < places; ++p) {
      double gain = 0.0;
      if (p > 0) gain += std::min(wet[p], wet[p - 1]) * (next[p - 1] - next[p]);
      if (p + 1 < places) gain += std::min(wet[p], wet[p + 1]) * (next[p + 1] - next[p]);
      line[p] = next[p] + kSpread * gain;
      arriving_[cell(p) * kDirections + direction] = static_cast<float>(line[p]);
    }
  }
}

void Attenuation::SetShares(const Components& components) {
  direction_m2_.assign(shape_.planes * entries_ * kDirections, 0.0);
  for (int plane = 0; plane < shape_.planes; ++plane) {
    for (std::size_t m = 0; m < entries_; ++m) {
      double* sums_m2 = &direction_m2_[(plane * entries_ + m) * kDirections];
      if (plane < static_cast<int>(components.cascades.size())) {
        const CascadeComponents& waves = components.cascades[plane];
        for (std::size_t n = 0; n < waves.i.size(); ++n) {
          AddDirection(waves.kx_rad_per_m[n], waves.ky_rad_per_m[n], waves.variance_m2[m][n],
                       sums_m2);
        }
      } else {
        for (const RegularComponent& wave : components.regular) {
          AddDirection(wave.kx_rad_per_m, wave.ky_rad_per_m, wave.variance_m2[m], sums_m2);
        }
      }
    }
  }
}

// Share of each plane's variance that travels each way; all planes of a way side by side.
Attenuation::Shares Attenuation::SharesOf(std::span<const double> weights) const {
  Shares shares = {};
  for (int plane = 0; plane < shape_.planes; ++plane) {
    double whole_m2 = 0.0;
    for (std::size_t m = 0; m < entries_; ++m) {
      for (int t = 0; t < kDirections; ++t) {
        shares[t][plane] += weights[m] * direction_m2_[(plane * entries_ + m) * kDirections + t];
      }
    }
    for (const auto& way : shares) whole_m2 += way[plane];
    for (auto& way : shares) {
      way[plane] = whole_m2 > 0.0 ? way[plane] / whole_m2 : 1.0 / kDirections;
    }
  }
  return shares;
}

AttenuationGrid Attenuation::At(std::span<const double> weights) const {
  const DepthFactors depth_factors = shoaling_.At(weights);
  const Shares shares = SharesOf(weights);
  AttenuationGrid grid = shape_;
  grid.factor.resize(depth_m_.size() * grid.planes);
  for (std::size_t cell = 0; cell < depth_m_.size(); ++cell) {
    if (!(depth_m_[cell] > 0.0f)) continue;  // land
    // Every plane has a sum of its own in the order of ways, so they can go side by side.
    std::array<double, kPlanesMax> arriving = {};
    for (int t = 0; t < kDirections; ++t) {
      const double way = arriving_[cell * kDirections + t];
      for (int p = 0; p < kPlanesMax; ++p) arriving[p] += shares[t][p] * way;
    }
    const DepthFactors::Place depth = DepthFactors::PlaceOf(depth_m_[cell]);
    for (int p = 0; p < grid.planes; ++p) {
      grid.factor[cell * grid.planes + p] =
          static_cast<float>(depth_factors.At(p, depth) * std::sqrt(std::max(0.0, arriving[p])));
    }
  }
  for (const float f : grid.factor) grid.largest = std::max(grid.largest, f);
  return grid;
}

std::shared_ptr<const Components> OverTerrain(std::shared_ptr<const Components> components,
                                              std::shared_ptr<const Terrain> terrain) {
  if (terrain == nullptr) return components;
  auto over = std::make_shared<Components>(*components);
  over->attenuation = std::make_shared<const Attenuation>(*components, std::move(terrain));
  return over;
}

std::shared_ptr<const Terrain> TerrainOf(const Components& components) {
  return components.attenuation == nullptr ? nullptr : components.attenuation->shared_terrain();
}

const std::shared_ptr<const AttenuationGrid>& MovingAttenuation::At(SimTime time) {
  if (components_->attenuation == nullptr) return grid_;
  std::int64_t second = time.flicks / kFlicksPerSecond;
  if (time.flicks % kFlicksPerSecond < 0) --second;
  weights_.resize(components_->recipe.timeline.size());
  WeatherWeights(components_->recipe, SimTime{second * kFlicksPerSecond}, weights_);
  if (grid_ == nullptr || weights_ != weights_of_grid_) {
    grid_ = std::make_shared<const AttenuationGrid>(components_->attenuation->At(weights_));
    weights_of_grid_ = weights_;
  }
  return grid_;
}

}  // namespace onesea::sea
