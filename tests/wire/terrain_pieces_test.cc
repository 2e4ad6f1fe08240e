#include "common/wire/terrain_pieces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "common/base/limits.h"

namespace onesea::wire {
namespace {

using ::testing::HasSubstr;

// Noise does not pack: 600 x 600 samples make more than one piece.
const sea::Terrain& Noise() {
  static const sea::Terrain terrain = [] {
    sea::Terrain made{
        .west_m = -5, .south_m = 7, .cell_m = 2.5, .columns = 600, .rows = 600, .elevation_m = {}};
    std::mt19937 random(5);
    std::uniform_real_distribution<float> metres(-12000.0f, 12000.0f);
    for (int n = 0; n < 600 * 600; ++n) made.elevation_m.push_back(metres(random));
    return made;
  }();
  return terrain;
}

std::vector<TerrainPiece> Pieces(const EncodedTerrain& encoded) {
  std::vector<TerrainPiece> pieces;
  for (std::size_t at = 0; at < encoded.bytes.size(); at += pieces.back().bytes.size()) {
    pieces.push_back(PieceAt(encoded, at));
  }
  return pieces;
}

absl::StatusOr<sea::Terrain> PutTogether(std::uint64_t hash,
                                         const std::vector<TerrainPiece>& pieces) {
  TerrainPieces together(hash);
  for (const TerrainPiece& piece : pieces) {
    if (absl::Status status = together.Add(piece); !status.ok()) return status;
  }
  return together.Finish();
}

void ExpectRefused(std::uint64_t hash, const std::vector<TerrainPiece>& pieces,
                   const std::string& why) {
  const absl::Status status = PutTogether(hash, pieces).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kDataLoss) << status;
  EXPECT_THAT(status.message(), HasSubstr(why));
}

TEST(TerrainPieces, TogetherAreTheTerrain) {
  const EncodedTerrain encoded = PackTerrain(Noise());
  const std::vector<TerrainPiece> pieces = Pieces(encoded);
  ASSERT_GE(pieces.size(), 3u);
  std::size_t bytes = 0;
  for (const TerrainPiece& piece : pieces) {
    EXPECT_LE(piece.bytes.size(), kTerrainPieceBytesMax);
    bytes += piece.bytes.size();
  }
  EXPECT_EQ(pieces[0].total_bytes, static_cast<std::int64_t>(bytes));
  const absl::StatusOr<sea::Terrain> terrain = PutTogether(encoded.hash, pieces);
  ASSERT_TRUE(terrain.ok()) << terrain.status();
  EXPECT_EQ(terrain->elevation_m, Noise().elevation_m);
  EXPECT_EQ(terrain->west_m, -5);
}

TEST(TerrainPieces, WhatIsCutOrTornOrStrangeIsRefused) {
  const EncodedTerrain encoded = PackTerrain(Noise());
  const std::uint64_t hash = encoded.hash;
  const std::vector<TerrainPiece> good = Pieces(encoded);
  ExpectRefused(hash, {}, "cut after 0");
  std::vector<TerrainPiece> bad = good;
  bad.pop_back();
  ExpectRefused(hash, bad, "cut after");
  bad = good;
  bad.push_back(good[1]);
  ExpectRefused(hash, bad, "more than the");
  bad = good;
  bad[1].bytes = "";
  ExpectRefused(hash, bad, "terrain.piece: 0 bytes");
  const std::string large(kTerrainPieceBytesMax + 1, 'x');
  bad = good;
  bad[1].bytes = large;
  ExpectRefused(hash, bad, "terrain.piece: 524289 bytes");
  bad = good;
  std::swap(bad[1].bytes, bad[2].bytes);
  EXPECT_EQ(PutTogether(hash, bad).status().code(), absl::StatusCode::kDataLoss);
  for (const std::int64_t total : {std::int64_t{0}, std::int64_t{-1}, std::int64_t{72 << 20} + 1}) {
    bad = good;
    bad[0].total_bytes = total;
    ExpectRefused(hash, bad, "terrain.total_bytes");
  }
  ExpectRefused(hash + 1, good, "terrain.hash");
  // Whoever tells the wanted hash but sends another terrain.
  bad = good;
  bad[0].hash = hash + 1;
  ExpectRefused(hash + 1, bad, "terrain.hash: the content has");
}

// The one limit that a real terrain could meet: the largest, of samples that don't pack.
TEST(TerrainPieces, TheLargestTerrainFits) {
  constexpr std::size_t kSamples =
      static_cast<std::size_t>(kTerrainSideMax) * static_cast<std::size_t>(kTerrainSideMax);
  // Zstandard adds at most 1/256 and a few bytes to what it can't pack.
  EXPECT_LT(4 * kSamples + 4 * kSamples / 256 + 1024, kTerrainBytesMax);
}

}  // namespace
}  // namespace onesea::wire
