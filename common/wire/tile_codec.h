#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "common/wire/tile_grid.h"
#include "common/wire/tile_kernel.h"
#include "common/wire/zstd_pack.h"

/// The bytes of the interaction layer: what one group of tiles becomes (WIRE.md, "Tiles").
namespace onesea::wire {

/// Changes of all regions in one frame, the same for every viewer.
struct TileUpdate {
  /// Every region that there is; empty optional: as before. Comes before the blobs.
  std::optional<std::vector<RegionLayout>> layout;
  /// One per changed group, each decodable without the others.
  std::vector<std::string> blobs;
};

/// What a blob says before its packed part.
struct TileBlobHeader {
  std::uint32_t region = 0;
  std::int64_t i = 0, j = 0;      ///< group
  std::uint8_t heights = 0;       ///< bit n: heights of tile n follow
  std::uint8_t foams = 0;         ///< bit n: foam of tile n follows
  std::uint8_t calm_heights = 0;  ///< bit n: heights of tile n are zero from here on
  std::uint8_t calm_foams = 0;
  std::array<Prediction, kGroupTiles> predictions{};  ///< of tiles whose heights follow
  std::array<WaveFit, kGroupTiles> fits{};            ///< of those predicted by kFitted

  /// Of the packed part when unpacked: the low bytes of all residuals of height, tile by tile, then
  /// their high bytes, then the residuals of foam.
  std::size_t PlaneBytes() const;
};

inline constexpr std::size_t kBlobHeaderBytesMax = 5 + 10 + 10 + 3 + 3 * kGroupTiles;
inline constexpr std::size_t kPlaneBytesMax = 3 * kGroupTiles * kTileCells;

void AppendHeader(const TileBlobHeader& header, std::string& out);
/// InvalidArgument for bytes that no encoder writes. `rest` becomes the packed part.
absl::StatusOr<TileBlobHeader> ReadHeader(std::string_view blob, std::string_view& rest);

}  // namespace onesea::wire
