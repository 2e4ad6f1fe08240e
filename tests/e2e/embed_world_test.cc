// The embeddable library where the sea answers back: wakes, bodies and commands, compared with what
// the server itself says by its RPCs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <onesea/onesea.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "tests/e2e/harness.h"
#include "tests/e2e/tcp_relay.h"

namespace onesea::e2e {
namespace {

using ::testing::HasSubstr;

constexpr char kHarbour[] = "deploy/terrain/harbour.asc.gz";

// How far local heights were from the server's.
struct Comparison {
  double worst_m = 0.0;         // of all places
  double allowed_m = 0.0;       // the wakes' share of the stated bound
  double highest_wake_m = 0.0;  // amount of the wakes' share
  std::size_t dry = 0;
};

class EmbedWorld : public testing::Test {
 protected:
  std::unique_ptr<Sea> JoinAt(int port, bool world = true, const std::string& name = {}) {
    auto sea = Join(absl::StrCat("127.0.0.1:", port),
                    {.session = "a", .client_name = name, .world = world});
    EXPECT_TRUE(sea.ok()) << sea.status();
    return sea.ok() ? *std::move(sea) : nullptr;
  }
  std::unique_ptr<Sea> JoinHere() { return JoinAt(server_.port()); }

  // A boat under way, its wake in the water.
  std::unique_ptr<OwnBody> Launch(Sea& sea, double x_m, double y_m, double speed_m_per_s = 3.0) {
    auto boat = sea.Spawn({.x_m = x_m, .y_m = y_m, .name = "swift"});
    EXPECT_TRUE(boat.ok()) << boat.status();
    EXPECT_TRUE((*boat)->Drive(1.0, 0.2).ok());
    EXPECT_TRUE(Eventually([&] { return SpeedOf(sea, **boat) > speed_m_per_s; }))
        << (*boat)->status();
    return *std::move(boat);
  }
  static double SpeedOf(const Sea& sea, const OwnBody& own) {
    const std::optional<Body> body = sea.FindBody(own.id());
    if (!body) return 0.0;
    return std::hypot(body->velocity_m_per_s[0], body->velocity_m_per_s[1]);
  }

  // Along, across and around a body.
  static std::vector<Place> PlacesAround(const Body& body) {
    std::vector<Place> places;
    for (int n = 0; n < 121; ++n) {
      places.push_back(
          {body.position_m[0] + 1.7 * (n % 11 - 5), body.position_m[1] + 1.7 * (n / 11 - 5)});
    }
    return places;
  }

  // The server answers for its present tick, then this process for the same, once it has news of
  // it.
  Comparison CompareAt(const Sea& sea, const std::vector<Place>& places) {
    wire::QueryRequest request;
    request.session = "a";
    request.detail = sea::QueryDetail::kNormal;
    for (const Place& place : places) request.points_m.push_back({place.x_m, place.y_m});
    wire::QueryAnswer answer;
    std::vector<Water> water(places.size());
    std::vector<double> height_m(places.size());
    // On a busy machine once more, if the moment was history before it was asked for: wakes of the
    // last second are known.
    for (int tries = 0; tries < 20; ++tries) {
      answer = server_.Remote()->QueryPoints(request).value();
      EXPECT_TRUE(Eventually([&] { return sea.session().news_time_s >= answer.time_s - 1e-9; }));
      EXPECT_TRUE(sea.Sample(places, answer.time_s, Detail::kNormal, water).ok());
      for (std::size_t n = 0; n < places.size(); ++n) {
        height_m[n] = sea.HeightAt(places[n].x_m, places[n].y_m, answer.time_s);
      }
      if (sea.session().news_time_s < answer.time_s + 0.9) break;
    }
    Comparison comparison;
    comparison.allowed_m = sea.HeightErrorBound(answer.time_s) - answer.height_error_bound_m + 1e-6;
    std::vector<std::int32_t> dry;
    for (std::size_t n = 0; n < places.size(); ++n) {
      EXPECT_EQ(water[n].layers, answer.layers);
      EXPECT_EQ(height_m[n], water[n].height_m);
      comparison.worst_m =
          std::max(comparison.worst_m, std::abs(water[n].height_m - answer.height_m[n]));
      comparison.highest_wake_m = std::max(comparison.highest_wake_m, std::abs(water[n].wakes_m));
      // A step of a millimetre on cells of half a metre and more.
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(water[n].normal[axis], answer.normal[3 * n + axis], 0.01);
      }
      if (water[n].dry) dry.push_back(static_cast<std::int32_t>(n));
    }
    EXPECT_EQ(dry, answer.dry_indices);
    comparison.dry = dry.size();
    return comparison;
  }

  TestServer server_{Transport::kLoopback};
};

TEST_F(EmbedWorld, HeightsBesideAMovingBoatAreTheServers) {
  server_.Create(SmallSession("a"));
  const auto sea = JoinHere();
  const auto waves_alone = JoinAt(server_.port(), false);
  const auto boat = Launch(*sea, 0.0, 0.0);
  double worst_m = 0.0, highest_m = 0.0, differs_m = 0.0;
  for (int n = 0; n < 40; ++n) {
    const std::vector<Place> places = PlacesAround(*sea->FindBody(boat->id()));
    const Comparison comparison = CompareAt(*sea, places);
    EXPECT_GT(comparison.allowed_m, 1e-3);
    EXPECT_LT(comparison.allowed_m, 2e-3);
    EXPECT_LE(comparison.worst_m, comparison.allowed_m);
    worst_m = std::max(worst_m, comparison.worst_m);
    highest_m = std::max(highest_m, comparison.highest_wake_m);
    const double then_s = sea->session().news_time_s;
    for (const Place& place : places) {
      differs_m =
          std::max(differs_m, std::abs(sea->HeightAt(place.x_m, place.y_m, then_s) -
                                       waves_alone->HeightAt(place.x_m, place.y_m, then_s)));
    }
  }
  std::printf("wakes up to %.3f m, at most %.2f mm from the server's\n", highest_m, 1e3 * worst_m);
  EXPECT_GT(highest_m, 0.03);
  EXPECT_GT(differs_m, 0.03);
  EXPECT_TRUE(waves_alone->Bodies().empty());
}

// The present: what Now() and HeightAt() without a time say, once the session stands still.
TEST_F(EmbedWorld, AHeldSeaIsTheServersNowForALateJoinerToo) {
  server_.Create(SmallSession("a"));
  const auto sea = JoinHere();
  const auto boat = Launch(*sea, 0.0, 0.0);
  const Tick tick = server_.Remote()->Hold("a").value();
  const auto late = JoinHere();
  const double time_s = static_cast<double>(tick) / 60.0;
  for (const Sea* here : {sea.get(), late.get()}) {
    ASSERT_TRUE(Eventually([&] {
      return here->Now() == time_s && here->session().news_time_s == time_s;
    })) << here->Now()
        << ' ' << here->session().news_time_s << ' ' << time_s;
    const Body body = *here->FindBody(boat->id());
    EXPECT_EQ(body.name, "swift");
    const std::vector<Place> places = PlacesAround(body);
    const Comparison comparison = CompareAt(*here, places);
    EXPECT_GT(comparison.highest_wake_m, 0.03);
    EXPECT_LE(comparison.worst_m, comparison.allowed_m);
    for (const Place& place : places) {
      // Waves are 0.35 mm off between two of their moments, and this is such a moment.
      EXPECT_NEAR(here->HeightAt(place.x_m, place.y_m),
                  here->HeightAt(place.x_m, place.y_m, time_s), 1e-6);
    }
    const client::BodyList list = server_.Remote()->ListBodies("a").value();
    ASSERT_EQ(list.tick, tick);
    EXPECT_NEAR(list.bodies[0].state.position_m.x, body.position_m[0], 6e-3);
    EXPECT_NEAR(list.bodies[0].state.position_m.y, body.position_m[1], 6e-3);
    EXPECT_NEAR(list.bodies[0].state.velocity_m_per_s.x, body.velocity_m_per_s[0], 0.1);
  }
}

TEST_F(EmbedWorld, OverTerrainAtHighWaterLandIsDryAndWakesAreIn) {
  SessionSpec spec = SmallSession("a");
  spec.world.terrain_path = kHarbour;
  spec.world.water_level = {{0.0, 0.3}, {600.0, 0.9}};
  server_.Create(spec);
  const auto sea = JoinHere();
  const auto boat = Launch(*sea, 60.0, -80.0, 2.0);  // in the basin
  std::vector<Place> places = PlacesAround(*sea->FindBody(boat->id()));
  for (int n = 0; n < 100; ++n) places.push_back({-400.0 + 8.0 * n, 300.0 - 5.0 * n});
  double highest_m = 0.0;
  for (int n = 0; n < 10; ++n) {
    const Comparison comparison = CompareAt(*sea, places);
    EXPECT_LE(comparison.worst_m, comparison.allowed_m);
    EXPECT_GT(comparison.dry, 5u);
    highest_m = std::max(highest_m, comparison.highest_wake_m);
  }
  EXPECT_GT(highest_m, 0.03);
  std::vector<Water> water(1);
  ASSERT_TRUE(
      sea->Sample({places.data(), 1}, sea->session().news_time_s, Detail::kHeight, water).ok());
  EXPECT_EQ(water[0].layers, kLayerWaves | kLayerWakes | kLayerTerrain | kLayerWaterLevel);
  ASSERT_TRUE(sea->Sample({places.data(), 1}, -100.0, Detail::kHeight, water).ok());
  EXPECT_EQ(water[0].layers, kLayerWaves | kLayerTerrain | kLayerWaterLevel);
}

// Calls come back before the server, 50 ms away each way, can have said a word.
TEST_F(EmbedWorld, CommandsDoNotWaitForTheServer) {
  server_.Create(SmallSession("a"));
  TcpRelay relay(server_.port(), 50'000'000);
  const auto sea = JoinAt(relay.port());
  const absl::Time start = absl::Now();
  const auto crate = sea->Spawn({.preset = "crate"}).value();
  EXPECT_TRUE(crate->Impulse(4000.0, 0.0, 0.0).ok());
  const bool still_early = absl::Now() - start < absl::Milliseconds(90);
  if (still_early) {
    EXPECT_EQ(crate->id(), 0u);
    EXPECT_EQ(crate->status().code(), absl::StatusCode::kUnavailable);
  }
  // What was said early reaches it.
  ASSERT_TRUE(Eventually([&] { return SpeedOf(*sea, *crate) > 0.3; })) << crate->status();
  EXPECT_GT(sea->FindBody(crate->id())->velocity_m_per_s[0], 0.0);
  EXPECT_TRUE(crate->status().ok()) << crate->status();
  crate->Remove();
  ASSERT_TRUE(Eventually([&] { return sea->Bodies().empty(); }));
  EXPECT_TRUE(Eventually([&] { return crate->status().code() == absl::StatusCode::kNotFound; }));
  // Its region went with it.
  std::vector<Water> water(1);
  const Place place;
  EXPECT_TRUE(Eventually([&] {
    EXPECT_TRUE(sea->Sample({&place, 1}, sea->session().news_time_s, Detail::kHeight, water).ok());
    return (water[0].layers & kLayerWakes) == 0;
  }));
}

TEST_F(EmbedWorld, ABodyObeysWhoHoldsItsLease) {
  server_.Create(SmallSession("a"));
  const auto anne = JoinAt(server_.port(), true, "Anne"),
             bert = JoinAt(server_.port(), true, "Bert");
  auto boat = Launch(*anne, 0.0, 0.0, 1.0);
  const std::uint32_t id = boat->id();
  ASSERT_TRUE(Eventually([&] { return bert->FindBody(id).has_value(); }));
  EXPECT_EQ(bert->FindBody(id)->owner, "Anne");
  const auto refused = bert->Take(id).value();
  ASSERT_TRUE(Eventually([&] {
    return refused->status().code() == absl::StatusCode::kPermissionDenied;
  })) << refused->status();
  EXPECT_THAT(refused->status().message(), HasSubstr("Anne"));
  EXPECT_TRUE(refused->Drive(-1.0, 0.0).ok());  // goes nowhere
  boat.reset();                                 // lets go, and stops the motor
  ASSERT_TRUE(
      Eventually([&] { return server_.Remote()->ListBodies("a")->bodies[0].driver.empty(); }));
  const auto taken = bert->Take(id).value();
  ASSERT_TRUE(Eventually([&] { return taken->status().ok(); })) << taken->status();
  EXPECT_EQ(server_.Remote()->ListBodies("a")->bodies[0].driver, "Bert");
  EXPECT_TRUE(taken->Drive(-1.0, 0.0).ok());
  EXPECT_TRUE(Eventually([&] {
    const Body body = *anne->FindBody(id);
    const double ahead = std::cos(body.HeadingRad()) * body.velocity_m_per_s[0] +
                         std::sin(body.HeadingRad()) * body.velocity_m_per_s[1];
    return ahead < -0.5;
  }));
}

// Who leaves the sea lets go of everything.
TEST_F(EmbedWorld, LeavingTheSeaStopsItsBodies) {
  server_.Create(SmallSession("a"));
  auto sea = JoinHere();
  const auto boat = Launch(*sea, 0.0, 0.0, 1.0);
  EXPECT_EQ(server_.Remote()->ListBodies("a")->bodies[0].driver, "a game");
  sea.reset();
  EXPECT_EQ(server_.Remote()->ListBodies("a")->bodies[0].driver, "");
  EXPECT_EQ(boat->status().code(), absl::StatusCode::kCancelled);
  EXPECT_TRUE(boat->Drive(1.0, 0.0).ok());
  boat->Remove();
}

// The server goes down under way: wakes stand and fade, no height jumps. It comes back without the
// boat.
TEST_F(EmbedWorld, WakesFadeWhileTheServerIsAwayAndABoatThatIsGoneIsToldOf) {
  server_.Create(SmallSession("a"));
  const auto sea = JoinHere();
  const auto boat = Launch(*sea, 0.0, 0.0);
  const Body there = *sea->FindBody(boat->id());
  server_.Stop();
  const Place place{there.position_m[0], there.position_m[1]};
  Water water;
  const double last_s = sea->session().news_time_s;
  const auto wake_at = [&](double time_s) {
    EXPECT_TRUE(sea->Sample({&place, 1}, time_s, Detail::kHeight, {&water, 1}).ok());
    return water.wakes_m;
  };
  const double wake_m = wake_at(last_s);
  EXPECT_GT(std::abs(wake_m), 0.01);
  // On by the last change for a moment, then it stands.
  const double standing_m = wake_at(last_s + 0.2);
  EXPECT_NEAR(standing_m, wake_m, 0.02);
  EXPECT_EQ(wake_at(last_s + 1.4), standing_m);
  EXPECT_NEAR(wake_at(last_s + 2.25), 0.5 * standing_m, 1e-6);
  EXPECT_EQ(wake_at(last_s + 3.1), 0.0);
  EXPECT_EQ(water.layers, kLayerWaves);
  EXPECT_TRUE(boat->Drive(0.5, 0.0).ok());
  EXPECT_TRUE(Eventually([&] { return boat->status().code() == absl::StatusCode::kUnavailable; }));
  EXPECT_TRUE(std::isfinite(sea->HeightAt(place.x_m, place.y_m)));

  server_.Start();
  server_.Create(SmallSession("a"));
  ASSERT_TRUE(Eventually([&] { return boat->status().code() == absl::StatusCode::kNotFound; }))
      << boat->status();
  EXPECT_TRUE(sea->Bodies().empty());
  EXPECT_TRUE(sea->status().ok()) << sea->status();
  const auto another = Launch(*sea, 0.0, 0.0);
  const Comparison comparison = CompareAt(*sea, PlacesAround(*sea->FindBody(another->id())));
  EXPECT_LE(comparison.worst_m, comparison.allowed_m);
  EXPECT_GT(comparison.highest_wake_m, 0.03);
}

TEST_F(EmbedWorld, NonsenseIsRefusedAndHarmsNothing) {
  server_.Create(SmallSession("a"));
  const auto sea = JoinHere();
  const double nan = std::nan("");
  const auto code = [](const auto& result) { return result.status().code(); };
  constexpr auto kInvalid = absl::StatusCode::kInvalidArgument;
  EXPECT_EQ(code(sea->Spawn({.x_m = nan})), kInvalid);
  EXPECT_EQ(code(sea->Spawn({.y_m = -2e7})), kInvalid);
  EXPECT_EQ(code(sea->Spawn({.heading_rad = HUGE_VAL})), kInvalid);
  EXPECT_EQ(code(sea->Spawn({.preset = std::string(65, 'x')})), kInvalid);
  EXPECT_EQ(code(sea->Spawn({.preset = ""})), kInvalid);
  EXPECT_EQ(code(sea->Spawn({.name = std::string(65, 'x')})), kInvalid);
  EXPECT_EQ(code(sea->Take(0)), kInvalid);
  const auto submarine = sea->Spawn({.preset = "submarine"}).value();
  const auto nobody = sea->Take(77).value();
  const auto crate = sea->Spawn({.preset = "crate", .heading_rad = 1e9}).value();
  for (const double bad : {nan, 1.01, -HUGE_VAL}) {
    EXPECT_EQ(crate->Drive(bad, 0.0).code(), kInvalid);
    EXPECT_EQ(crate->Drive(0.0, bad).code(), kInvalid);
    EXPECT_EQ(crate->Impulse(0.0, 1e10 * bad, 0.0).code(), kInvalid);
  }
  EXPECT_TRUE(Eventually([&] {
    return submarine->status().code() != absl::StatusCode::kUnavailable &&
           nobody->status().code() == absl::StatusCode::kNotFound && crate->id() != 0;
  }));
  EXPECT_THAT(submarine->status().message(), HasSubstr("submarine"));
  EXPECT_EQ(submarine->id(), 0u);
  EXPECT_TRUE(submarine->Drive(1.0, 0.0).ok());
  // A crate has no motor: the server says so.
  EXPECT_TRUE(crate->Drive(1.0, 0.0).ok());
  EXPECT_TRUE(Eventually([&] { return crate->status().code() == kInvalid; }));
  EXPECT_THAT(crate->status().message(), HasSubstr("thrusters"));
  EXPECT_TRUE(sea->Bodies(nan).empty());
  EXPECT_FALSE(sea->FindBody(77).has_value());
  ASSERT_TRUE(Eventually([&] { return sea->Bodies().size() == 1; }));
  EXPECT_TRUE(sea->status().ok());
}

}  // namespace
}  // namespace onesea::e2e
