#include "common/wire/tile_store.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"

namespace onesea::wire {
namespace {

bool Has(unsigned bits, int tile) { return (bits >> tile & 1) != 0; }

RegionField Calm(const RegionLayout& layout) {
  const std::size_t cells = layout.cells.cells();
  return {layout, std::vector<float>(cells), std::vector<float>(cells)};
}

}  // namespace

absl::Status TileStore::Apply(const TileUpdate& update, bool keyframe) {
  const bool fits = current_ || keyframe;
  current_ = false;
  if (!fits) return absl::FailedPreconditionError("tiles: a keyframe is needed first");
  ONESEA_RETURN_IF_ERROR(ApplyAll(update, keyframe));
  current_ = true;
  return absl::OkStatus();
}

absl::Status TileStore::ApplyAll(const TileUpdate& update, bool keyframe) {
  if (keyframe) {
    if (!update.layout) return absl::InvalidArgumentError("tiles: a keyframe without regions");
    for (std::size_t n = 0; n < grids_.size(); ++n) {
      grids_[n].Clear();
      std::fill(fields_[n].height_m.begin(), fields_[n].height_m.end(), 0.0F);
      std::fill(fields_[n].foam.begin(), fields_[n].foam.end(), 0.0F);
    }
  }
  if (update.layout) ONESEA_RETURN_IF_ERROR(SetLayout(*update.layout));
  for (const std::string& blob : update.blobs) ONESEA_RETURN_IF_ERROR(ApplyBlob(blob));
  return absl::OkStatus();
}

absl::Status TileStore::SetLayout(std::span<const RegionLayout> layout) {
  ONESEA_RETURN_IF_ERROR(ValidateLayout(layout));
  for (std::size_t n = 0; n < layout.size(); ++n) {
    const auto begin = grids_.begin() + static_cast<std::ptrdiff_t>(n);
    const auto old = std::find_if(begin, grids_.end(), [&](const TileGrid& grid) {
      return Continues(grid.layout(), layout[n]);
    });
    if (old == grids_.end()) {
      grids_.emplace(begin, layout[n]);
      fields_.insert(fields_.begin() + static_cast<std::ptrdiff_t>(n), Calm(layout[n]));
      continue;
    }
    std::swap(grids_[n], *old);
    std::swap(fields_[n], fields_[static_cast<std::size_t>(old - grids_.begin())]);
    if (grids_[n].layout() != layout[n]) MoveRegion(n, layout[n]);
  }
  grids_.erase(grids_.begin() + static_cast<std::ptrdiff_t>(layout.size()), grids_.end());
  fields_.erase(fields_.begin() + static_cast<std::ptrdiff_t>(layout.size()), fields_.end());
  return absl::OkStatus();
}

void TileStore::MoveRegion(std::size_t region, const RegionLayout& layout) {
  TileGrid& grid = grids_[region];
  grid.MoveTo(layout);
  fields_[region].layout = layout;
  fields_[region].height_m.resize(layout.cells.cells());
  fields_[region].foam.resize(layout.cells.cells());
  for (std::int64_t j = grid.south_group(); j < grid.north_group(); ++j) {
    for (std::int64_t i = grid.west_group(); i < grid.east_group(); ++i) {
      const TileGroup& group = grid.Group(i, j);
      for (int tile = 0; tile < kGroupTiles; ++tile) Show(grid, group, tile, fields_[region]);
    }
  }
}

absl::Status TileStore::ApplyBlob(std::string_view blob) {
  std::string_view packed;
  ONESEA_ASSIGN_OR_RETURN(const TileBlobHeader header, ReadHeader(blob, packed));
  const auto found = std::find_if(grids_.begin(), grids_.end(), [&](const TileGrid& grid) {
    return grid.layout().id == header.region;
  });
  if (found == grids_.end()) {
    return absl::InvalidArgumentError(absl::StrCat("tile blob: no region ", header.region));
  }
  ONESEA_RETURN_IF_ERROR(CheckHeader(header, *found));
  if (header.PlaneBytes() > 0) {
    ONESEA_RETURN_IF_ERROR(unpacker_.Fill(packed, {planes_.data(), header.PlaneBytes()}));
  }
  TileGroup& group = found->Group(header.i, header.j);
  ApplyPlanes(header, group);
  RegionField& field = fields_[static_cast<std::size_t>(found - grids_.begin())];
  for (int tile = 0; tile < kGroupTiles; ++tile) {
    const unsigned touched =
        header.heights | header.foams | header.calm_heights | header.calm_foams;
    if (Has(touched, tile)) Show(*found, group, tile, field);
  }
  return absl::OkStatus();
}

absl::Status TileStore::CheckHeader(const TileBlobHeader& header, const TileGrid& grid) const {
  if (!grid.HasGroup(header.i, header.j)) {
    return absl::InvalidArgumentError(absl::StrCat("tile blob: group ", header.i, ", ", header.j,
                                                   " is outside of region ", header.region));
  }
  const TileGroup& group = grid.Group(header.i, header.j);
  const unsigned touched = header.heights | header.foams | header.calm_heights | header.calm_foams;
  for (int tile = 0; tile < kGroupTiles; ++tile) {
    if (Has(touched, tile) && !grid.Covers(group, tile)) {
      return absl::InvalidArgumentError(absl::StrCat("tile blob: tile ", tile, " of group ",
                                                     header.i, ", ", header.j,
                                                     " is outside of region ", header.region));
    }
    if (header.predictions[tile] == Prediction::kFitted && group.tiles[tile].heights_known < 2) {
      return absl::FailedPreconditionError("tile blob: needs a frame that is missing");
    }
  }
  return absl::OkStatus();
}

void TileStore::ApplyPlanes(const TileBlobHeader& header, TileGroup& group) {
  TileResiduals residuals;
  const std::uint8_t* low = planes_.data();
  const std::uint8_t* foam = planes_.data() + header.PlaneBytes();
  for (int tile = 0; tile < kGroupTiles; ++tile) foam -= Has(header.foams, tile) ? kTileCells : 0;
  const std::uint8_t* high = low + (foam - low) / 2;
  for (int n = 0; n < kGroupTiles; ++n) {
    Tile& tile = group.tiles[n];
    if (Has(header.calm_heights, n)) tile.CalmHeights();
    if (Has(header.calm_foams, n)) tile.CalmFoam();
    if (Has(header.heights, n)) {
      for (int cell = 0; cell < kTileCells; ++cell) {
        residuals[cell] = static_cast<std::uint16_t>(low[cell] | (high[cell] << 8));
      }
      low += kTileCells;
      high += kTileCells;
      TileSteps steps;
      Undo(header.predictions[n], header.fits[n], tile, residuals, steps);
      tile.before = tile.height;
      tile.height = steps;
      tile.heights_known = std::min(tile.heights_known + 1, 2);
    }
    if (Has(header.foams, n)) {
      UndoFoam(foam, tile.foam);
      foam += kTileCells;
      tile.foamy = true;
    }
  }
}

void TileStore::Show(const TileGrid& grid, const TileGroup& group, int tile,
                     RegionField& field) const {
  const sea::CellRect cells = grid.CellsOf(group, tile);
  const sea::CellRect& region = field.layout.cells;
  const sea::CellRect common = sea::Intersection(region, cells);
  const auto step_m = static_cast<float>(field.layout.height_step_m);
  const Tile& from = group.tiles[tile];
  for (int row = 0; row < common.rows; ++row) {
    const std::int64_t j = common.south + row;
    const std::int64_t at = (j - region.south) * region.columns + common.west - region.west;
    const std::int64_t source = (j - cells.south) * kTileSide + common.west - cells.west;
    for (int column = 0; column < common.columns; ++column) {
      field.height_m[at + column] = step_m * static_cast<float>(from.height[source + column]);
      field.foam[at + column] = static_cast<float>(from.foam[source + column]) * (1.0F / 255.0F);
    }
  }
}

}  // namespace onesea::wire
