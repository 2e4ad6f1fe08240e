#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "common/wire/body_encoder.h"
#include "common/wire/body_table.h"
#include "tests/sea/allocation_count.h"

namespace onesea::wire {
namespace {

using ::testing::HasSubstr;

constexpr int kTickRateHz = 60;
constexpr double kTickS = 1.0 / kTickRateHz;
// Half a step of each coordinate.
constexpr double kPlaceRoundingM = 0.5e-3 * 1.7320508;

std::shared_ptr<const BodyInfo> Info(std::uint32_t id, const std::string& name = "boat") {
  BodyInfo info;
  info.id = id;
  info.name = name;
  info.mass_kg = 300.0;
  return std::make_shared<const BodyInfo>(info);
}

// A boat that circles, heaves, rolls and pitches in a sea.
BodyState Boat(std::uint32_t id, double t) {
  const double turn_rate = 0.2, radius_m = 20.0, phase = id;
  const double heading = turn_rate * t + phase;
  BodyState boat;
  boat.id = id;
  boat.position_m = {1000.0 + radius_m * std::sin(heading), -2000.0 - radius_m * std::cos(heading),
                     0.3 * std::sin(1.1 * t + phase)};
  boat.velocity_m_per_s = {radius_m * turn_rate * std::cos(heading),
                           radius_m * turn_rate * std::sin(heading),
                           0.33 * std::cos(1.1 * t + phase)};
  const double roll = 0.1 * std::sin(2.0 * t), roll_rate = 0.2 * std::cos(2.0 * t);
  const Quaternion yaw = TurnBy({0.0, 0.0, heading});
  boat.turn = yaw * TurnBy({roll, 0.0, 0.0});
  boat.spin_rad_per_s = Vec3d{0.0, 0.0, turn_rate} + Rotate(yaw, {roll_rate, 0.0, 0.0});
  return boat;
}

TEST(BodyCodec, RoundTripKeepsMillimetresAndHundredthsOfADegree) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  double worst_angle_rad = 0.0, worst_place_m = 0.0;
  for (int trial = 0; trial < 2000; ++trial) {
    SentBody body;
    body.state.id = static_cast<std::uint32_t>(1 + random() % 1000);
    body.state.flags = static_cast<std::uint8_t>(random());
    body.age_ticks = static_cast<Tick>(random() % kBodyAgeTicksMax);
    body.state.position_m = {9e6 * std::sin(normal(random)), 1e3 * normal(random), normal(random)};
    body.state.turn = Normalised({normal(random), normal(random), normal(random), normal(random)});
    body.state.velocity_m_per_s = {normal(random), 10.0 * normal(random), normal(random)};
    body.state.spin_rad_per_s = {normal(random), normal(random), normal(random)};
    std::string bytes;
    AppendBodies({&body, 1}, bytes);
    const auto read = ReadBodies(bytes);
    ASSERT_TRUE(read.ok()) << read.status();
    ASSERT_EQ(read->size(), 1U);
    const BodyState& got = (*read)[0].state;
    EXPECT_EQ(got.id, body.state.id);
    EXPECT_EQ(got.flags, body.state.flags);
    EXPECT_EQ((*read)[0].age_ticks, body.age_ticks);
    worst_place_m = std::max(worst_place_m, Norm(got.position_m - body.state.position_m));
    worst_angle_rad = std::max(worst_angle_rad, AngleBetween(got.turn, body.state.turn));
    EXPECT_LE(Norm(got.velocity_m_per_s - body.state.velocity_m_per_s), kPlaceRoundingM + 1e-9);
    EXPECT_LE(Norm(got.spin_rad_per_s - body.state.spin_rad_per_s), kPlaceRoundingM + 1e-9);
    EXPECT_EQ(Quantised(body.state).position_m, got.position_m);
    EXPECT_EQ(Quantised(body.state).turn, got.turn);
    EXPECT_EQ(Quantised(body.state).velocity_m_per_s, got.velocity_m_per_s);
  }
  EXPECT_LE(worst_place_m, kPlaceRoundingM + 2e-9);
  EXPECT_LE(worst_angle_rad, 0.01 * 3.14159265 / 180.0);
}

TEST(BodyCodec, SpeedsBeyondTheLimitSaturate) {
  BodyState wild;
  wild.id = 1;
  wild.velocity_m_per_s = {1e9, -1e9, 0.0};
  wild.spin_rad_per_s = {0.0, 1e300, -1e300};
  const BodyState cut = Quantised(wild);
  EXPECT_EQ(cut.velocity_m_per_s, (Vec3d{kBodySpeedMaxMPerS, -kBodySpeedMaxMPerS, 0.0}));
  EXPECT_EQ(cut.spin_rad_per_s, (Vec3d{0.0, kBodySpinMaxRadPerS, -kBodySpinMaxRadPerS}));
}

TEST(BodyCodec, BytesThatNoEncoderWritesAreRefused) {
  const SentBody bodies[] = {{Boat(3, 0.0), 0}, {Boat(4, 0.0), 0}};
  std::string bytes;
  AppendBodies(bodies, bytes);
  ASSERT_TRUE(ReadBodies(bytes).ok());
  for (std::size_t size = 1; size < bytes.size(); ++size) {
    const auto read = ReadBodies(std::string_view(bytes).substr(0, size));
    // Only a cut between two bodies leaves something whole.
    if (read.ok()) {
      EXPECT_LE(read->size(), 1U) << size;
    }
  }
  const SentBody twice[] = {{Boat(3, 0.0), 0}, {Boat(3, 0.0), 0}};
  std::string same;
  AppendBodies(twice, same);
  EXPECT_THAT(std::string(ReadBodies(same).status().message()), HasSubstr("id 3 after 3"));
  std::vector<SentBody> crowd(kBodiesMax + 1);
  for (std::size_t n = 0; n < crowd.size(); ++n) {
    crowd[n].state.id = static_cast<std::uint32_t>(n + 1);
  }
  std::string many;
  AppendBodies(crowd, many);
  EXPECT_THAT(std::string(ReadBodies(many).status().message()), HasSubstr("the limit is 1024"));
}

// The promise of dead reckoning, at every tick that was offered, and what it saves.
TEST(BodyEncoder, ReceiversStayWithinTheTolerance) {
  BodyEncoder encoder(kTickS);
  BodyTable table;
  const std::vector<std::shared_ptr<const BodyInfo>> infos = {Info(1), Info(2), Info(9)};
  int sent = 0, offered = 0;
  for (Tick tick = 0; tick < 1200; tick += 2) {
    const double t = static_cast<double>(tick) * kTickS;
    const BodyView views[] = {
        {Boat(1, t), infos[0]}, {Boat(2, t), infos[1]}, {Boat(9, t), infos[2]}};
    const BodyUpdate& update = encoder.Encode(tick, views);
    sent += static_cast<int>(ReadBodies(update.states)->size());
    offered += 3;
    ASSERT_TRUE(table.Apply(update, tick, kTickRateHz, tick == 0).ok());
    for (const BodyView& view : views) {
      const BodyTable::Body* body = table.Find(view.state.id);
      ASSERT_NE(body, nullptr);
      const BodyState shown = body->At(TimeOfTick(tick, kTickRateHz));
      ASSERT_LE(Norm(shown.position_m - view.state.position_m), 5e-3 + kPlaceRoundingM);
      ASSERT_LE(AngleBetween(shown.turn, view.state.turn), 1.75e-3 + 2e-4);
    }
  }
  EXPECT_LT(sent, offered / 2);
  EXPECT_GT(sent, offered / 60);
}

TEST(BodyEncoder, RestIsSaidOnceAndSteadyMotionOnceASecond) {
  BodyEncoder encoder(kTickS);
  BodyState still = Boat(1, 0.0), steady = Boat(2, 0.0);
  still.velocity_m_per_s = still.spin_rad_per_s = {};
  steady.velocity_m_per_s = {2.0, 0.0, 0.0};
  steady.spin_rad_per_s = {};
  const Vec3d start = steady.position_m;
  const auto still_info = Info(1), steady_info = Info(2);
  int stills = 0, steadies = 0;
  for (Tick tick = 0; tick < 600; ++tick) {
    steady.position_m = start + static_cast<double>(tick) * kTickS * steady.velocity_m_per_s;
    const BodyView views[] = {{still, still_info}, {steady, steady_info}};
    const auto states = ReadBodies(encoder.Encode(tick, views).states);
    for (const SentBody& sent : *states) (sent.state.id == 1 ? stills : steadies) += 1;
  }
  EXPECT_EQ(stills, 1);
  EXPECT_EQ(steadies, 10);
}

// A newcomer takes a keyframe and is then within the same tolerance as everybody, bit for bit.
TEST(BodyEncoder, AKeyframeMakesTheSameTable) {
  BodyEncoder encoder(kTickS);
  BodyTable faithful, late;
  std::vector<std::shared_ptr<const BodyInfo>> infos = {Info(1), Info(2), Info(3)};
  for (Tick tick = 0; tick < 300; tick += 2) {
    const double t = static_cast<double>(tick) * kTickS;
    std::vector<BodyView> views = {{Boat(1, t), infos[0]}, {Boat(2, t), infos[1]}};
    if (tick > 100) views.push_back({Boat(3, t), infos[2]});
    if (tick > 120) views.erase(views.begin());
    if (tick == 140) infos[1] = Info(2, "renamed");
    const BodyUpdate& update = encoder.Encode(tick, views);
    ASSERT_TRUE(faithful.Apply(update, tick, kTickRateHz, tick == 0).ok());
    if (tick == 152) {
      ASSERT_TRUE(late.Apply(encoder.Keyframe(), tick, kTickRateHz, true).ok());
    } else if (tick > 152) {
      ASSERT_TRUE(late.Apply(update, tick, kTickRateHz, false).ok());
    }
    if (tick < 152) continue;
    ASSERT_EQ(late.bodies().size(), 2U);
    for (std::size_t n = 0; n < 2; ++n) {
      EXPECT_EQ(late.bodies()[n].info, faithful.bodies()[n].info);
      EXPECT_EQ(late.bodies()[n].newest.position_m, faithful.bodies()[n].newest.position_m);
      EXPECT_EQ(late.bodies()[n].newest_time, faithful.bodies()[n].newest_time);
    }
  }
  EXPECT_EQ(late.Find(2)->info->name, "renamed");
  EXPECT_EQ(late.Find(1), nullptr);
}

TEST(BodyEncoder, AllocatesNothingOnceWarm) {
  BodyEncoder encoder(kTickS);
  const auto one = Info(1), two = Info(2);
  Tick tick = 0;
  const auto encode = [&] {
    const double t = 0.5 * static_cast<double>(++tick);  // everything is sent each time
    const BodyView views[] = {{Boat(1, t), one}, {Boat(2, t), two}};
    encoder.Encode(tick, views);
  };
  for (int n = 0; n < 3; ++n) encode();
  const std::int64_t before = AllocationCount();
  for (int n = 0; n < 10; ++n) encode();
  EXPECT_EQ(AllocationCount(), before);
}

TEST(BodyTable, BetweenTwoStatesMotionIsSmooth) {
  BodyTable table;
  BodyEncoder encoder(kTickS);
  const auto info = Info(1);
  // 0.5 s apart: more than the encoder would leave.
  for (const Tick tick : {0, 30}) {
    const BodyView view{Boat(1, static_cast<double>(tick) * kTickS), info};
    ASSERT_TRUE(table.Apply(encoder.Encode(tick, {&view, 1}), tick, kTickRateHz, tick == 0).ok());
  }
  const BodyTable::Body& body = *table.Find(1);
  for (int n = 0; n <= 30; ++n) {
    const double t = n * kTickS;
    const BodyState shown = body.At(SimTime::FromSeconds(t)), truth = Boat(1, t);
    // Hermite's error is f''''h⁴/384: under a millimetre here, and rounding.
    EXPECT_LE(Norm(shown.position_m - truth.position_m), 3e-3) << t;
    EXPECT_LE(AngleBetween(shown.turn, truth.turn), 0.02) << t;
  }
}

TEST(BodyTable, AStalledStreamStopsBodiesSoon) {
  BodyTable table;
  BodyEncoder encoder(kTickS);
  const auto info = Info(1);
  const BodyView view{Boat(1, 0.0), info};
  ASSERT_TRUE(table.Apply(encoder.Encode(0, {&view, 1}), 0, kTickRateHz, true).ok());
  const BodyTable::Body& body = *table.Find(1);
  EXPECT_EQ(body.At(SimTime::FromSeconds(100.0)).position_m,
            body.At(SimTime::FromSeconds(BodyTable::kExtrapolationMaxS)).position_m);
}

TEST(BodyTable, WhatDoesNotFitIsRefusedAndChangesNothing) {
  BodyTable table;
  BodyEncoder encoder(kTickS);
  const auto info = Info(1);
  const BodyView view{Boat(1, 0.0), info};
  const BodyUpdate first = encoder.Encode(0, {&view, 1});
  const auto refused = [&](const BodyUpdate& update, const std::string& words) {
    const absl::Status status = table.Apply(update, 0, kTickRateHz, false);
    EXPECT_THAT(std::string(status.message()), HasSubstr(words));
    EXPECT_EQ(table.bodies().size(), 1U);
  };
  ASSERT_TRUE(table.Apply(first, 0, kTickRateHz, true).ok());
  refused({.removed_ids = {7}, .infos = {}, .states = {}}, "removed id 7 isn't there");
  refused({.removed_ids = {}, .infos = {Info(2)}, .states = {}}, "id 2 has no state");
  refused({.removed_ids = {1}, .infos = {}, .states = first.states}, "id 1 has no info");
  refused({.removed_ids = {}, .infos = {nullptr}, .states = {}}, "says nothing");
  refused({.removed_ids = {}, .infos = {Info(0)}, .states = {}}, "id");
}

TEST(BodyDescription, EveryNumberHasItsLimits) {
  const auto message = [](auto change) {
    BodyDescription body;
    body.shape.emplace();
    body.mass_kg = 1.0;
    body.windage.emplace();
    body.thrusters.resize(1);
    body.rudders.resize(1);
    EXPECT_TRUE(ValidateBodyDescription("body.", body).ok());
    change(body);
    return std::string(ValidateBodyDescription("body.", body).message());
  };
  const double nan = std::nan("");
  EXPECT_THAT(message([&](auto& b) { b.mass_kg = nan; }), HasSubstr("body.mass_kg: nan"));
  EXPECT_THAT(message([](auto& b) { b.mass_kg = 0.0; }), HasSubstr("body.mass_kg: 0 is outside"));
  EXPECT_THAT(message([](auto& b) { b.shape->size_m.y = -1.0; }), HasSubstr("shape.size.y_m: -1"));
  EXPECT_THAT(message([](auto& b) { b.shape->kind = static_cast<ShapeKind>(9); }),
              HasSubstr("shape.kind"));
  EXPECT_THAT(message([](auto& b) { b.shape.reset(); }), HasSubstr("body.shape: is missing"));
  EXPECT_THAT(message([](auto& b) { b.mass_kg.reset(); }), HasSubstr("body.mass_kg: is missing"));
  EXPECT_THAT(message([](auto& b) { b.preset.assign(65, 'x'); }), HasSubstr("body.preset"));
  EXPECT_THAT(message([](auto& b) { b.name.assign(65, 'x'); }), HasSubstr("65 bytes"));
  EXPECT_THAT(message([](auto& b) { b.colour_rgb = 0x1000000; }), HasSubstr("colour_rgb"));
  EXPECT_THAT(message([](auto& b) { b.thrusters[0].direction = {}; }),
              HasSubstr("thrusters[0].direction length"));
  EXPECT_THAT(message([&](auto& b) { b.thrusters[0].kt = nan; }), HasSubstr("thrusters[0].kt"));
  EXPECT_THAT(message([](auto& b) { b.rudders[0].behind_thruster = 1; }),
              HasSubstr("rudders[0].behind_thruster: 1"));
  EXPECT_THAT(message([](auto& b) { b.rudders.resize(5); }), HasSubstr("rudders: 5 elements"));
  EXPECT_THAT(message([&](auto& b) { b.added_mass.emplace().fill(nan); }),
              HasSubstr("added_mass[0]"));
  EXPECT_THAT(message([&](auto& b) {
                b.centre_of_mass_m = Vec3d{0.0, nan, 0.0};
              }),
              HasSubstr("centre_of_mass_m.y"));
  EXPECT_THAT(message([&](auto& b) { b.windage->lateral_area_m2 = -1.0; }),
              HasSubstr("windage.lateral_area_m2"));
}

}  // namespace
}  // namespace onesea::wire
