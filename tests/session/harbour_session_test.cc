// The session of `deploy/run harbour`: whatever floats there goes on floating, upright, in place.
#include <gtest/gtest.h>

#include <cmath>

#include "common/sea/attenuation.h"
#include "common/wire/session_file.h"
#include "server/session/session.h"

namespace onesea::server {
namespace {

constexpr int kSeconds = 15;

// Of the body's z axis in the world.
double Upright(const Quaternion& turn) { return 1.0 - 2.0 * (turn.x * turn.x + turn.y * turn.y); }

TEST(HarbourSession, NothingSinksCapsizesOrRunsOff) {
  const absl::StatusOr<SessionSpec> spec =
      wire::ReadSessionFile("deploy/sessions/harbour.textproto");
  ASSERT_TRUE(spec.ok()) << spec.status();
  auto world = MakeWorld(*spec, sea::TransformKind::kOwn);
  ASSERT_TRUE(world.ok()) << world.status();
  const std::shared_ptr<const sea::Terrain> terrain = (*world)->terrain();
  ASSERT_NE(terrain, nullptr);
  const auto components = sea::BuildComponents(spec->recipe);
  ASSERT_TRUE(components.ok()) << components.status();
  Session session(*spec, sea::OverTerrain(*components, terrain), *std::move(world));
  const std::vector<wire::BodyView> start = session.world().view()->bodies;
  ASSERT_GE(start.size(), 12u);
  for (int n = 0; n < kSeconds * spec->recipe.tick_rate_hz; ++n) session.Step();
  // Every region that was asked for lies in water.
  EXPECT_EQ(session.world().view()->interaction->fields.size(), spec->world.regions.size());
  const std::vector<wire::BodyView>& end = session.world().view()->bodies;
  ASSERT_EQ(end.size(), start.size());
  for (std::size_t n = 0; n < end.size(); ++n) {
    const Vec3d from = start[n].state.position_m, to = end[n].state.position_m;
    const std::string& name = end[n].info->name;
    EXPECT_LT(std::hypot(to.x - from.x, to.y - from.y), 5.0) << name;
    EXPECT_NEAR(to.z, from.z, 0.7) << name;
    EXPECT_GT(Upright(end[n].state.turn), 0.9) << name;
    EXPECT_LT(terrain->ElevationAt({to.x, to.y}), -1.0) << name;
  }
}

}  // namespace
}  // namespace onesea::server
