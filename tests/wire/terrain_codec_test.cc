#include "common/wire/terrain_codec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "common/ingest/terrain_file.h"
#include "common/wire/zstd_pack.h"
#include "onesea/v1/terrain.pb.h"

namespace onesea::wire {
namespace {

using ::testing::HasSubstr;

sea::Terrain Hills(int columns, int rows, double step_m) {
  sea::Terrain terrain{.west_m = -1234.5,
                       .south_m = 6e5,
                       .cell_m = 5.0,
                       .columns = columns,
                       .rows = rows,
                       .elevation_m = {}};
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const double e = 12 * std::sin(0.03 * i) * std::cos(0.05 * j) - 8 + 0.02 * i;
      terrain.elevation_m.push_back(
          static_cast<float>(step_m > 0 ? std::round(e / step_m) / std::round(1 / step_m) : e));
    }
  }
  return terrain;
}

void ExpectSame(const sea::Terrain& a, const sea::Terrain& b) {
  EXPECT_EQ(a.west_m, b.west_m);
  EXPECT_EQ(a.south_m, b.south_m);
  EXPECT_EQ(a.cell_m, b.cell_m);
  ASSERT_EQ(a.columns, b.columns);
  ASSERT_EQ(a.rows, b.rows);
  for (std::size_t n = 0; n < a.elevation_m.size(); ++n) {
    ASSERT_EQ(a.elevation_m[n], b.elevation_m[n]) << n;
  }
}

void ExpectRoundTrip(const sea::Terrain& terrain) {
  const auto again = DecodeTerrain(EncodeTerrain(terrain));
  ASSERT_TRUE(again.ok()) << again.status();
  ExpectSame(terrain, *again);
}

int StepsPerM(const sea::Terrain& terrain) {
  v1::Terrain message;
  message.ParseFromString(EncodeTerrain(terrain));
  return message.steps_per_m();
}

TEST(TerrainCodec, KeepsEverySampleExactly) {
  for (const double step_m : {0.0, 1.0, 0.1, 0.01, 0.001}) {
    const sea::Terrain terrain = Hills(97, 45, step_m);
    ExpectRoundTrip(terrain);
    EXPECT_EQ(StepsPerM(terrain), step_m > 0 ? std::lround(1 / step_m) : 0);
  }
  sea::Terrain odd = Hills(7, 5, 0.0);
  odd.elevation_m[3] = -0.0f;
  odd.elevation_m[4] = 1e-42f;  // subnormal
  odd.elevation_m[5] = -12000.0f;
  odd.elevation_m[6] = 12000.0f;
  ExpectRoundTrip(odd);
}

TEST(TerrainCodec, KeepsNoiseExactly) {
  std::mt19937_64 random(3);
  sea::Terrain noise = Hills(64, 64, 0.0);
  for (float& e : noise.elevation_m) {
    do {
      e = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    } while (!(std::abs(e) <= 12000.0f));
  }
  ExpectRoundTrip(noise);
}

TEST(TerrainCodec, RealBottomTakesLessThanAByteAndAHalfASample) {
  const auto bottom = ingest::ReadTerrainFile("tests/data/terrain/haringvliet.asc", {});
  ASSERT_TRUE(bottom.ok()) << bottom.status();
  ExpectRoundTrip(*bottom);
  EXPECT_LT(EncodeTerrain(*bottom).size(), bottom->elevation_m.size() * 3 / 2);
  // Smooth whole centimetres are far below the four bytes of a float.
  EXPECT_LT(EncodeTerrain(Hills(400, 400, 0.01)).size(), 400 * 400);
}

std::string Refusal(const auto& change) {
  v1::Terrain message;
  EXPECT_TRUE(message.ParseFromString(EncodeTerrain(Hills(9, 8, 0.01))));
  change(message);
  return DecodeTerrain(message.SerializeAsString()).status().ToString();
}

TEST(TerrainCodec, RefusalsNameTheField) {
  using M = v1::Terrain;
  EXPECT_THAT(Refusal([](M& m) { m.set_columns(5000); }), HasSubstr("terrain.columns = 5000"));
  EXPECT_THAT(Refusal([](M& m) { m.set_rows(-1); }), HasSubstr("terrain.rows = -1"));
  EXPECT_THAT(Refusal([](M& m) { m.set_steps_per_m(7); }), HasSubstr("terrain.steps_per_m = 7"));
  EXPECT_THAT(Refusal([](M& m) { m.set_cell_m(NAN); }), HasSubstr("terrain.cell_m"));
  EXPECT_THAT(Refusal([](M& m) { m.set_west_m(1e300); }), HasSubstr("terrain.west_m"));
  EXPECT_THAT(Refusal([](M& m) { m.set_columns(4096), m.set_rows(4096); }),
              HasSubstr("content size"));
  EXPECT_THAT(Refusal([](M& m) { m.clear_samples(); }), HasSubstr("terrain.samples"));
  EXPECT_THAT(Refusal([](M& m) { m.set_hash(m.hash() + 1); }), HasSubstr("terrain.hash"));
  EXPECT_THAT(Refusal([](M& m) {  // every sample a NaN
                m.set_steps_per_m(0);
                m.clear_samples();
                Packer(1).Append(std::vector<std::uint8_t>(9 * 8 * 4, 0xFF), *m.mutable_samples());
              }),
              HasSubstr("terrain"));
  EXPECT_EQ(DecodeTerrain("\xff\xff").status().code(), absl::StatusCode::kDataLoss);
  EXPECT_FALSE(DecodeTerrain("").ok());
}

TEST(TerrainCodec, DamagedBytesAreRefusedOrHarmless) {
  const std::string whole = EncodeTerrain(Hills(33, 21, 0.1));
  for (std::size_t cut = 0; cut < whole.size(); ++cut) {
    EXPECT_FALSE(DecodeTerrain(whole.substr(0, cut)).ok()) << cut;
  }
  std::mt19937_64 random(4);
  for (int n = 0; n < 20'000; ++n) {
    std::string bytes = whole;
    bytes[random() % bytes.size()] ^= static_cast<char>(1 << (random() % 8));
    const auto decoded = DecodeTerrain(bytes);
    if (decoded.ok()) {
      EXPECT_TRUE(sea::ValidateTerrain(*decoded).ok());
    }
  }
}

}  // namespace
}  // namespace onesea::wire
