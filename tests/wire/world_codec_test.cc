// Bodies, regions and commands there and back; every number has a limit and NaN is none of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/wire/frame.h"
#include "common/wire/proto_body.h"
#include "common/wire/proto_session.h"
#include "common/wire/proto_world.h"
#include "common/wire/session_file.h"
#include "tests/wire/world_examples.h"

namespace onesea::wire {
namespace {

using ::testing::HasSubstr;

const CommandHeader kHeader = {"tank", "request-1", 77, "lease-9"};

// Through the bytes of a request and back.
template <typename Request, typename What>
absl::StatusOr<HeadedCommand> Through(const What& what, const CommandHeader& header = kHeader) {
  Request request;
  ToProto(header, request.mutable_command());
  ToProto(what, &request);
  Request parsed;
  EXPECT_TRUE(parsed.ParseFromString(request.SerializeAsString()));
  return FromProto(parsed);
}

TEST(WorldCodec, AFrameKeepsItsWorld) {
  Frame frame;
  frame.sequence = 5;
  frame.world = FullUpdate();
  const auto decoded = DecodeFrame(EncodeFrame(frame));
  ASSERT_TRUE(decoded.ok()) << decoded.status();
  ASSERT_TRUE(decoded->world.has_value());
  const WorldUpdate &got = *decoded->world, want = FullUpdate();
  EXPECT_EQ(got.tick, want.tick);
  EXPECT_EQ(got.tiles.layout, want.tiles.layout);
  EXPECT_EQ(got.tiles.blobs, want.tiles.blobs);
  EXPECT_EQ(got.bodies.removed_ids, want.bodies.removed_ids);
  ASSERT_EQ(got.bodies.infos.size(), 1U);
  EXPECT_EQ(*got.bodies.infos[0], *want.bodies.infos[0]);
  EXPECT_EQ(got.bodies.states, want.bodies.states);
  EXPECT_EQ(got.water_level_m, want.water_level_m);
  EXPECT_EQ(got.spray, want.spray);
  ASSERT_NE(got.ropes, nullptr);
  EXPECT_EQ(*got.ropes, *want.ropes);
}

TEST(WorldCodec, RopesOfAFrameAreBoundedAndInOrder) {
  const auto refusal = [](std::vector<TiedRope> ropes) {
    Frame frame;
    frame.world.emplace();
    frame.world->ropes = std::make_shared<const std::vector<TiedRope>>(std::move(ropes));
    return std::string(DecodeFrame(EncodeFrame(frame)).status().message());
  };
  const TiedRope good = {7, {{1, {}}, {0, {5.0, 0.0, 0.0}}}};
  EXPECT_EQ(refusal({good}), "");
  EXPECT_THAT(refusal({good, good}), HasSubstr("world.ropes[1].id: 7 is not above 7"));
  TiedRope bad = good;
  bad.id = 0;
  EXPECT_THAT(refusal({bad}), HasSubstr("world.ropes[0].id: 0"));
  bad = good;
  bad.spec.to.point_m.y = std::nan("");
  EXPECT_THAT(refusal({bad}), HasSubstr("world.ropes[0].rope.to.point_m.y: nan"));
  bad = good;
  bad.spec.length_m = 2e4;
  EXPECT_THAT(refusal({bad}), HasSubstr("world.ropes[0].rope.length_m: 20000"));
  bad = good;
  bad.spec.from.body_id = 0;
  EXPECT_THAT(refusal({bad}), HasSubstr("both ends are in the world"));
  std::vector<TiedRope> many(kRopesMax + 1, good);
  for (std::size_t n = 0; n < many.size(); ++n) many[n].id = static_cast<std::uint32_t>(n + 1);
  EXPECT_THAT(refusal(many), HasSubstr("world.ropes: 1025"));
  many.pop_back();
  EXPECT_EQ(refusal(many), "");
}

// A joiner needs them to know every height at every time.
TEST(WorldCodec, AWelcomeKeepsTerrainAndTide) {
  Frame frame;
  frame.welcome.emplace();
  frame.welcome->recipe.cascades = sea::DefaultCascades();
  frame.welcome->recipe.timeline.resize(1);
  frame.welcome->recipe.timeline[0].sea.systems = {sea::JonswapSystem{}};
  frame.welcome->session.name = "harbour";
  frame.welcome->session.terrain_hash = 0xfedcba9876543210ULL;
  frame.welcome->water_level = {{-60.0, 0.5}, {3600.0, -1.25}};
  const auto decoded = DecodeFrame(EncodeFrame(frame));
  ASSERT_TRUE(decoded.ok()) << decoded.status();
  EXPECT_EQ(decoded->welcome->session.terrain_hash, 0xfedcba9876543210ULL);
  EXPECT_EQ(decoded->welcome->water_level, frame.welcome->water_level);
  frame.welcome->water_level[1].level_m = std::nan("");
  EXPECT_THAT(DecodeFrame(EncodeFrame(frame)).status().message(), HasSubstr("level_m"));
  frame.welcome->water_level = {{1.0, 0.0}, {1.0, 0.0}};
  EXPECT_THAT(DecodeFrame(EncodeFrame(frame)).status().message(), HasSubstr("time_s"));
}

TEST(WaterLevel, IsLinearBetweenEntriesAndConstantOutside) {
  const std::vector<WaterLevel> tide = {{-10.0, 1.0}, {30.0, -1.0}, {40.0, 0.0}};
  const auto at = [&](double time_s) { return WaterLevelAt(tide, SimTime::FromSeconds(time_s)); };
  EXPECT_EQ(at(-1e6), 1.0);
  EXPECT_EQ(at(-10.0), 1.0);
  EXPECT_DOUBLE_EQ(at(10.0), 0.0);
  EXPECT_DOUBLE_EQ(at(35.0), -0.5);
  EXPECT_EQ(at(40.0), 0.0);
  EXPECT_EQ(at(1e9), 0.0);
  EXPECT_EQ(WaterLevelAt({}, SimTime{}), 0.0);
}

TEST(WorldCodec, AWorldThatChangedNothingHasNoRegions) {
  Frame frame;
  frame.world.emplace();
  const auto decoded = DecodeFrame(EncodeFrame(frame));
  ASSERT_TRUE(decoded.ok());
  EXPECT_FALSE(decoded->world->tiles.layout.has_value());
  EXPECT_FALSE(decoded->world->water_level_m.has_value());
  EXPECT_EQ(decoded->world->ropes, nullptr);
  // An empty list of regions is something else: they have vanished.
  frame.world->tiles.layout.emplace();
  EXPECT_TRUE(DecodeFrame(EncodeFrame(frame))->world->tiles.layout.has_value());
  // So is an empty list of ropes.
  frame.world->ropes = std::make_shared<const std::vector<TiedRope>>();
  const auto untied = DecodeFrame(EncodeFrame(frame));
  ASSERT_NE(untied->world->ropes, nullptr);
  EXPECT_TRUE(untied->world->ropes->empty());
}

TEST(WorldCodec, BodiesKeepEveryField) {
  const BodyDescription body = FullBody();
  v1::BodyDescription proto;
  ToProto(body, &proto);
  const auto got = FromProto(proto, "");
  ASSERT_TRUE(got.ok()) << got.status();
  EXPECT_EQ(*got, body);
  EXPECT_TRUE(ValidateBodyDescription("", *got).ok()) << ValidateBodyDescription("", *got);
  for (const ShapeKind kind :
       {ShapeKind::kBox, ShapeKind::kSphere, ShapeKind::kCylinder, ShapeKind::kCapsule}) {
    BodyDescription round;
    round.shape = BodyShape{.kind = kind};
    if (kind != ShapeKind::kBox) round.shape->radius_m = 0.7;
    v1::BodyDescription shaped;
    ToProto(round, &shaped);
    EXPECT_EQ(*FromProto(shaped, ""), round);
  }
}

TEST(WorldCodec, WhatABodyLeavesOutIsTheDefault) {
  v1::BodyDescription proto;
  proto.mutable_shape()->mutable_sphere()->set_radius_m(0.5);
  proto.set_mass_kg(1.0);
  proto.add_thrusters();
  proto.add_rudders();
  BodyDescription expected;
  expected.shape = BodyShape{.kind = ShapeKind::kSphere};
  expected.mass_kg = 1.0;
  expected.thrusters.resize(1);
  expected.rudders.resize(1);
  EXPECT_EQ(*FromProto(proto, ""), expected);
  proto.mutable_shape()->Clear();
  EXPECT_THAT(std::string(FromProto(proto, "").status().message()), HasSubstr("shape: is none of"));
  proto.mutable_shape()->mutable_mesh()->set_path("/etc/passwd");
  EXPECT_THAT(std::string(FromProto(proto, "").status().message()),
              HasSubstr("only session files may name files"));
}

TEST(WorldCodec, APresetAloneIsEnough) {
  v1::BodyDescription proto;
  proto.set_preset("crate");
  const BodyDescription named = *FromProto(proto, "");
  BodyDescription expected;
  expected.preset = "crate";
  EXPECT_EQ(named, expected);
  EXPECT_TRUE(ValidateBodyDescription("", named).ok());
  // And comes back alone: a default is not something that was said.
  v1::BodyDescription again;
  ToProto(named, &again);
  EXPECT_EQ(again.SerializeAsString(), proto.SerializeAsString());
}

TEST(WorldCodec, WhatIsGivenReplacesThePresets) {
  BodyDescription base = FullBody();
  base.preset.clear();
  BodyDescription given;
  given.preset = "whatever";
  EXPECT_EQ(Overlaid(base, given), base);
  given.name = "mine";
  given.mass_kg = 2.0;
  given.drag = Drag{};
  given.thrusters.resize(1);
  BodyDescription expected = base;
  expected.name = "mine";
  expected.mass_kg = 2.0;
  expected.drag = Drag{};
  expected.thrusters = {Thruster{}};
  EXPECT_EQ(Overlaid(base, given), expected);
  EXPECT_EQ(Overlaid(BodyDescription{}, base), base);  // no field is forgotten
}

TEST(WorldCodec, CommandsKeepTheirFieldsAndHeader) {
  const auto spawn = Through<v1::SpawnBodyRequest>(SpawnBody{FullBody(), FullKinematics()});
  ASSERT_TRUE(spawn.ok()) << spawn.status();
  EXPECT_EQ(spawn->header.session, "tank");
  EXPECT_EQ(spawn->header.request_id, "request-1");
  EXPECT_EQ(spawn->header.tick, 77);
  EXPECT_EQ(spawn->header.lease, "lease-9");
  EXPECT_EQ(std::get<SpawnBody>(spawn->command).body, FullBody());
  const Kinematics start = std::get<SpawnBody>(spawn->command).start;
  EXPECT_EQ(start.position_m, FullKinematics().position_m);
  EXPECT_LT(AngleBetween(start.turn, FullKinematics().turn), 1e-12);
  const auto drive = Through<v1::DriveBodyRequest>(DriveBody{4, {1.0, -0.5}, {0.25}});
  EXPECT_EQ(std::get<DriveBody>(drive->command).throttle, (std::vector<double>{1.0, -0.5}));
  EXPECT_EQ(std::get<DriveBody>(drive->command).rudder, std::vector<double>{0.25});
  const auto impulse =
      Through<v1::ApplyImpulseRequest>(ApplyImpulse{4, {1.0, 2.0, 3.0}, Vec3d{4.0, 5.0, 6.0}});
  EXPECT_EQ(std::get<ApplyImpulse>(impulse->command).position_m, (Vec3d{4.0, 5.0, 6.0}));
  const auto central = Through<v1::ApplyImpulseRequest>(ApplyImpulse{4, {}, std::nullopt});
  EXPECT_FALSE(std::get<ApplyImpulse>(central->command).position_m.has_value());
  const auto bang = Through<v1::ExplodeRequest>(Explode{{1.0, 2.0, -3.0}, 4.2e6});
  EXPECT_EQ(std::get<Explode>(bang->command).energy_j, 4.2e6);
  const auto region = Through<v1::AddRegionRequest>(AddRegion{FullRegion()});
  EXPECT_EQ(std::get<AddRegion>(region->command).region, FullRegion());
  const RopeSpec tow{{3, {-3.0, 0.0, 0.5}}, {4, {2.0, 0.0, 0.25}}, 12.0, 2e4, 50.0};
  const auto rope = Through<v1::AddRopeRequest>(AddRope{tow});
  EXPECT_EQ(std::get<AddRope>(rope->command).rope, tow);
  EXPECT_EQ(std::get<RemoveRope>(Through<v1::RemoveRopeRequest>(RemoveRope{9})->command).rope_id,
            9U);
  const auto lease = Through<v1::TakeLeaseRequest>(TakeLease{4, "robot", 5.0});
  EXPECT_EQ(std::get<TakeLease>(lease->command).holder, "robot");
  const auto wall = Through<v1::SetObstacleRequest>(SetObstacle{2, {{0, 0}, {1, 0}, {0, 1}}});
  EXPECT_EQ(std::get<SetObstacle>(wall->command).corners_m.size(), 3U);
  EXPECT_TRUE(Through<v1::RemoveBodyRequest>(RemoveBody{4}).ok());
  EXPECT_TRUE(Through<v1::RemoveObstacleRequest>(RemoveObstacle{4}).ok());
  EXPECT_TRUE(Through<v1::RemoveRegionRequest>(RemoveRegion{4}).ok());
  EXPECT_TRUE(Through<v1::ReleaseLeaseRequest>(ReleaseLease{4}).ok());
}

TEST(WorldCodec, CommandsOutOfTheirLimitsAreRefused) {
  const double nan = std::nan("");
  const auto refused = [](const absl::StatusOr<HeadedCommand>& command, const std::string& words) {
    EXPECT_EQ(command.status().code(), absl::StatusCode::kInvalidArgument);
    EXPECT_THAT(std::string(command.status().message()), HasSubstr(words));
  };
  const RemoveBody remove{4};
  refused(Through<v1::RemoveBodyRequest>(remove, {"tank", "", {}, ""}), "request_id: is empty");
  refused(Through<v1::RemoveBodyRequest>(remove, {"tank", std::string(65, 'x'), {}, ""}),
          "command.request_id: 65");
  refused(Through<v1::RemoveBodyRequest>(remove, {"tank", "a", kTickMax + 1, ""}), "command.tick");
  refused(Through<v1::RemoveBodyRequest>(RemoveBody{}), "body_id: is missing");
  refused(Through<v1::DriveBodyRequest>(DriveBody{1, {nan}, {}}), "throttle: nan");
  refused(Through<v1::DriveBodyRequest>(DriveBody{1, {}, {1.01}}), "rudder: 1.01");
  refused(Through<v1::DriveBodyRequest>(DriveBody{1, std::vector<double>(9), {}}),
          "throttle: 9 elements");
  refused(Through<v1::ApplyImpulseRequest>(ApplyImpulse{1, {0.0, nan, 0.0}, {}}),
          "impulse_n_s.y: nan");
  refused(Through<v1::ExplodeRequest>(Explode{{0.0, 0.0, 0.1}, 1.0}), "position_m.z: 0.1");
  refused(Through<v1::ExplodeRequest>(Explode{{}, 0.0}), "energy_j: 0");
  refused(Through<v1::ExplodeRequest>(Explode{{}, nan}), "energy_j: nan");
  refused(Through<v1::TakeLeaseRequest>(TakeLease{1, "", nan}), "duration_s: nan");
  RegionSpec region = FullRegion();
  region.columns = 100;
  refused(Through<v1::AddRegionRequest>(AddRegion{region}), "region.columns: 100");
  region = FullRegion();
  region.cell_m = nan;
  refused(Through<v1::AddRegionRequest>(AddRegion{region}), "region.cell_m: nan");
  region = FullRegion();
  region.rest_after_s = 3601.0;
  refused(Through<v1::AddRegionRequest>(AddRegion{region}), "region.rest_after_s: 3601");
  RopeSpec rope{{1, {}}, {0, {}}};
  rope.length_m = nan;
  refused(Through<v1::AddRopeRequest>(AddRope{rope}), "rope.length_m: nan");
  rope = {{1, {}}, {1, {}}};
  refused(Through<v1::AddRopeRequest>(AddRope{rope}), "rope.to.body_id: 1: both ends");
  rope = {{}, {}};
  refused(Through<v1::AddRopeRequest>(AddRope{rope}), "both ends are in the world");
  rope = {{1, {}}, {0, {1e8, 0.0, 0.0}}};
  refused(Through<v1::AddRopeRequest>(AddRope{rope}), "rope.to.point_m.x: 1");
  refused(Through<v1::RemoveRopeRequest>(RemoveRope{}), "rope_id: is missing");
  SpawnBody spawn{FullBody(), FullKinematics()};
  spawn.start.turn.w = nan;
  refused(Through<v1::SpawnBodyRequest>(spawn), "start.turn squared: nan");
  spawn = {FullBody(), FullKinematics()};
  spawn.start.velocity_m_per_s.z = 1e9;
  refused(Through<v1::SpawnBodyRequest>(spawn), "start.velocity_m_per_s.z");
  spawn = {FullBody(), FullKinematics()};
  spawn.body.shape->mesh.clear();
  refused(Through<v1::SpawnBodyRequest>(spawn), "body.shape.mesh.file: is empty");
}

TEST(WorldCodec, ObstaclesAreSimplePolygons) {
  const auto check = [](std::vector<Vec2d> corners) {
    return std::string(ValidateCommand(kHeader, SetObstacle{0, std::move(corners)}).message());
  };
  EXPECT_EQ(check({{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}}), "");
  EXPECT_EQ(check({{0, 4}, {2, 1}, {4, 4}, {4, 0}, {0, 0}}), "");  // clockwise too
  EXPECT_THAT(check({{0, 0}, {4, 4}, {4, 0}, {0, 3}}), HasSubstr("sides 0 and 2 cross"));
  EXPECT_THAT(check({{0, 0}, {1, 1}}), HasSubstr("corners: 2"));
  EXPECT_THAT(check({{0, 0}, {1, 1}, {2, 2}}), HasSubstr("no area"));
  EXPECT_THAT(check({{0, 0}, {std::nan(""), 1}, {2, 2}}), HasSubstr("nan"));
  EXPECT_THAT(check(std::vector<Vec2d>(65)), HasSubstr("corners: 65"));
}

TEST(WorldCodec, PosesAndInstrumentsGoThereAndBack) {
  const PoseBatch batch{"tank", 12, {{4, "lease", FullKinematics()}, {5, "", {}}}};
  v1::StreamBodyPosesRequest proto;
  ToProto(batch, &proto);
  const auto got = FromProto(proto);
  ASSERT_TRUE(got.ok()) << got.status();
  EXPECT_EQ(got->session, "tank");
  EXPECT_EQ(got->id, 12);
  ASSERT_EQ(got->poses.size(), 2U);
  EXPECT_EQ(got->poses[0].lease, "lease");
  EXPECT_EQ(got->poses[0].state.velocity_m_per_s, FullKinematics().velocity_m_per_s);
  EXPECT_EQ(got->poses[1].state, Kinematics{});
  proto.mutable_poses(0)->mutable_state()->mutable_spin_rad_per_s()->set_x(std::nan(""));
  EXPECT_THAT(std::string(FromProto(proto).status().message()),
              HasSubstr("poses[0].state.spin_rad_per_s.x: nan"));

  const InstrumentRequest request{
      "tank",
      {WaveGauge{{1.0, 2.0}}, PressureGauge{0, {1.0, 2.0, -3.0}}, Imu{4, {0.5, 0, 0}}, Motion{5}},
      6};
  v1::StreamInstrumentsRequest asked;
  ToProto(request, &asked);
  const auto read = FromProto(asked);
  ASSERT_TRUE(read.ok()) << read.status();
  ASSERT_EQ(read->instruments.size(), 4U);
  EXPECT_EQ(std::get<WaveGauge>(read->instruments[0]).place_m, (Vec2d{1.0, 2.0}));
  EXPECT_EQ(std::get<PressureGauge>(read->instruments[1]).position_m, (Vec3d{1.0, 2.0, -3.0}));
  EXPECT_EQ(std::get<Imu>(read->instruments[2]).body_id, 4U);
  EXPECT_EQ(std::get<Motion>(read->instruments[3]).body_id, 5U);
  EXPECT_EQ(ValueCount(read->instruments[2]), 10);
  EXPECT_EQ(ValueCount(read->instruments[3]), 13);
  EXPECT_EQ(read->ticks_per_reading, 6);
  asked.add_instruments();
  EXPECT_THAT(std::string(FromProto(asked).status().message()), HasSubstr("is none of wave_gauge"));
  asked.clear_instruments();
  EXPECT_THAT(std::string(FromProto(asked).status().message()), HasSubstr("instruments: 0"));
}

constexpr char kHarbour[] = R"(
name: "harbour"
sea { regular_waves { amplitude_m: 0.1 period_s: 5 direction { to_rad: 0 } } }
world {
  terrain_path: "bay.asc"
  regions { cell_m: 0.5 follow_body_id: 1 }
  bodies {
    body { name: "boat" mass_kg: 400 preset: "raft"
           shape { box { size_m { x: 4 y: 1.5 z: 0.8 } } } }
    start { position_m { x: 10 y: -5 } }
  }
  water_level { time_s: 0 level_m: 0.5 }
  water_level { time_s: 3600 level_m: -0.5 }
  body_wind { speed_m_per_s: 6 direction { from_deg: 270 } }
}
)";

TEST(WorldCodec, ASessionFileDescribesItsWorld) {
  const auto spec = ParseSessionText(kHarbour, "some/folder");
  ASSERT_TRUE(spec.ok()) << spec.status();
  EXPECT_EQ(spec->world.terrain_path, "some/folder/bay.asc");
  ASSERT_EQ(spec->world.regions.size(), 1U);
  EXPECT_EQ(spec->world.regions[0].columns, 256);
  ASSERT_EQ(spec->world.bodies.size(), 1U);
  EXPECT_EQ(spec->world.bodies[0].body.mass_kg, 400.0);
  EXPECT_EQ(spec->world.bodies[0].start.position_m.x, 10.0);
  ASSERT_EQ(spec->world.water_level.size(), 2U);
  // From the west: it blows to the east.
  EXPECT_NEAR(spec->world.body_wind_m_per_s->x, 6.0, 1e-12);
  EXPECT_NEAR(spec->world.body_wind_m_per_s->y, 0.0, 1e-12);
  v1::SessionSpec proto;
  ToProto(*spec, &proto);
  const auto again = FromProto(proto, "");
  ASSERT_TRUE(again.ok()) << again.status();
  EXPECT_EQ(again->world.regions, spec->world.regions);
  EXPECT_EQ(again->world.bodies, spec->world.bodies);
  EXPECT_EQ(again->world.water_level, spec->world.water_level);
  // Nobody who is not at this machine may name a file of it.
  EXPECT_THAT(std::string(ParseSessionText(kHarbour, "").status().message()),
              HasSubstr("only session files may name files"));
}

TEST(WorldCodec, AWorldOutOfItsLimitsIsRefused) {
  const auto message = [](auto change) {
    SessionSpec spec = *ParseSessionText(kHarbour, ".");
    change(spec.world);
    return std::string(ValidateSessionSpec(spec).message());
  };
  RegionSpec large;
  large.columns = large.rows = 1024;
  EXPECT_EQ(message([](WorldSpec&) {}), "");
  EXPECT_THAT(message([](WorldSpec& w) { w.regions[0].follow_body_id = 2; }),
              HasSubstr("world.regions[0].follow_body_id: 2"));
  EXPECT_THAT(message([](WorldSpec& w) { w.bodies[0].body.mass_kg = -1.0; }),
              HasSubstr("world.bodies[0].body.mass_kg: -1"));
  EXPECT_THAT(message([](WorldSpec& w) { w.water_level[1].time_s = 0.0; }),
              HasSubstr("world.water_level[1].time_s: 0"));
  EXPECT_THAT(message([](WorldSpec& w) { w.water_level[0].level_m = std::nan(""); }),
              HasSubstr("world.water_level[0].level_m: nan"));
  EXPECT_THAT(message([](WorldSpec& w) {
                w.body_wind_m_per_s = Vec2d{std::nan(""), 0.0};
              }),
              HasSubstr("world.body_wind"));
  EXPECT_THAT(message([&](WorldSpec& w) { w.regions.assign(5, large); }),
              HasSubstr("world.regions cells: 5242880"));
}

}  // namespace
}  // namespace onesea::wire
