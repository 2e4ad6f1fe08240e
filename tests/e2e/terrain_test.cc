// A terrain on its way from a session to a joiner.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "client/net/terrain_fetcher.h"
#include "common/ingest/terrain_file.h"
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

}  // namespace
}  // namespace onesea::e2e
