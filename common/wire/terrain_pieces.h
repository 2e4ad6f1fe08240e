#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "common/sea/terrain.h"

/// An encoded terrain on its way to a joiner: too large for one message, so it goes in pieces
/// (proto onesea.v1.GetTerrainResponse).
namespace onesea::wire {

/// Made once, sent to everybody.
struct EncodedTerrain {
  std::uint64_t hash = 0;  ///< TerrainHash()
  std::string bytes;       ///< EncodeTerrain()
};
/// Pre: ValidateTerrain(terrain) is OK.
EncodedTerrain PackTerrain(const sea::Terrain& terrain);

struct TerrainPiece {
  std::int64_t total_bytes = 0;  ///< of all pieces; of the first alone
  std::uint64_t hash = 0;        ///< of the first alone
  std::string_view bytes;
};

/// The piece that begins at `offset`. Pre: offset < terrain.bytes.size().
TerrainPiece PieceAt(const EncodedTerrain& terrain, std::size_t offset);

/// Puts the pieces together, whoever sent them. Takes no more memory than pieces that came.
class TerrainPieces {
 public:
  /// `hash`: of the terrain that is wanted.
  explicit TerrainPieces(std::uint64_t hash) : hash_(hash) {}

  /// In order. DataLoss if it can't be a piece of that terrain; then nothing more is to come.
  absl::Status Add(const TerrainPiece& piece);
  /// After the last. DataLoss if something is missing; else as DecodeTerrain().
  absl::StatusOr<sea::Terrain> Finish() const;

 private:
  std::uint64_t hash_;
  std::size_t total_bytes_ = 0;  // 0: no piece yet
  std::string bytes_;
};

}  // namespace onesea::wire
