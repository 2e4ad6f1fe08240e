#include "common/sea/terrain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace onesea::sea {
namespace {

Terrain Plane() {
  Terrain terrain{
      .west_m = -10, .south_m = 20, .cell_m = 2, .columns = 6, .rows = 4, .elevation_m = {}};
  for (int j = 0; j < terrain.rows; ++j) {
    for (int i = 0; i < terrain.columns; ++i) {
      const double x = terrain.west_m + i * terrain.cell_m;
      const double y = terrain.south_m + j * terrain.cell_m;
      terrain.elevation_m.push_back(static_cast<float>(0.5 * x - 0.25 * y));
    }
  }
  return terrain;
}

TEST(Terrain, BilinearIsExactOnAPlane) {
  const Terrain terrain = Plane();
  for (double x = -10; x <= 0; x += 0.3) {
    for (double y = 20; y <= 26; y += 0.7) {
      EXPECT_NEAR(terrain.ElevationAt({x, y}), 0.5 * x - 0.25 * y, 1e-5);
    }
  }
}

TEST(Terrain, OutsideAnswersTheNearestEdge) {
  const Terrain terrain = Plane();
  EXPECT_NEAR(terrain.ElevationAt({-500, 22}), 0.5 * -10 - 0.25 * 22, 1e-5);
  EXPECT_NEAR(terrain.ElevationAt({1e6, 1e6}), 0.5 * 0 - 0.25 * 26, 1e-5);
}

TEST(Terrain, ErrorsNameTheField) {
  EXPECT_TRUE(ValidateTerrain(Plane()).ok());
  const auto message = [](auto change) {
    Terrain terrain = Plane();
    change(terrain);
    return std::string(ValidateTerrain(terrain).message());
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message([&](Terrain& t) { t.west_m = nan; }).find("terrain.west_m"), std::string::npos);
  EXPECT_NE(message([&](Terrain& t) { t.cell_m = 0; }).find("terrain.cell_m"), std::string::npos);
  EXPECT_NE(message([&](Terrain& t) { t.rows = 1; }).find("terrain.rows"), std::string::npos);
  EXPECT_NE(message([&](Terrain& t) { t.elevation_m.pop_back(); }).find("23 values"),
            std::string::npos);
  EXPECT_NE(message([&](Terrain& t) {
              t.elevation_m[7] = static_cast<float>(nan);
            }).find("elevation_m[7]"),
            std::string::npos);
}

TEST(Terrain, HashSeesEveryField) {
  const std::uint64_t hash = TerrainHash(Plane());
  EXPECT_EQ(hash, TerrainHash(Plane()));
  Terrain other = Plane();
  other.elevation_m[5] += 0.001f;
  EXPECT_NE(hash, TerrainHash(other));
  other = Plane();
  other.cell_m = 3;
  EXPECT_NE(hash, TerrainHash(other));
}

}  // namespace
}  // namespace onesea::sea
