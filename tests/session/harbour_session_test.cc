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

// Six real hulls that float with some draft and some freeboard and obey the helm; the moored one
// stays on its lines.
TEST(HarbourSession, ItsBoatsAreHullsThatDrive) {
  absl::StatusOr<SessionSpec> spec = wire::ReadSessionFile("deploy/sessions/harbour.textproto");
  ASSERT_TRUE(spec.ok()) << spec.status();
  spec->world.regions.clear();
  auto world = MakeWorld(*spec, sea::TransformKind::kOwn);
  ASSERT_TRUE(world.ok()) << world.status();
  const auto components = sea::BuildComponents(spec->recipe);
  ASSERT_TRUE(components.ok()) << components.status();
  const std::shared_ptr<const sea::Terrain> terrain = (*world)->terrain();
  Session session(*spec, sea::OverTerrain(*components, terrain), *std::move(world));
  const auto run = [&](int seconds) {
    for (int n = 0; n < seconds * spec->recipe.tick_rate_hz; ++n) session.Step();
    return session.world().view();
  };
  const auto start = run(5);
  ASSERT_NE(start->ropes, nullptr);
  EXPECT_EQ(start->ropes->size(), spec->world.ropes.size());
  std::vector<std::uint32_t> boats;
  for (const wire::BodyView& body : start->bodies) {
    if (body.info->name.find("boat") == std::string::npos) continue;
    EXPECT_EQ(body.info->shape.kind, wire::ShapeKind::kMesh) << body.info->name;
    // Keel below the water, deck above: its origin is on the keel, the hulls are 0.9 m and more.
    const double keel_m =
        (body.state.position_m - Rotate(body.state.turn, body.info->centre_of_mass_m)).z;
    EXPECT_LT(keel_m, -0.1 + 0.4) << body.info->name;
    EXPECT_GT(keel_m, -1.0 - 0.4) << body.info->name;
    boats.push_back(body.info->id);
    ASSERT_TRUE(session.world().Apply(wire::DriveBody{body.info->id, {0.4}, {0.0}}).ok());
  }
  ASSERT_EQ(boats.size(), 6u);
  const auto end = run(10);
  for (const std::uint32_t id : boats) {
    const wire::BodyState &from = start->bodies[id - 1].state, &to = end->bodies[id - 1].state;
    const Vec3d way = to.position_m - from.position_m;
    const double ahead_m = Dot(way, Rotate(from.turn, {1.0, 0.0, 0.0}));
    EXPECT_GT(Upright(to.turn), 0.9) << id;
    if (id == 4) {
      EXPECT_LT(Norm(way), 6.0);  // moored
    } else {
      EXPECT_GT(ahead_m, 4.0) << id;  // 9 t take their time
      EXPECT_GT(ahead_m, 0.9 * Norm(way)) << id;
    }
  }
}

}  // namespace
}  // namespace onesea::server
