#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "common/base/hash.h"
#include "common/base/vec.h"
#include "server/world/interaction_layer.h"

/// Walls that waves don't pass: polygons that stand in the water.
namespace onesea::world {

/// Is the place inside? Places on an edge may count either way.
bool InsidePolygon(std::span<const Vec2d> corners_m, Vec2d place);

/// Not thread-safe.
class Obstacles {
 public:
  void Set(std::uint32_t id, std::vector<Vec2d> corners_m);
  bool Remove(std::uint32_t id);
  bool empty() const { return polygons_.empty(); }
  std::size_t size() const { return polygons_.size(); }
  bool Contains(std::uint32_t id) const { return polygons_.contains(id); }

  /// The solid cells of one region. Kept until the region or an obstacle changes.
  struct Cells {
    sea::CellRect region;
    std::vector<std::size_t> index;  ///< in the region's fields
    std::vector<Vec2d> place_m;      ///< same order
  };
  const Cells& CellsIn(const sea::CellRect& region);

  void AddTo(Hash64& hash) const;

 private:
  std::map<std::uint32_t, std::vector<Vec2d>> polygons_;
  std::vector<Cells> cells_;
};

}  // namespace onesea::world
