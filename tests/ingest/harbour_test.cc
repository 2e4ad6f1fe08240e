// The terrain of `deploy/run harbour` is what its description says, and keeps the swell out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/ingest/terrain_file.h"
#include "common/sea/attenuation.h"
#include "common/sea/recipe.h"

namespace onesea::ingest {
namespace {

sea::Terrain Harbour() {
  const auto terrain = ReadTerrainFile("deploy/terrain/harbour.asc.gz", {});
  EXPECT_TRUE(terrain.ok()) << terrain.status();
  return terrain.value_or(sea::Terrain{});
}

TEST(Harbour, HasTheDepthsThatAreTold) {
  const sea::Terrain terrain = Harbour();
  ASSERT_EQ(terrain.columns, 401);
  ASSERT_EQ(terrain.rows, 401);
  EXPECT_EQ(terrain.cell_m, 5.0);
  EXPECT_EQ(terrain.west_m, -1000.0);
  const auto depth = [&](double x, double y) { return -terrain.ElevationAt({x, y}); };
  // The basin, clear of jetty and slopes.
  for (double x = -80; x <= 280; x += 20) {
    for (double y = -170; y <= 20; y += 10) {
      if (std::abs(x - 120) < 20) continue;
      EXPECT_GE(depth(x, y), 3.9) << x << ' ' << y;
      EXPECT_LE(depth(x, y), 8.3) << x << ' ' << y;
    }
  }
  for (double x = -1000; x <= 1000; x += 100) {
    EXPECT_GE(depth(x, -1000), 18.0) << x;
    EXPECT_LE(depth(x, -1000), 32.0) << x;
    EXPECT_GE(depth(-1000, x), 18.0) << x;
  }
  EXPECT_LT(depth(0, -280), -2.0);    // on the western breakwater
  EXPECT_LT(depth(357, -60), -2.0);   // on the eastern
  EXPECT_GT(depth(262, -262), 7.0);   // in the mouth
  EXPECT_LT(depth(230, 430), -10.0);  // on the island
}

TEST(Harbour, KeepsTheSwellOut) {
  sea::Recipe recipe;
  recipe.cascades = sea::DefaultCascades();
  recipe.depth_m = 28.0;
  recipe.timeline.resize(1);
  sea::JonswapSystem swell;
  swell.hs_m = 1.5;
  swell.tp_s = 9.0;
  swell.wave_to_rad = 0.785;  // from the south-west
  recipe.timeline[0].sea.systems = {swell};
  const auto components = sea::BuildComponents(recipe);
  ASSERT_TRUE(components.ok());
  const sea::AttenuationGrid grid =
      sea::Attenuation(**components, std::make_shared<const sea::Terrain>(Harbour()))
          .At(std::vector<double>{1.0});
  const auto hs_m = [&](double x, double y) {
    double m0 = 0.0;
    for (std::size_t c = 0; c < (*components)->cascades.size(); ++c) {
      double cascade_m2 = 0.0;
      for (const float v : (*components)->cascades[c].variance_m2[0]) cascade_m2 += v;
      const double factor = grid.At({x, y}, static_cast<int>(c));
      m0 += factor * factor * cascade_m2;
    }
    return 4.0 * std::sqrt(m0);
  };
  EXPECT_NEAR(hs_m(-800, -800), 1.5, 0.1);
  EXPECT_LT(hs_m(100, -150), 0.4);
  EXPECT_LT(hs_m(-80, 0), 0.3);
  EXPECT_GT(hs_m(300, -400), 1.0);  // before the mouth
  EXPECT_LT(hs_m(500, 750), 0.8);   // behind the island
  EXPECT_EQ(hs_m(230, 430), 0.0);
}

}  // namespace
}  // namespace onesea::ingest
