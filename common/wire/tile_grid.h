#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "absl/status/status.h"
#include "common/base/limits.h"
#include "common/sea/cell_rect.h"

/// The tiles of one region as both ends of the wire hold them.
///
/// Tile (i, j) covers the cells [32 i, 32 i + 32) x [32 j, 32 j + 32) of the world lattice, so its
/// index means the same wherever the region went; 2 x 2 tiles with even first indices are a group,
/// which is what one blob carries.
namespace onesea::wire {

inline constexpr int kTileSide = kRegionSideStep;
inline constexpr int kTileCells = kTileSide * kTileSide;
inline constexpr int kGroupSide = 2 * kTileSide;
inline constexpr int kGroupTiles = 4;

/// A region as receivers see it.
struct RegionLayout {
  std::uint32_t id = 0;  ///< > 0, unique in a session
  sea::CellRect cells;
  double height_step_m = 1e-3;  ///< heights are whole numbers of it, [1e-4, 0.1]
  friend bool operator==(const RegionLayout&, const RegionLayout&) = default;
};

/// Number of regions, ids, sizes, cells of all together, places, steps. OK, or InvalidArgument with
/// field, value and limit.
absl::Status ValidateLayout(std::span<const RegionLayout> layout);

/// Does `b` go on where `a` was, perhaps moved or with other sides? Otherwise its tiles are calm.
bool Continues(const RegionLayout& a, const RegionLayout& b);

struct Tile {
  int heights_known = 0;  ///< 0: calm, both arrays are zero; 1: `height`; 2: `before` too
  bool foamy = false;     ///< false: `foam` is zero
  std::array<std::int16_t, kTileCells> height{};  ///< newest, steps, row-major from the south-west
  std::array<std::int16_t, kTileCells> before{};  ///< what `height` was before its last change
  std::array<std::uint8_t, kTileCells> foam{};    ///< 255ths

  void CalmHeights();
  void CalmFoam();
};

struct TileGroup {
  std::int64_t i = 0, j = 0;            ///< cells from 64 i east and 64 j north
  std::array<Tile, kGroupTiles> tiles;  ///< south-west, south-east, north-west, north-east
};

/// All tiles that have a cell in the region. Storage wraps around, so a region moves without
/// allocation; only new sides allocate.
class TileGrid {
 public:
  /// Calm. Pre: ValidateLayout.
  explicit TileGrid(const RegionLayout& layout);

  const RegionLayout& layout() const { return layout_; }
  /// Forgets the tiles that have no cell in the new rectangle. Pre: Continues(layout(), layout).
  void MoveTo(const RegionLayout& layout);
  /// All calm.
  void Clear();

  /// Of which groups a tile may have a cell in the region: [west_group, east_group) and so on.
  std::int64_t west_group() const;
  std::int64_t east_group() const;
  std::int64_t south_group() const;
  std::int64_t north_group() const;
  bool HasGroup(std::int64_t i, std::int64_t j) const;
  /// Pre: HasGroup(i, j).
  TileGroup& Group(std::int64_t i, std::int64_t j);
  const TileGroup& Group(std::int64_t i, std::int64_t j) const;
  /// The cells of tile `tile` of the group, without regard to the region.
  sea::CellRect CellsOf(const TileGroup& group, int tile) const;
  /// Has the tile a cell in the region?
  bool Covers(const TileGroup& group, int tile) const;

 private:
  std::size_t Slot(std::int64_t i, std::int64_t j) const;
  void NameSlots();
  void Resize(const RegionLayout& layout);

  RegionLayout layout_;
  int groups_wide_, groups_high_;  // enough for every alignment
  std::vector<TileGroup> groups_;
};

}  // namespace onesea::wire
