#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/wire/tile_codec.h"

namespace onesea::wire {

/// The newest state of one region. Spans are row-major, layout.cells.cells() each, finite.
struct TileField {
  RegionLayout layout;
  std::span<const float> height_m;  ///< none: as it was sent last (a far region at a lower rate)
  std::span<const float> foam;      ///< share of the surface, [0, 1]; none: as it was sent last
};

/// How far a receiver may be off before a tile is sent again.
struct TileTolerance {
  float height_steps = 1.0F;
  float foam_levels = 2.0F;  ///< of 255
};

/// Turns the fields of a session into the tiles that changed. Keeps what receivers hold, so errors
/// never add up: after every update each height is within `height_steps` of what was offered, and
/// within half a step in a tile just sent, up to 32767 steps. A tile within height_steps of zero is
/// sent as calm once and costs nothing from then on.
///
/// Allocates when a region appears or changes its sides, and until the bytes have found their size.
/// Not thread-safe.
class TileEncoder {
 public:
  explicit TileEncoder(const TileTolerance& tolerance = {});

  /// For receivers that have everything before. All regions that there are; who is missing has
  /// vanished. Valid until the next call. Pre: ValidateLayout, sizes as said.
  const TileUpdate& Encode(std::span<const TileField> fields);

  /// What receivers of everything hold now, for one who has nothing. Afterwards nobody's `before`
  /// is used until the tile is sent again, since the newcomer has none.
  TileUpdate Keyframe();

 private:
  void SetLayout(std::span<const TileField> fields);
  void EncodeRegion(const TileField& field, TileGrid& grid);
  void EncodeHeights(const TileField& field, const sea::CellRect& cells, Tile& tile, int n);
  void EncodeFoam(const TileField& field, const sea::CellRect& cells, Tile& tile, int n);
  void AddHeights(Tile& tile, int n);
  void EmitGroup();

  TileTolerance tolerance_;
  std::vector<RegionLayout> layout_;
  std::vector<TileGrid> grids_;  // same order
  TileUpdate update_;
  std::vector<std::string> spare_;  // blobs of earlier updates, for their capacity
  std::vector<RegionLayout> spare_layout_;
  Packer packer_;

  // Of the group in work.
  TileBlobHeader header_;
  int heights_count_ = 0, foams_count_ = 0;
  TileFloats values_;
  TileSteps steps_;
  TileBytes levels_;
  TileResiduals other_;
  std::array<TileResiduals, kGroupTiles> residuals_;
  std::array<std::uint8_t, kGroupTiles * kTileCells> foam_residuals_;
  std::array<std::uint8_t, kPlaneBytesMax> planes_;
};

}  // namespace onesea::wire
