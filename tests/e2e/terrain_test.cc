// A terrain on its way from a session to a joiner, and the sea over it at both ends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "client/model/local_sea.h"
#include "client/net/terrain_fetcher.h"
#include "common/ingest/terrain_file.h"
#include "onesea/onesea.h"
#include "tests/e2e/harness.h"

namespace onesea::e2e {
namespace {

using client::TerrainFetcher;
using ::testing::HasSubstr;

constexpr char kHarbour[] = "deploy/terrain/harbour.asc.gz";

SessionSpec HarbourSession(const std::string& name) {
  SessionSpec spec = SmallSession(name);
  spec.world.terrain_path = kHarbour;
  spec.world.water_level = {{0.0, 0.25}, {600.0, 0.75}};
  return spec;
}

// What a fetcher told, for the test's thread.
class Told {
 public:
  TerrainFetcher::Events Events() {
    return {.on_terrain =
                [this](std::shared_ptr<const sea::Terrain> terrain) {
                  absl::MutexLock lock(&mutex_);
                  terrain_ = std::move(terrain);
                },
            .on_failed =
                [this](const absl::Status& status) {
                  absl::MutexLock lock(&mutex_);
                  failure_ = status;
                }};
  }
  std::shared_ptr<const sea::Terrain> terrain() {
    absl::MutexLock lock(&mutex_);
    return terrain_;
  }
  absl::Status failure() {
    absl::MutexLock lock(&mutex_);
    return failure_;
  }

 private:
  absl::Mutex mutex_;
  std::shared_ptr<const sea::Terrain> terrain_ ABSL_GUARDED_BY(mutex_);
  absl::Status failure_ ABSL_GUARDED_BY(mutex_);
};

TEST(TerrainFetcher, BringsTheSessionsTerrain) {
  const sea::Terrain file = ingest::ReadTerrainFile(kHarbour, {}).value();
  TestServer server(Transport::kLoopback);
  server.Create(HarbourSession("a"));
  const SessionInfo info = server.Remote()->ListSessions().value().front();
  EXPECT_EQ(info.terrain_hash, sea::TerrainHash(file));
  Told told;
  TerrainFetcher fetcher(server.Connect(), "a", told.Events());
  fetcher.Want(info.terrain_hash);
  ASSERT_TRUE(Eventually([&] { return told.terrain() != nullptr; })) << told.failure();
  EXPECT_EQ(told.terrain()->elevation_m, file.elevation_m);
}

TEST(TerrainFetcher, SaysWhyThereIsNone) {
  TestServer server(Transport::kInProcess);
  server.Create(SmallSession("open"));
  server.Create(HarbourSession("harbour"));
  {
    Told told;
    TerrainFetcher fetcher(server.Connect(), "open", told.Events());
    fetcher.Want(77);
    ASSERT_TRUE(Eventually([&] { return !told.failure().ok(); }));
    EXPECT_EQ(told.failure().code(), absl::StatusCode::kNotFound);
    EXPECT_THAT(told.failure().message(), HasSubstr("'open' has no terrain"));
  }
  Told told;
  TerrainFetcher fetcher(server.Connect(), "harbour", told.Events());
  fetcher.Want(77);
  ASSERT_TRUE(Eventually([&] { return !told.failure().ok(); }));
  EXPECT_EQ(told.failure().code(), absl::StatusCode::kDataLoss);
  EXPECT_THAT(told.failure().message(), HasSubstr("terrain.hash"));
}

TEST(TerrainFetcher, WaitsForAServerThatIsAwayAndStopsWhenToldTo) {
  const std::uint64_t hash = sea::TerrainHash(ingest::ReadTerrainFile(kHarbour, {}).value());
  TestServer server(Transport::kLoopback);
  server.Stop();
  Told told;
  TerrainFetcher fetcher(server.Connect(), "a", told.Events(),
                         {.first_ns = 5'000'000, .longest_ns = 50'000'000});
  fetcher.Want(hash);
  absl::SleepFor(absl::Milliseconds(100));
  server.Start();
  server.Create(HarbourSession("a"));
  // A server that is up before its session is there has said "not found": ask again.
  EXPECT_TRUE(Eventually([&] {
    fetcher.Want(hash);
    return told.terrain() != nullptr;
  })) << told.failure();
  Told nobody;
  TerrainFetcher idle(server.Connect(), "a", nobody.Events());  // ends without a call
  server.Stop();
  TerrainFetcher hopeless(server.Connect(), "a", nobody.Events());
  hopeless.Want(hash);  // ends while it tries
}

std::vector<Place> Places() {
  std::vector<Place> places;
  for (int n = 0; n < 400; ++n) {
    places.push_back({-1100.0 + 5.51 * n, 1050.0 - 71.3 * (n % 31)});
  }
  return places;
}

// What games see is what the server answers, over terrain and at high water: to the last bit.
TEST(SeaOverTerrain, IsTheSameHereAndAtTheServer) {
  TestServer server(Transport::kLoopback);
  server.Create(HarbourSession("a"));
  const auto joined = Join(absl::StrCat("127.0.0.1:", server.port()), {.session = "a"});
  ASSERT_TRUE(joined.ok()) << joined.status();
  const Sea& sea = **joined;
  wire::QueryRequest request;
  request.session = "a";
  request.detail = sea::QueryDetail::kVelocity;
  const std::vector<Place> places = Places();
  for (const Place& place : places) request.points_m.push_back({place.x_m, place.y_m});
  for (const double time_s : {-30.0, 300.0, 12345.5}) {
    request.time_s = time_s;
    const wire::QueryAnswer answer = server.Remote()->QueryPoints(request).value();
    EXPECT_EQ(answer.layers, sea::kLayerSpectral | sea::kLayerTerrain | sea::kLayerWaterLevel);
    std::vector<Water> water(places.size());
    ASSERT_TRUE(sea.Sample(places, time_s, Detail::kVelocity, water).ok());
    std::vector<std::int32_t> dry;
    for (std::size_t n = 0; n < places.size(); ++n) {
      ASSERT_EQ(static_cast<float>(water[n].height_m), answer.height_m[n]) << n;
      EXPECT_EQ(sea.HeightAt(places[n].x_m, places[n].y_m, time_s), water[n].height_m) << n;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        ASSERT_EQ(static_cast<float>(water[n].normal[axis]), answer.normal[3 * n + axis]);
        ASSERT_EQ(static_cast<float>(water[n].velocity_m_per_s[axis]),
                  answer.velocity_m_per_s[3 * n + axis]);
      }
      if (water[n].dry) dry.push_back(static_cast<std::int32_t>(n));
    }
    EXPECT_EQ(dry, answer.dry_indices);
    EXPECT_GT(dry.size(), 20u);
  }
  // The server's probes agree too, once a second.
  EXPECT_TRUE(Eventually([&] { return sea.drift().comparisons > 0; }));
  EXPECT_EQ(sea.drift().worst_m, 0.0);
}

TEST(SeaOverTerrain, DepthAnswersAreTheSameAndLandHasNone) {
  TestServer server(Transport::kLoopback);
  server.Create(HarbourSession("a"));
  const auto joined = Join(absl::StrCat("127.0.0.1:", server.port()), {.session = "a"});
  ASSERT_TRUE(joined.ok()) << joined.status();
  // Before the mouth, in the basin, on the island.
  const std::vector<Place> places = {{300, -400}, {0, -100}, {230, 430}};
  const std::vector<double> depths = {2.0, 1.0, 0.5};
  wire::QueryRequest request;
  request.session = "a";
  request.time_s = 100.0;
  request.depth_m = depths;
  for (const Place& place : places) request.points_m.push_back({place.x_m, place.y_m});
  const wire::QueryAnswer answer = server.Remote()->QueryPoints(request).value();
  std::vector<Underwater> here(places.size());
  ASSERT_TRUE((*joined)->SampleAtDepth(places, depths, 100.0, here).ok());
  for (std::size_t n = 0; n < places.size(); ++n) {
    EXPECT_EQ(static_cast<float>(here[n].dynamic_pressure_pa), answer.dynamic_pressure_pa[n]);
    EXPECT_EQ(here[n].dry, n == 2);
  }
  EXPECT_EQ(answer.dry_indices, std::vector<std::int32_t>{2});
  EXPECT_EQ(here[2].dynamic_pressure_pa, 0.0);
  EXPECT_NE(here[1].dynamic_pressure_pa, 0.0);
}

// Until the terrain is there a local sea is the open one and knows it.
TEST(SeaOverTerrain, IsIncompleteUntilTheTerrainHasCome) {
  TestServer server(Transport::kInProcess);
  server.Create(HarbourSession("a"));
  Recorder recorder;
  client::SessionClientOptions options;
  options.session = "a";
  client::SessionClient link(server.Connect(), options, recorder);
  ASSERT_TRUE(recorder.AwaitFrames(1));
  const wire::Welcome welcome = *recorder.frames().front().welcome;
  EXPECT_EQ(welcome.water_level.size(), 2u);
  const auto sea = client::LocalSea::Make(welcome).value();
  EXPECT_EQ(sea->missing_terrain(), welcome.session.terrain_hash);
  EXPECT_EQ(sea->terrain(), nullptr);
  const SimTime time = SimTime::FromSeconds(300.0);
  EXPECT_EQ(sea->WaterLevelAt(time), 0.5);
  const Vec2d island{230, 430};
  EXPECT_NE(sea->HeightAt(island, time), 0.5);
  EXPECT_EQ(sea->CompareProbes({}).status().code(), absl::StatusCode::kInvalidArgument);
  wire::ProbeHeights probes;
  probes.height_m.resize(welcome.session.probes_m.size());
  EXPECT_EQ(sea->CompareProbes(probes).status().code(), absl::StatusCode::kFailedPrecondition);
  auto terrain =
      std::make_shared<const sea::Terrain>(ingest::ReadTerrainFile(kHarbour, {}).value());
  sea->SetTerrain(terrain);
  EXPECT_EQ(sea->missing_terrain(), 0u);
  EXPECT_EQ(sea->terrain(), terrain);
  EXPECT_EQ(sea->HeightAt(island, time), 0.5);
  // A reconnection, a session without terrain, and back: it is kept.
  ASSERT_TRUE(sea->Follow(welcome).ok());
  EXPECT_EQ(sea->missing_terrain(), 0u);
  wire::Welcome open = welcome;
  open.session.terrain_hash = 0;
  ASSERT_TRUE(sea->Follow(open).ok());
  EXPECT_EQ(sea->terrain(), nullptr);
  EXPECT_NE(sea->HeightAt(island, time), 0.5);
  ASSERT_TRUE(sea->Follow(welcome).ok());
  EXPECT_EQ(sea->terrain(), terrain);
}

}  // namespace
}  // namespace onesea::e2e
