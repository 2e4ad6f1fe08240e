#include "server/world/obstacles.h"

#include <algorithm>
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
  for (std::int64_t j = region.south; j < region.north(); ++j) {
    for (std::int64_t i = region.west; i < region.east(); ++i) {
      const Vec2d place = region.PlaceOf(i, j);
      const bool solid = std::any_of(polygons_.begin(), polygons_.end(), [&](const auto& entry) {
        return InsidePolygon(entry.second, place);
      });
      if (!solid) continue;
      cells.index.push_back(static_cast<std::size_t>(j - region.south) * region.columns +
                            static_cast<std::size_t>(i - region.west));
      cells.place_m.push_back(place);
    }
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
