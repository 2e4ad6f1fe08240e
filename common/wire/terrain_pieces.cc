#include "common/wire/terrain_pieces.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/wire/terrain_codec.h"

namespace onesea::wire {

EncodedTerrain PackTerrain(const sea::Terrain& terrain) {
  return {sea::TerrainHash(terrain), EncodeTerrain(terrain)};
}

TerrainPiece PieceAt(const EncodedTerrain& terrain, std::size_t offset) {
  ONESEA_CHECK(offset < terrain.bytes.size());
  TerrainPiece piece;
  if (offset == 0) {
    piece.total_bytes = static_cast<std::int64_t>(terrain.bytes.size());
    piece.hash = terrain.hash;
  }
  piece.bytes = std::string_view(terrain.bytes).substr(offset, kTerrainPieceBytesMax);
  return piece;
}

absl::Status TerrainPieces::Add(const TerrainPiece& piece) {
  if (total_bytes_ == 0) {
    if (!(piece.total_bytes > 0 &&
          piece.total_bytes <= static_cast<std::int64_t>(kTerrainBytesMax))) {
      return absl::DataLossError(absl::StrCat("terrain.total_bytes: ", piece.total_bytes,
                                              " is outside [1, ", kTerrainBytesMax, "]"));
    }
    if (piece.hash != hash_) {
      return absl::DataLossError(absl::StrFormat(
          "terrain.hash: %016x was sent, %016x is the session's", piece.hash, hash_));
    }
    total_bytes_ = static_cast<std::size_t>(piece.total_bytes);
  }
  if (piece.bytes.empty() || piece.bytes.size() > kTerrainPieceBytesMax) {
    return absl::DataLossError(absl::StrCat("terrain.piece: ", piece.bytes.size(),
                                            " bytes, outside [1, ", kTerrainPieceBytesMax, "]"));
  }
  if (piece.bytes.size() > total_bytes_ - bytes_.size()) {
    return absl::DataLossError(
        absl::StrCat("terrain.piece: more than the ", total_bytes_, " bytes that were told"));
  }
  bytes_.append(piece.bytes);
  return absl::OkStatus();
}

absl::StatusOr<sea::Terrain> TerrainPieces::Finish() const {
  if (total_bytes_ == 0 || bytes_.size() != total_bytes_) {
    return absl::DataLossError(
        absl::StrCat("terrain: cut after ", bytes_.size(), " of ", total_bytes_, " bytes"));
  }
  ONESEA_ASSIGN_OR_RETURN(sea::Terrain terrain, DecodeTerrain(bytes_));
  // DecodeTerrain has compared the content with the hash in the bytes; that is the one told first?
  if (const std::uint64_t hash = sea::TerrainHash(terrain); hash != hash_) {
    return absl::DataLossError(
        absl::StrFormat("terrain.hash: the content has %016x, %016x was told", hash, hash_));
  }
  return terrain;
}

}  // namespace onesea::wire
