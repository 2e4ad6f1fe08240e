#include "common/wire/tile_encoder.h"

#include <algorithm>
#include <utility>

#include "common/base/check.h"

namespace onesea::wire {
namespace {

constexpr int kZstdLevel = 1;  // 3 gives 2 % for half as much time again

bool SameRegions(const std::vector<RegionLayout>& layout, std::span<const TileField> fields) {
  return std::equal(
      layout.begin(), layout.end(), fields.begin(), fields.end(),
      [](const RegionLayout& a, const TileField& b) { return Continues(a, b.layout); });
}

std::uint8_t Bit(int tile) { return static_cast<std::uint8_t>(1U << tile); }

}  // namespace

TileEncoder::TileEncoder(const TileTolerance& tolerance)
    : tolerance_(tolerance), packer_(kZstdLevel) {
  ONESEA_CHECK(tolerance.height_steps >= 0.5F && tolerance.foam_levels >= 0.5F);
}

const TileUpdate& TileEncoder::Encode(std::span<const TileField> fields) {
  for (std::string& blob : update_.blobs) spare_.push_back(std::move(blob));
  update_.blobs.clear();
  if (update_.layout) spare_layout_ = *std::exchange(update_.layout, std::nullopt);
  SetLayout(fields);
  for (std::size_t n = 0; n < fields.size(); ++n) EncodeRegion(fields[n], grids_[n]);
  return update_;
}

void TileEncoder::SetLayout(std::span<const TileField> fields) {
  const bool same = SameRegions(layout_, fields);
  bool changed = !same;
  if (same) {
    for (std::size_t n = 0; n < fields.size(); ++n) {
      if (fields[n].layout == layout_[n]) continue;
      grids_[n].MoveTo(fields[n].layout);
      layout_[n] = fields[n].layout;
      changed = true;
    }
  } else {
    std::vector<TileGrid> grids;
    layout_.clear();
    for (const TileField& field : fields) {
      const auto old = std::find_if(grids_.begin(), grids_.end(), [&](const TileGrid& grid) {
        return Continues(grid.layout(), field.layout);
      });
      grids.push_back(old == grids_.end() ? TileGrid(field.layout) : std::move(*old));
      grids.back().MoveTo(field.layout);
      layout_.push_back(field.layout);
    }
    ONESEA_CHECK(ValidateLayout(layout_).ok()) << ValidateLayout(layout_);
    grids_ = std::move(grids);
  }
  if (!changed) return;
  spare_layout_ = layout_;
  update_.layout = std::move(spare_layout_);
}

void TileEncoder::EncodeRegion(const TileField& field, TileGrid& grid) {
  const std::size_t cells = field.layout.cells.cells();
  ONESEA_CHECK(field.height_m.empty() || field.height_m.size() == cells);
  ONESEA_CHECK(field.foam.empty() || field.foam.size() == cells);
  for (std::int64_t j = grid.south_group(); j < grid.north_group(); ++j) {
    for (std::int64_t i = grid.west_group(); i < grid.east_group(); ++i) {
      TileGroup& group = grid.Group(i, j);
      header_ = {.region = field.layout.id, .i = i, .j = j};
      heights_count_ = foams_count_ = 0;
      for (int n = 0; n < kGroupTiles; ++n) {
        if (!grid.Covers(group, n)) continue;
        const sea::CellRect tile_cells = grid.CellsOf(group, n);
        if (!field.height_m.empty()) EncodeHeights(field, tile_cells, group.tiles[n], n);
        if (!field.foam.empty()) EncodeFoam(field, tile_cells, group.tiles[n], n);
      }
      EmitGroup();
    }
  }
}

void TileEncoder::EncodeHeights(const TileField& field, const sea::CellRect& cells, Tile& tile,
                                int n) {
  static constexpr TileSteps kZeros{};
  const auto per_step = static_cast<float>(1.0 / field.layout.height_step_m);
  Gather(field.layout.cells, field.height_m, cells, per_step, values_);
  const float calm = LargestDifference(values_, kZeros);
  if (calm <= tolerance_.height_steps) {
    if (tile.heights_known > 0) header_.calm_heights |= Bit(n);
    tile.CalmHeights();
    return;
  }
  if (LargestDifference(values_, tile.height) <= tolerance_.height_steps) return;
  Quantise(values_, steps_);
  AddHeights(tile, n);
  tile.before = tile.height;
  tile.height = steps_;
  tile.heights_known = std::min(tile.heights_known + 1, 2);
}

void TileEncoder::AddHeights(Tile& tile, int n) {
  TileResiduals& residuals = residuals_[heights_count_++];
  header_.heights |= Bit(n);
  PredictHold(tile, steps_, residuals);
  if (tile.heights_known == 1) return;
  if (tile.heights_known == 2) {
    const WaveTerms terms(tile);
    header_.fits[n] = FitWave(tile, terms, steps_);
    PredictFitted(tile, terms, header_.fits[n], steps_, other_);
  } else {
    PredictSpatial(steps_, other_);
  }
  if (Cost(other_) >= Cost(residuals)) return;
  header_.predictions[n] = tile.heights_known == 2 ? Prediction::kFitted : Prediction::kSpatial;
  residuals = other_;
}

void TileEncoder::EncodeFoam(const TileField& field, const sea::CellRect& cells, Tile& tile,
                             int n) {
  static constexpr TileBytes kZeros{};
  Gather(field.layout.cells, field.foam, cells, 255.0F, values_);
  if (LargestDifference(values_, kZeros) <= tolerance_.foam_levels) {
    if (tile.foamy) header_.calm_foams |= Bit(n);
    tile.CalmFoam();
    return;
  }
  if (LargestDifference(values_, tile.foam) <= tolerance_.foam_levels) return;
  Quantise(values_, levels_);
  FoamResiduals(tile.foam, levels_, foam_residuals_.data() + foams_count_ * kTileCells);
  ++foams_count_;
  header_.foams |= Bit(n);
  tile.foam = levels_;
  tile.foamy = true;
}

void TileEncoder::EmitGroup() {
  const std::size_t bytes = header_.PlaneBytes();
  if (bytes == 0 && header_.calm_heights == 0 && header_.calm_foams == 0) return;
  if (spare_.empty()) {
    spare_.emplace_back().reserve(kBlobHeaderBytesMax + Packer::BytesMax(kPlaneBytesMax));
  }
  std::string& blob = update_.blobs.emplace_back(std::move(spare_.back()));
  spare_.pop_back();
  blob.clear();
  AppendHeader(header_, blob);
  if (bytes == 0) return;
  const auto heights = static_cast<std::size_t>(heights_count_) * kTileCells;
  for (int tile = 0; tile < heights_count_; ++tile) {
    std::uint8_t* low = planes_.data() + tile * kTileCells;
    std::uint8_t* high = low + heights;
    for (int n = 0; n < kTileCells; ++n) {
      low[n] = static_cast<std::uint8_t>(residuals_[tile][n]);
      high[n] = static_cast<std::uint8_t>(residuals_[tile][n] >> 8);
    }
  }
  std::copy_n(foam_residuals_.data(), foams_count_ * kTileCells, planes_.data() + 2 * heights);
  packer_.Append({planes_.data(), bytes}, blob);
}

TileUpdate TileEncoder::Keyframe() {
  TileUpdate sent = std::exchange(update_, {});
  update_.layout = layout_;
  for (TileGrid& grid : grids_) {
    for (std::int64_t j = grid.south_group(); j < grid.north_group(); ++j) {
      for (std::int64_t i = grid.west_group(); i < grid.east_group(); ++i) {
        header_ = {.region = grid.layout().id, .i = i, .j = j};
        heights_count_ = foams_count_ = 0;
        for (int n = 0; n < kGroupTiles; ++n) {
          Tile& tile = grid.Group(i, j).tiles[n];
          if (tile.heights_known > 0) {
            tile.heights_known = 1;
            header_.heights |= Bit(n);
            header_.predictions[n] = Prediction::kSpatial;
            PredictSpatial(tile.height, residuals_[heights_count_++]);
          }
          if (!tile.foamy) continue;
          header_.foams |= Bit(n);
          FoamResiduals({}, tile.foam, foam_residuals_.data() + foams_count_++ * kTileCells);
        }
        EmitGroup();
      }
    }
  }
  return std::exchange(update_, std::move(sent));
}

}  // namespace onesea::wire
