#include "client/model/local_world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "client/model/rope_ends.h"
#include "common/base/limits.h"
#include "common/wire/world_encoder.h"

namespace onesea::client {
namespace {

constexpr int kTickRateHz = 60;
constexpr sea::CellRect kCells = {
    .west = -32, .south = 0, .columns = 96, .rows = 64, .cell_m = 0.5};

// A server's side: a slope of water that rises, and a boat that goes east.
class FakeWorld {
 public:
  // Heights are linear in the place, so that every interpolation is exact.
  static double Height(Vec2d place, double t) { return 0.01 * place.x + 0.1 * t; }

  // As it goes over the wire: encoded and decoded.
  wire::Frame Next() {
    tick_ += 2;
    const double t = static_cast<double>(tick_) / kTickRateHz;
    for (std::int64_t j = 0; j < kCells.rows; ++j) {
      for (std::int64_t i = 0; i < kCells.columns; ++i) {
        heights_[static_cast<std::size_t>(j * kCells.columns + i)] =
            static_cast<float>(Height(kCells.PlaceOf(i + kCells.west, j + kCells.south), t));
      }
    }
    auto field = std::make_shared<sea::InteractionField>();
    field->cells = kCells;
    field->height_m = heights_;
    field->foam = std::make_shared<const std::vector<float>>(heights_);
    const sea::InteractionSnapshot snapshot{tick_, {field}};
    wire::BodyView boat;
    boat.state.id = 5;
    boat.state.position_m = {2.0 * t, 1.0, 0.0};
    boat.state.velocity_m_per_s = {2.0, 0.0, 0.0};
    boat.info = info_;
    wire::Frame frame;
    frame.world = encoder_.Encode({.tick = tick_,
                                   .interaction = &snapshot,
                                   .bodies = {&boat, 1},
                                   .water_level_m = 0.75,
                                   .spray = {},
                                   .ropes = ropes_});
    return Sent(frame);
  }
  void Tie(std::vector<wire::TiedRope> ropes) {
    ropes_ = std::make_shared<const std::vector<wire::TiedRope>>(std::move(ropes));
  }
  void Untie() { ropes_ = nullptr; }
  wire::Frame Keyframe() {
    wire::Frame frame;
    frame.keyframe = true;
    frame.world = encoder_.Keyframe();
    return Sent(frame);
  }
  SimTime time() const { return TimeOfTick(tick_, kTickRateHz); }

 private:
  static wire::Frame Sent(const wire::Frame& frame) {
    return wire::DecodeFrame(wire::EncodeFrame(frame)).value();
  }
  static std::shared_ptr<const wire::BodyInfo> Boat() {
    wire::BodyInfo info;
    info.id = 5;
    info.name = "boat";
    return std::make_shared<const wire::BodyInfo>(info);
  }

  Tick tick_ = 0;
  std::vector<float> heights_ = std::vector<float>(kCells.cells());
  std::shared_ptr<const wire::BodyInfo> info_ = Boat();
  wire::RopeList ropes_;
  wire::WorldEncoder encoder_{1.0 / kTickRateHz};
};

double HeightAt(const WorldView& view, Vec2d place, SimTime time) {
  return WakeHistory::SampleAt(view.wakes().MomentAt(time), place).height_m;
}

TEST(LocalWorld, FollowsFramesFromAKeyframeOn) {
  FakeWorld server;
  LocalWorld world;
  server.Next();
  EXPECT_FALSE(world.current());
  ASSERT_TRUE(world.Apply(server.Keyframe(), kTickRateHz).ok());
  for (int n = 0; n < 10; ++n) {
    ASSERT_TRUE(world.Apply(server.Next(), kTickRateHz).ok());
    const auto view = world.view();
    const double t = server.time().Seconds();
    for (const Vec2d place : {Vec2d{0.0, 1.0}, Vec2d{3.26, 7.31}, Vec2d{-9.9, 20.0}}) {
      EXPECT_NEAR(HeightAt(*view, place, server.time()), FakeWorld::Height(place, t), 1.6e-3);
    }
    const wire::BodyTable::Body* boat = view->FindBody(5);
    ASSERT_NE(boat, nullptr);
    EXPECT_EQ(boat->info->name, "boat");
    EXPECT_NEAR(boat->At(server.time()).position_m.x, 2.0 * t, 6e-3);
  }
  EXPECT_TRUE(world.current());
  EXPECT_EQ(world.view()->water_level_m(), 0.75);
}

TEST(LocalWorld, HeightsAreSmoothBetweenFramesAndZeroOutside) {
  FakeWorld server;
  LocalWorld world;
  server.Next();
  ASSERT_TRUE(world.Apply(server.Keyframe(), kTickRateHz).ok());
  const SimTime first = server.time();
  ASSERT_TRUE(world.Apply(server.Next(), kTickRateHz).ok());
  const SimTime second = server.time();
  const auto view = world.view();
  const Vec2d place{4.0, 4.0};
  const double a = HeightAt(*view, place, first), b = HeightAt(*view, place, second);
  EXPECT_GT(b, a);
  const SimTime middle{(first.flicks + second.flicks) / 2};
  EXPECT_NEAR(HeightAt(*view, place, middle), 0.5 * (a + b), 1e-9);
  EXPECT_EQ(HeightAt(*view, {-18.0, 4.0}, second), 0.0);
  EXPECT_EQ(HeightAt(*view, {1e300, -1e300}, second), 0.0);
  EXPECT_GT(WakeHistory::SampleAt(view->wakes().MomentAt(second), {20.0, 10.0}).foam, 0.0);
}

// After the last update the layer stands, then fades; before the first nothing is known.
TEST(LocalWorld, HeightsFadeWhenNoNewsCome) {
  FakeWorld server;
  LocalWorld world;
  EXPECT_FALSE(world.view()->wakes().MomentAt({}));
  server.Next();
  ASSERT_TRUE(world.Apply(server.Keyframe(), kTickRateHz).ok());
  const auto view = world.view();
  const Vec2d place{4.0, 4.0};
  const double height_m = HeightAt(*view, place, server.time());
  const auto later = [&](double seconds) { return server.time() + SimTime::FromSeconds(seconds); };
  ASSERT_GT(height_m, 0.01);
  EXPECT_EQ(HeightAt(*view, place, later(0.99 * WakeHistory::kStandsS)), height_m);
  EXPECT_NEAR(HeightAt(*view, place, later(1.75 * WakeHistory::kStandsS)), 0.25 * height_m, 1e-9);
  EXPECT_TRUE(view->wakes().MomentAt(later(1.99 * WakeHistory::kStandsS)));
  EXPECT_FALSE(view->wakes().MomentAt(later(2.0 * WakeHistory::kStandsS)));
  EXPECT_FALSE(view->wakes().MomentAt(later(-0.001)));
  EXPECT_EQ(HeightAt(*view, place, later(-0.001)), 0.0);
}

// Heights rise by 0.1 m/s: whoever keeps a while knows each moment of it.
TEST(LocalWorld, KeepsThePastThatItIsToldToKeep) {
  FakeWorld server;
  LocalWorld forgetful, keeper(SimTime::FromSeconds(0.5));
  server.Next();
  const wire::Frame start = server.Keyframe();
  ASSERT_TRUE(forgetful.Apply(start, kTickRateHz).ok());
  ASSERT_TRUE(keeper.Apply(start, kTickRateHz).ok());
  for (int n = 0; n < 30; ++n) {
    const wire::Frame frame = server.Next();
    ASSERT_TRUE(forgetful.Apply(frame, kTickRateHz).ok());
    ASSERT_TRUE(keeper.Apply(frame, kTickRateHz).ok());
  }
  const Vec2d place{3.0, 7.0};
  const auto earlier = [&](double seconds) {
    return server.time() - SimTime::FromSeconds(seconds);
  };
  for (const double age_s : {0.0, 0.02, 0.25, 0.5}) {
    EXPECT_NEAR(HeightAt(*keeper.view(), place, earlier(age_s)),
                FakeWorld::Height(place, earlier(age_s).Seconds()), 1e-3 * 25.0 / 16.0)
        << age_s;
  }
  EXPECT_FALSE(keeper.view()->wakes().MomentAt(earlier(0.6)));
  EXPECT_TRUE(forgetful.view()->wakes().MomentAt(earlier(0.02)));
  EXPECT_FALSE(forgetful.view()->wakes().MomentAt(earlier(0.04)));
  // One region in steps of a millimetre.
  EXPECT_EQ(keeper.view()->wakes().MomentAt(server.time()).height_error_m, 1e-3 * 25.0 / 16.0);
  ASSERT_TRUE(keeper.Apply(server.Keyframe(), kTickRateHz).ok());
  EXPECT_FALSE(keeper.view()->wakes().MomentAt(earlier(0.01)));
}

TEST(LocalWorld, AViewStaysAsItWas) {
  FakeWorld server;
  LocalWorld world;
  server.Next();
  ASSERT_TRUE(world.Apply(server.Keyframe(), kTickRateHz).ok());
  const auto view = world.view();
  const double before = HeightAt(*view, {1.0, 1.0}, view->time());
  for (int n = 0; n < 5; ++n) ASSERT_TRUE(world.Apply(server.Next(), kTickRateHz).ok());
  EXPECT_EQ(HeightAt(*view, {1.0, 1.0}, view->time()), before);
  EXPECT_GT(HeightAt(*world.view(), {1.0, 1.0}, server.time()), before);
}

// Frames were lost: the stream's next frame is a keyframe, and then two worlds are one again.
TEST(LocalWorld, AKeyframeHealsALoss) {
  FakeWorld server;
  LocalWorld faithful, late;
  server.Next();
  const wire::Frame start = server.Keyframe();
  ASSERT_TRUE(faithful.Apply(start, kTickRateHz).ok());
  ASSERT_TRUE(late.Apply(start, kTickRateHz).ok());
  for (int n = 0; n < 7; ++n) ASSERT_TRUE(faithful.Apply(server.Next(), kTickRateHz).ok());
  ASSERT_TRUE(late.Apply(server.Keyframe(), kTickRateHz).ok());
  for (int n = 0; n < 5; ++n) {
    const wire::Frame frame = server.Next();
    ASSERT_TRUE(faithful.Apply(frame, kTickRateHz).ok());
    ASSERT_TRUE(late.Apply(frame, kTickRateHz).ok());
    EXPECT_EQ(late.view()->interaction().fields[0]->height_m,
              faithful.view()->interaction().fields[0]->height_m);
    EXPECT_EQ(late.view()->FindBody(5)->newest.position_m,
              faithful.view()->FindBody(5)->newest.position_m);
  }
}

TEST(LocalWorld, AFrameThatDoesNotFitKeepsTheViewAndAsksForAKeyframe) {
  FakeWorld server;
  LocalWorld world;
  EXPECT_EQ(world.Apply(server.Next(), kTickRateHz).code(), absl::StatusCode::kFailedPrecondition);
  ASSERT_TRUE(world.Apply(server.Keyframe(), kTickRateHz).ok());
  wire::Frame broken = server.Next();
  broken.world->tiles.blobs = {"rubbish"};
  const auto view = world.view();
  EXPECT_EQ(world.Apply(broken, kTickRateHz).code(), absl::StatusCode::kInvalidArgument);
  EXPECT_FALSE(world.current());
  EXPECT_EQ(world.view(), view);
  EXPECT_EQ(world.Apply(server.Next(), kTickRateHz).code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_TRUE(world.Apply(server.Keyframe(), kTickRateHz).ok());
  EXPECT_TRUE(world.current());
  wire::Frame past = server.Next();
  past.world->tick = -100;
  EXPECT_FALSE(world.Apply(past, kTickRateHz).ok());
}

// What a server sends that has no world: stamps, and keyframes without one.
TEST(LocalWorld, AKeyframeWithoutAWorldEmptiesIt) {
  FakeWorld server;
  LocalWorld world;
  server.Next();
  ASSERT_TRUE(world.Apply(server.Keyframe(), kTickRateHz).ok());
  wire::Frame stamp;
  ASSERT_TRUE(world.Apply(stamp, kTickRateHz).ok());
  EXPECT_EQ(world.view()->interaction().fields.size(), 1U);
  stamp.keyframe = true;
  ASSERT_TRUE(world.Apply(stamp, kTickRateHz).ok());
  EXPECT_TRUE(world.view()->interaction().fields.empty());
  EXPECT_TRUE(world.view()->bodies().empty());
  EXPECT_EQ(world.view()->water_level_m(), 0.0);
}

TEST(LocalWorld, SprayIsTakenOnceAndBounded) {
  FakeWorld server;
  LocalWorld world;
  server.Next();
  ASSERT_TRUE(world.Apply(server.Keyframe(), kTickRateHz).ok());
  for (int n = 0; n < 3; ++n) {
    wire::Frame frame = server.Next();
    frame.world->spray.assign(200, {{static_cast<double>(n), 0.0, 0.0}, {}, 1.0});
    ASSERT_TRUE(world.Apply(frame, kTickRateHz).ok());
  }
  const std::vector<wire::Spray> spray = world.TakeSpray();
  ASSERT_EQ(spray.size(), static_cast<std::size_t>(kSprayMax));
  EXPECT_EQ(spray.front().position_m.x, 1.0);
  EXPECT_EQ(spray.back().position_m.x, 2.0);
  EXPECT_TRUE(world.TakeSpray().empty());
}

TEST(LocalWorld, RopesComeGoAndOutliveKeyframes) {
  FakeWorld server;
  LocalWorld world;
  const auto ids = [&] {
    std::vector<std::uint32_t> ids;
    for (const wire::TiedRope& rope : world.view()->ropes()) ids.push_back(rope.id);
    return ids;
  };
  const auto apply = [&](const wire::Frame& frame) {
    ASSERT_TRUE(world.Apply(frame, kTickRateHz).ok());
  };
  server.Next();
  apply(server.Keyframe());
  EXPECT_TRUE(ids().empty());
  server.Tie({{3, {{5, {}}, {0, {}}}}, {8, {{5, {}}, {77, {}}}}});
  apply(server.Next());
  apply(server.Next());  // which doesn't say it again
  EXPECT_THAT(ids(), testing::ElementsAre(3, 8));
  LocalWorld joiner;
  ASSERT_TRUE(joiner.Apply(server.Keyframe(), kTickRateHz).ok());
  EXPECT_EQ(joiner.view()->ropes().size(), 2U);
  server.Untie();
  apply(server.Next());
  EXPECT_TRUE(ids().empty());
  server.Tie({{9, {{5, {}}, {0, {}}}}});
  apply(server.Next());
  EXPECT_THAT(ids(), testing::ElementsAre(9));
  server.Untie();
  server.Next();  // lost
  apply(server.Keyframe());
  EXPECT_TRUE(ids().empty());
}

// The end on the boat goes with the boat as it is drawn, in or between frames, turned and all; one
// on a body that never came draws nothing.
TEST(RopesAt, EndsFollowTheBodiesThatAreDrawn) {
  FakeWorld server;
  LocalWorld world;
  server.Next();
  ASSERT_TRUE(world.Apply(server.Keyframe(), kTickRateHz).ok());
  server.Tie({{3, {{5, {-3.0, 0.0, 0.5}}, {0, {10.0, 20.0, 1.0}}, 15.0}},
              {8, {{5, {}}, {77, {}}}},
              {9, {{78, {}}, {5, {}}}}});
  ASSERT_TRUE(world.Apply(server.Next(), kTickRateHz).ok());
  const auto view = world.view();
  const SimTime later = server.time() + SimTime::FromSeconds(0.5);
  const std::vector<RopeNow> ropes = RopesAt(*view, later);
  ASSERT_EQ(ropes.size(), 1U);
  EXPECT_EQ(ropes[0].id, 3U);
  EXPECT_EQ(ropes[0].length_m, 15.0);
  EXPECT_EQ(ropes[0].to_m, (Vec3d{10.0, 20.0, 1.0}));
  const double x_m = 2.0 * later.Seconds();  // the boat's
  EXPECT_NEAR(ropes[0].from_m.x, x_m - 3.0, 2e-3);
  EXPECT_NEAR(ropes[0].from_m.y, 1.0, 2e-3);
  EXPECT_NEAR(ropes[0].from_m.z, 0.5, 2e-3);
  // The own boat is drawn as predicted: elsewhere and a quarter turn to port.
  wire::BodyState own;
  own.id = 5;
  own.position_m = {100.0, 50.0, 0.25};
  own.turn = TurnBy({0.0, 0.0, std::acos(0.0)});
  const RopeNow rope = RopesAt(*view, later, own).front();
  EXPECT_NEAR(rope.from_m.x, 100.0, 1e-9);
  EXPECT_NEAR(rope.from_m.y, 47.0, 1e-9);
  EXPECT_NEAR(rope.from_m.z, 0.75, 1e-9);
}

}  // namespace
}  // namespace onesea::client
