#include "server/world/obstacles.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/limits.h"

namespace onesea::world {

bool InsidePolygon(std::span<const Vec2d> corners_m, Vec2d place) {
  // Counts the edges that a ray to the east crosses.
  bool inside = false;
  for (std::size_t n = 0; n < corners_m.size(); ++n) {
    const Vec2d a = corners_m[n], b = corners_m[(n + 1) % corners_m.size()];
    if ((a.y > place.y) == (b.y > place.y)) continue;
    if (place.x < a.x + (place.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

namespace {

// The first cell and one past the last of those that [low, high] m covers, within [first, end).
std::pair<std::int64_t, std::int64_t> CellSpan(double low_m, double high_m, double cell_m,
                                               std::int64_t first, std::int64_t end) {
  const double low =
      std::clamp(std::ceil(low_m / cell_m), static_cast<double>(first), static_cast<double>(end));
  const double high = std::clamp(std::floor(high_m / cell_m) + 1.0, static_cast<double>(first),
                                 static_cast<double>(end));
  return {static_cast<std::int64_t>(low), static_cast<std::int64_t>(high)};
}

// Marks the cells of the region inside the polygon. Cost: its corners times the cells of the box
// around it.
void Fill(const sea::CellRect& region, std::span<const Vec2d> corners_m, std::vector<bool>& solid) {
  const auto [west, east] = std::minmax_element(corners_m.begin(), corners_m.end(),
                                                [](Vec2d a, Vec2d b) { return a.x < b.x; });
  const auto [south, north] = std::minmax_element(corners_m.begin(), corners_m.end(),
                                                  [](Vec2d a, Vec2d b) { return a.y < b.y; });
  const auto [i_first, i_end] =
      CellSpan(west->x, east->x, region.cell_m, region.west, region.east());
  const auto [j_first, j_end] =
      CellSpan(south->y, north->y, region.cell_m, region.south, region.north());
  for (std::int64_t j = j_first; j < j_end; ++j) {
    for (std::int64_t i = i_first; i < i_end; ++i) {
      if (!InsidePolygon(corners_m, region.PlaceOf(i, j))) continue;
      solid[region.IndexOf(i, j)] = true;
    }
  }
}

}  // namespace

void Obstacles::Set(std::uint32_t id, std::vector<Vec2d> corners_m) {
  polygons_[id] = std::move(corners_m);
  cells_.clear();
}

bool Obstacles::Remove(std::uint32_t id) {
  cells_.clear();
  return polygons_.erase(id) > 0;
}

const Obstacles::Cells& Obstacles::CellsIn(const sea::CellRect& region) {
  for (const Cells& cells : cells_) {
    if (cells.region == region) return cells;
  }
  if (cells_.size() >= 2 * kRegionsMax) cells_.clear();  // of regions that moved on
  Cells& cells = cells_.emplace_back();
  cells.region = region;
  std::vector<bool> solid(region.cells());
  for (const auto& [id, corners_m] : polygons_) Fill(region, corners_m, solid);
  for (std::size_t n = 0; n < solid.size(); ++n) {
    if (!solid[n]) continue;
    cells.index.push_back(n);
    cells.place_m.push_back(region.PlaceOfIndex(n));
  }
  return cells;
}

void Obstacles::AddTo(Hash64& hash) const {
  for (const auto& [id, corners] : polygons_) {
    hash.Add(id);
    for (const Vec2d& corner : corners) {
      hash.Add(corner.x);
      hash.Add(corner.y);
    }
  }
}

}  // namespace onesea::world
