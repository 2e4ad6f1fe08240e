// Bodies and water give each other what they take.
#include <algorithm>
#include <cmath>

#include "common/sea/constants.h"
#include "tests/world/world_scene.h"

namespace onesea::world {
namespace {

constexpr double kRhoG = sea::kWaterDensityKgPerM3 * sea::kGravity;

// Water that a hull presses away is found around it, all of it.
TEST(WorldCoupling, WaterThatMakesRoomIsFoundAround) {
  InteractionLayer layer({.depth_m = 4.0, .edge_cells = 0});
  const std::vector<RegionAsk> asks{{.id = 1, .columns = 128, .rows = 128, .centre_m = {}}};
  ASSERT_TRUE(layer.Place(asks).ok());
  const double volume_m3 = 6.0;
  for (int n = 0; n < 600; ++n) {
    const double share = std::min(1.0, n / 300.0);
    EXPECT_TRUE(layer.AddPressure({3, -2}, 3.0, share * volume_m3 * kRhoG));
    layer.Step();
    if (n % 50 != 49) continue;
    double sum = 0.0, under = 0.0;
    const auto snapshot = layer.Snapshot(n, false);
    for (const float height : snapshot->fields[0]->height_m) sum += 0.25 * height;
    for (double x = -0.5; x <= 6.5; x += 0.5) {
      for (double y = -5.5; y <= 1.5; y += 0.5) {
        under -= 0.25 * sea::SampleInteraction(*snapshot, {x, y}).height_m;
      }
    }
    EXPECT_NEAR(sum, 0.0, 1e-3) << n;
    if (n < 350) continue;
    EXPECT_NEAR(under, volume_m3, 0.25 * volume_m3) << n;
  }
}

}  // namespace
}  // namespace onesea::world
