#include "server/world/spray.h"

#include <cmath>
#include <limits>

#include "common/sea/constants.h"
#include "tests/world/world_scene.h"

namespace onesea::world {
namespace {

// Drops a crate of a ton from a height and counts what flies.
struct Splash {
  double mass_kg = 0.0, momentum_n_s = 0.0;
  int events = 0;
};

class SprayTest : public WorldTest {
 protected:
  Splash Drop(double height_m, double mass_kg = 500.0) {
    const auto prepared = PrepareBody(Box({1, 1, 1}, mass_kg));
    wire::Kinematics start;
    start.position_m = {0, 0, height_m};
    EXPECT_TRUE(world_.Spawn(*prepared, start).ok());
    Splash splash;
    for (int n = 0; n < 240; ++n) {
      Run(1);
      for (const wire::Spray& spray : world_.view()->spray) {
        ++splash.events;
        splash.mass_kg += spray.mass_kg;
        splash.momentum_n_s += spray.mass_kg * Norm(spray.velocity_m_per_s);
        EXPECT_NEAR(spray.position_m.z, 0.0, 0.3);
        EXPECT_NEAR(std::hypot(spray.position_m.x, spray.position_m.y), 0.5, 0.2);
        EXPECT_GT(spray.velocity_m_per_s.z, kSlamSpeedMPerS);
        EXPECT_GT(spray.mass_kg, 0.0);
      }
    }
    return splash;
  }
};

TEST_F(SprayTest, ACrateThatFallsFromAboveSlams) {
  const Splash splash = Drop(3.0);
  EXPECT_GT(splash.events, 4);
  EXPECT_GT(splash.mass_kg, 1.0);
  // A twentieth of the water displaced at most, and little of the momentum that the crate brought.
  EXPECT_LT(splash.mass_kg, 0.05 * 1025.0);
  EXPECT_LT(splash.momentum_n_s, 0.1 * 500.0 * std::sqrt(2.0 * sea::kGravity * 2.7));
}

TEST_F(SprayTest, ACrateThatIsPutDownDoesNot) { EXPECT_EQ(Drop(0.35).events, 0); }

TEST_F(SprayTest, TheHigherTheMore) {
  const double low = Drop(1.5).mass_kg;
  ASSERT_TRUE(world_.Apply(wire::RemoveBody{1}).ok());
  EXPECT_GT(Drop(6.0).mass_kg, 1.5 * low);
}

TEST_F(SprayTest, AnExplosionThrowsWaterUpAndAWakeDoesNot) {
  AddRegion(Square(128));
  const std::uint32_t boat = Spawn(Boat(), {-20, 0});
  ASSERT_TRUE(world_.Apply(wire::DriveBody{boat, {0.3}, {0.0}}).ok());
  for (int n = 0; n < 300; ++n) {
    Run(1);
    EXPECT_TRUE(world_.view()->spray.empty()) << n;
  }
  ASSERT_TRUE(world_.Apply(wire::Explode{{10, 10, -1}, 2e8}).ok());
  ASSERT_TRUE(world_.Apply(wire::DriveBody{boat, {0.2}, {0.0}}).ok());  // in the same tick
  std::size_t events = 0;
  for (int n = 0; n < 120; ++n) {
    Run(1);
    for (const wire::Spray& spray : world_.view()->spray) {
      ++events;
      EXPECT_GT(spray.velocity_m_per_s.z, 0.0);
    }
    EXPECT_LE(world_.view()->spray.size(), static_cast<std::size_t>(kSprayMax));
  }
  EXPECT_GT(events, 3u);
}

TEST(CrestSpray, ComesFromSharpFastCrestsOnly) {
  sea::InteractionField field;
  field.cells = {.west = 0, .south = 0, .columns = 64, .rows = 64, .cell_m = 0.5};
  field.height_m.assign(64 * 64, 0.0f);
  const auto flow = std::make_shared<sea::InteractionFlow>();
  flow->x = flow->y = flow->z = field.height_m;
  field.flow = flow;
  std::vector<wire::Spray> spray;
  const std::size_t at = 20 * 64 + 30;
  flow->z[at] = 3.0f;
  AddCrestSpray(field, 0.1, spray);
  EXPECT_TRUE(spray.empty());  // fast, but flat
  field.height_m[at] = 0.2f;   // bent by 3.2 / m: 0.64
  AddCrestSpray(field, 0.1, spray);
  ASSERT_EQ(spray.size(), 1u);
  EXPECT_EQ(spray[0].position_m.x, 15.0);
  EXPECT_EQ(spray[0].position_m.y, 10.0);
  EXPECT_EQ(spray[0].velocity_m_per_s.z, 3.0);
  EXPECT_NEAR(spray[0].mass_kg, 0.02 * sea::kWaterDensityKgPerM3 * 0.25 * 3.0 * 0.1, 1e-9);
  spray.clear();
  flow->z[at] = 1.0f;  // slow
  AddCrestSpray(field, 0.1, spray);
  EXPECT_TRUE(spray.empty());
}

}  // namespace
}  // namespace onesea::world
