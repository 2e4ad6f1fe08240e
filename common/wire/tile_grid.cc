#include "common/wire/tile_grid.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/wire/bounds.h"

namespace onesea::wire {
namespace {

std::int64_t FloorDivide(std::int64_t value, std::int64_t by) {
  return value / by - (value % by < 0 ? 1 : 0);
}

std::size_t Modulo(std::int64_t value, std::int64_t by) {
  return static_cast<std::size_t>(value - by * FloorDivide(value, by));
}

absl::Status CheckSide(const std::string& prefix, const char* field, int cells) {
  ONESEA_RETURN_IF_ERROR(CheckInteger(prefix, field, cells, kRegionSideMin, kRegionSideMax));
  if (cells % kRegionSideStep == 0) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(prefix, field, ": ", cells, " is not a multiple of ", kRegionSideStep));
}

absl::Status CheckRegion(const std::string& prefix, const RegionLayout& region) {
  if (region.id == 0) return absl::InvalidArgumentError(absl::StrCat(prefix, "id: 0"));
  const sea::CellRect& cells = region.cells;
  ONESEA_RETURN_IF_ERROR(
      CheckReal(prefix, "cell_m", cells.cell_m, kRegionCellMinM, kRegionCellMaxM));
  ONESEA_RETURN_IF_ERROR(CheckSide(prefix, "columns", cells.columns));
  ONESEA_RETURN_IF_ERROR(CheckSide(prefix, "rows", cells.rows));
  const auto far_cell = static_cast<std::int64_t>(kQueryCoordinateMaxM / cells.cell_m);
  ONESEA_RETURN_IF_ERROR(CheckInteger(prefix, "west", cells.west, -far_cell, far_cell));
  ONESEA_RETURN_IF_ERROR(CheckInteger(prefix, "south", cells.south, -far_cell, far_cell));
  return CheckReal(prefix, "height_step_m", region.height_step_m, kHeightStepMinM, kHeightStepMaxM);
}

}  // namespace

absl::Status ValidateLayout(std::span<const RegionLayout> layout) {
  ONESEA_RETURN_IF_ERROR(CheckSize("", "regions", layout.size(), kRegionsMax));
  std::int64_t cells = 0;
  for (std::size_t n = 0; n < layout.size(); ++n) {
    const std::string prefix = absl::StrCat("regions[", n, "].");
    ONESEA_RETURN_IF_ERROR(CheckRegion(prefix, layout[n]));
    for (std::size_t other = 0; other < n; ++other) {
      if (layout[other].id != layout[n].id) continue;
      return absl::InvalidArgumentError(
          absl::StrCat(prefix, "id: ", layout[n].id, " is also that of regions[", other, "]"));
    }
    cells += static_cast<std::int64_t>(layout[n].cells.cells());
  }
  return CheckInteger("regions", " cells", cells, 0, kRegionCellsMax);
}

bool Continues(const RegionLayout& a, const RegionLayout& b) {
  return a.id == b.id && a.height_step_m == b.height_step_m && a.cells.cell_m == b.cells.cell_m;
}

void Tile::CalmHeights() {
  if (heights_known == 0) return;
  heights_known = 0;
  height.fill(0);
  before.fill(0);
}

void Tile::CalmFoam() {
  if (!foamy) return;
  foamy = false;
  foam.fill(0);
}

TileGrid::TileGrid(const RegionLayout& layout)
    : layout_(layout),
      groups_wide_((layout.cells.columns + kGroupSide - 1) / kGroupSide + 1),
      groups_high_((layout.cells.rows + kGroupSide - 1) / kGroupSide + 1),
      groups_(static_cast<std::size_t>(groups_wide_) * groups_high_) {
  NameSlots();
}

void TileGrid::MoveTo(const RegionLayout& layout) {
  ONESEA_CHECK(Continues(layout_, layout)) << "region " << layout.id;
  if (layout.cells.columns != layout_.cells.columns || layout.cells.rows != layout_.cells.rows) {
    Resize(layout);
  }
  layout_ = layout;
  for (TileGroup& group : groups_) {
    for (int tile = 0; tile < kGroupTiles; ++tile) {
      if (Covers(group, tile)) continue;
      group.tiles[tile].CalmHeights();
      group.tiles[tile].CalmFoam();
    }
  }
  NameSlots();
}

// Storage for other sides; groups that both have keep their tiles.
void TileGrid::Resize(const RegionLayout& layout) {
  TileGrid other(layout);
  for (std::int64_t j = other.south_group(); j < other.north_group(); ++j) {
    for (std::int64_t i = other.west_group(); i < other.east_group(); ++i) {
      if (HasGroup(i, j)) other.Group(i, j) = Group(i, j);
    }
  }
  *this = std::move(other);
}

void TileGrid::Clear() {
  for (TileGroup& group : groups_) {
    for (Tile& tile : group.tiles) {
      tile.CalmHeights();
      tile.CalmFoam();
    }
  }
}

std::int64_t TileGrid::west_group() const { return FloorDivide(layout_.cells.west, kGroupSide); }
std::int64_t TileGrid::south_group() const { return FloorDivide(layout_.cells.south, kGroupSide); }
std::int64_t TileGrid::east_group() const {
  return FloorDivide(layout_.cells.east() - 1, kGroupSide) + 1;
}
std::int64_t TileGrid::north_group() const {
  return FloorDivide(layout_.cells.north() - 1, kGroupSide) + 1;
}

bool TileGrid::HasGroup(std::int64_t i, std::int64_t j) const {
  return i >= west_group() && i < east_group() && j >= south_group() && j < north_group();
}

TileGroup& TileGrid::Group(std::int64_t i, std::int64_t j) { return groups_[Slot(i, j)]; }
const TileGroup& TileGrid::Group(std::int64_t i, std::int64_t j) const {
  return groups_[Slot(i, j)];
}

sea::CellRect TileGrid::CellsOf(const TileGroup& group, int tile) const {
  return {.west = group.i * kGroupSide + (tile % 2) * kTileSide,
          .south = group.j * kGroupSide + (tile / 2) * kTileSide,
          .columns = kTileSide,
          .rows = kTileSide,
          .cell_m = layout_.cells.cell_m};
}

bool TileGrid::Covers(const TileGroup& group, int tile) const {
  return sea::Intersection(layout_.cells, CellsOf(group, tile)).cells() > 0;
}

std::size_t TileGrid::Slot(std::int64_t i, std::int64_t j) const {
  return Modulo(j, groups_high_) * static_cast<std::size_t>(groups_wide_) + Modulo(i, groups_wide_);
}

// A slot whose group changes held only tiles outside of the region, which are calm by now.
void TileGrid::NameSlots() {
  for (std::int64_t j = south_group(); j < north_group(); ++j) {
    for (std::int64_t i = west_group(); i < east_group(); ++i) {
      TileGroup& group = Group(i, j);
      group.i = i;
      group.j = j;
    }
  }
}

}  // namespace onesea::wire
