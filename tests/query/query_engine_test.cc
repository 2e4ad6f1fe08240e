#include "server/query/query_engine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>

#include "common/base/limits.h"
#include "common/wire/bounds.h"
#include "tests/shared/small_sea.h"

namespace onesea::server {
namespace {

using ::testing::HasSubstr;
using wire::QueryAnswer;
using wire::QueryRequest;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class QueryEngineTest : public ::testing::Test {
 protected:
  std::shared_ptr<const sea::Components> components = BuildOrDie(SmallSession().recipe);
  QueryEngine engine;
};

QueryRequest At(std::vector<Vec2d> points_m) {
  QueryRequest request;
  request.id = 77;
  request.points_m = std::move(points_m);
  return request;
}

// The exact surface above `point`: the undisplaced point that the direct sum carries there.
sea::DirectSample Exact(const sea::Components& components, SimTime time, Vec2d point) {
  Vec2d source = point;
  sea::DirectSample sample;
  for (int iteration = 0; iteration < 60; ++iteration) {
    sample = sea::SumDirectly(components, time, source);
    source = {point.x - sample.displacement_x_m, point.y - sample.displacement_y_m};
  }
  return sample;
}

TEST_F(QueryEngineTest, AgreesWithTheDirectSum) {
  std::vector<Vec2d> points;
  for (int n = 0; n < 40; ++n) points.push_back({17.3 * n - 300.0, 1000.0 - 41.9 * n});
  QueryRequest request = At(points);
  request.time_s = 1234.5;
  request.detail = sea::QueryDetail::kVelocity;
  const absl::StatusOr<QueryAnswer> answer = engine.Answer(components, 0, request);
  ASSERT_TRUE(answer.ok()) << answer.status();
  EXPECT_EQ(answer->id, 77);
  EXPECT_EQ(answer->time_s, 1234.5);
  EXPECT_EQ(answer->layers, sea::kLayerSpectral);
  ASSERT_EQ(answer->height_m.size(), points.size());
  ASSERT_EQ(answer->normal.size(), 3 * points.size());
  ASSERT_EQ(answer->velocity_m_per_s.size(), 3 * points.size());
  constexpr double kToleranceM = 0.0015;
  for (std::size_t n = 0; n < points.size(); ++n) {
    const sea::DirectSample exact = Exact(*components, SimTime::FromSeconds(1234.5), points[n]);
    EXPECT_NEAR(static_cast<double>(answer->height_m[n]), exact.height_m, kToleranceM) << n;
    EXPECT_NEAR(static_cast<double>(answer->height_m[n]), exact.height_m,
                answer->height_error_bound_m);
    EXPECT_NEAR(static_cast<double>(answer->velocity_m_per_s[3 * n + 2]), exact.velocity_m_per_s.z,
                0.002)
        << n;
    const float* normal = &answer->normal[3 * n];
    EXPECT_NEAR(std::hypot(normal[0], normal[1], normal[2]), 1.0f, 1e-5f);
  }
}

TEST_F(QueryEngineTest, NowIsTheTickGivenAndTimeWins) {
  const QueryRequest request = At({{5.0, 6.0}});
  const QueryAnswer now = *engine.Answer(components, 600, request);
  EXPECT_EQ(now.time_s, 10.0);
  QueryRequest timed = request;
  timed.time_s = 10.0;
  EXPECT_EQ(engine.Answer(components, 0, timed)->height_m, now.height_m);
  QueryRequest ticked = request;
  ticked.tick = 600;
  EXPECT_EQ(engine.Answer(components, 0, ticked)->height_m, now.height_m);
  EXPECT_NE(engine.Answer(components, 0, request)->height_m, now.height_m);
}

TEST_F(QueryEngineTest, DepthAnswersAreTheDirectSumAndDryPointsAreListed) {
  const std::vector<Vec2d> points = {{0.0, 0.0}, {10.0, 0.0}, {20.0, 0.0}, {30.0, 0.0}};
  QueryRequest request = At(points);
  request.depth_m = {5.0, 0.0, 0.0, 20.0};
  const QueryAnswer answer = *engine.Answer(components, 0, request);
  ASSERT_EQ(answer.dynamic_pressure_pa.size(), 4u);
  std::vector<std::int32_t> dry;
  for (int n = 0; n < 4; ++n) {
    if (-request.depth_m[static_cast<std::size_t>(n)] >
        static_cast<double>(answer.height_m[static_cast<std::size_t>(n)])) {
      dry.push_back(n);
    }
  }
  EXPECT_EQ(answer.dry_indices, dry);
  std::vector<sea::DepthSample> direct(4);
  sea::SampleAtDepth(*components, SimTime{}, points, request.depth_m, direct);
  for (const std::size_t n : {0u, 3u}) {
    EXPECT_FLOAT_EQ(answer.dynamic_pressure_pa[n],
                    static_cast<float>(direct[n].dynamic_pressure_pa));
    EXPECT_FLOAT_EQ(answer.depth_velocity_m_per_s[3 * n + 2],
                    static_cast<float>(direct[n].velocity_m_per_s.z));
  }
  for (std::int32_t n : dry) EXPECT_EQ(answer.dynamic_pressure_pa[static_cast<std::size_t>(n)], 0);
}

TEST_F(QueryEngineTest, DrynessNeedsAPointAboveTheSurface) {
  QueryRequest request = At({});
  for (int n = 0; n < 100; ++n) request.points_m.push_back({3.0 * n, 0.0});
  request.depth_m.assign(100, 0.0);
  const QueryAnswer answer = *engine.Answer(components, 0, request);
  // At the mean level about half of a Gaussian sea is above it.
  EXPECT_GT(answer.dry_indices.size(), 20u);
  EXPECT_LT(answer.dry_indices.size(), 80u);
  for (std::int32_t n : answer.dry_indices) {
    EXPECT_LT(answer.height_m[static_cast<std::size_t>(n)], 0.0f);
  }
}

TEST_F(QueryEngineTest, OneInstantIsSynthesisedOnce) {
  for (int n = 0; n < 10; ++n) ASSERT_TRUE(engine.Answer(components, 5, At({{1.0, 2.0}})).ok());
  EXPECT_EQ(engine.snapshots_built(), 1);
  QueryRequest more = At({{1.0, 2.0}});
  more.detail = sea::QueryDetail::kVelocity;
  ASSERT_TRUE(engine.Answer(components, 5, more).ok());
  EXPECT_EQ(engine.snapshots_built(), 2);
  more.detail = sea::QueryDetail::kNormal;  // served by the snapshot with velocities
  ASSERT_TRUE(engine.Answer(components, 5, more).ok());
  EXPECT_EQ(engine.snapshots_built(), 2);
}

TEST_F(QueryEngineTest, APreparedTickIsAnsweredWithoutASynthesis) {
  const QueryAnswer unprepared = *engine.Answer(components, 601, At({{5.0, 6.0}}));
  QueryEngine other;
  other.SnapshotOf(components, 601);
  EXPECT_EQ(other.snapshots_built(), 1);
  EXPECT_EQ(other.Answer(components, 601, At({{5.0, 6.0}}))->height_m, unprepared.height_m);
  EXPECT_EQ(other.snapshots_built(), 1);
}

TEST_F(QueryEngineTest, GuessesTheNextTickFromTheLastStride) {
  EXPECT_EQ(engine.NoteAsked(100), std::nullopt);  // nothing is known of the asker
  EXPECT_EQ(engine.NoteAsked(100), std::nullopt);
  EXPECT_EQ(engine.NoteAsked(101), 102);
  EXPECT_EQ(engine.NoteAsked(101), std::nullopt);  // said already
  EXPECT_EQ(engine.NoteAsked(100), std::nullopt);  // a late one
  EXPECT_EQ(engine.NoteAsked(104), 107);
  EXPECT_EQ(engine.NoteAsked(104 + QueryEngine::kStrideMax), 104 + 2 * QueryEngine::kStrideMax);
  EXPECT_EQ(engine.NoteAsked(1000), std::nullopt);  // too slow to be waited for
  EXPECT_EQ(engine.NoteAsked(1001), 1002);
}

TEST_F(QueryEngineTest, KeepsAFewInstants) {
  for (int round = 0; round < 3; ++round) {
    for (Tick tick = 0; tick < 4; ++tick) {
      ASSERT_TRUE(engine.Answer(components, tick, At({{0.0, 0.0}})).ok());
    }
  }
  EXPECT_EQ(engine.snapshots_built(), 4);
  for (Tick tick = 100; tick < 120; ++tick) {
    ASSERT_TRUE(engine.Answer(components, tick, At({{0.0, 0.0}})).ok());
  }
  EXPECT_EQ(engine.snapshots_built(), 24);
}

// An evicted snapshot's storage is used again; one that is still being read is not.
TEST_F(QueryEngineTest, RecycledStorageGivesTheSameAnswers) {
  const std::vector<float> first = engine.Answer(components, 1, At({{7.0, 8.0}}))->height_m;
  for (Tick tick = 100; tick < 120; ++tick) {
    ASSERT_TRUE(engine.Answer(components, tick, At({{0.0, 0.0}})).ok());
  }
  EXPECT_EQ(engine.Answer(components, 1, At({{7.0, 8.0}}))->height_m, first);
}

TEST_F(QueryEngineTest, ThreadsShareOneSynthesisAndAgree) {
  std::vector<std::vector<float>> heights(4);
  std::vector<std::thread> threads;
  for (std::vector<float>& mine : heights) {
    threads.emplace_back([&] {
      for (Tick tick = 0; tick < 30; ++tick) {
        const QueryAnswer answer = *engine.Answer(components, tick, At({{1.0, 2.0}, {9.0, 9.0}}));
        mine.insert(mine.end(), answer.height_m.begin(), answer.height_m.end());
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::vector<float>& mine : heights) EXPECT_EQ(mine, heights[0]);
  EXPECT_LE(engine.snapshots_built(), 120);
}

TEST_F(QueryEngineTest, FollowsAChangeOfComponents) {
  const std::vector<float> before = engine.Answer(components, 5, At({{1.0, 2.0}}))->height_m;
  sea::Recipe recipe = components->recipe;
  recipe.seed = 2;
  const auto other = BuildOrDie(recipe);
  EXPECT_NE(engine.Answer(other, 5, At({{1.0, 2.0}}))->height_m, before);
  EXPECT_EQ(engine.Answer(components, 5, At({{1.0, 2.0}}))->height_m, before);
}

struct BadQuery {
  const char* message;
  void (*spoil)(QueryRequest&);
};

TEST_F(QueryEngineTest, NamesWhatIsBad) {
  const BadQuery cases[] = {
      {"x_m: 0 elements", [](QueryRequest& q) { q.points_m.clear(); }},
      {"x_m: 1000000 elements, the limit is 100000",
       [](QueryRequest& q) { q.points_m.resize(1'000'000); }},
      {"x_m[1]: nan", [](QueryRequest& q) { q.points_m[1].x = kNan; }},
      {"y_m[0]: inf is outside [-1e+07, 1e+07]",
       [](QueryRequest& q) { q.points_m[0].y = std::numeric_limits<double>::infinity(); }},
      {"x_m[0]: 1.1e+07", [](QueryRequest& q) { q.points_m[0].x = 1.1e7; }},
      {"time_s: nan", [](QueryRequest& q) { q.time_s = kNan; }},
      {"time_s: -4e+09", [](QueryRequest& q) { q.time_s = -4e9; }},
      {"tick: 9223372036854775807",
       [](QueryRequest& q) { q.tick = std::numeric_limits<Tick>::max(); }},
      {"tick: -9223372036854775808",
       [](QueryRequest& q) { q.tick = std::numeric_limits<Tick>::min(); }},
      {"depth_m: 1 elements for 2 points", [](QueryRequest& q) { q.depth_m = {1.0}; }},
      {"depth_m[1]: -0.5 is outside [0, 12000]",
       [](QueryRequest& q) {
         q.depth_m = {1.0, -0.5};
       }},
      {"depth_m[0]: nan",
       [](QueryRequest& q) {
         q.depth_m = {kNan, 0.0};
       }},
  };
  for (const BadQuery& bad : cases) {
    QueryRequest request = At({{0.0, 0.0}, {1.0, 1.0}});
    bad.spoil(request);
    const absl::Status status = engine.Answer(components, 0, request).status();
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << bad.message;
    EXPECT_THAT(std::string(status.message()), HasSubstr(bad.message));
  }
}

TEST(QueryEngine, RefusesPointsBelowTheBottom) {
  SessionSpec spec = SmallSession();
  spec.recipe.depth_m = 10.0;
  QueryRequest request = At({{0.0, 0.0}});
  request.depth_m = {10.5};
  EXPECT_THAT(std::string(ValidateQuery(request, spec.recipe).message()),
              HasSubstr("depth_m[0]: 10.5 is outside [0, 10]"));
  request.depth_m = {10.0};
  EXPECT_TRUE(ValidateQuery(request, spec.recipe).ok());
}

TEST_F(QueryEngineTest, TheLayerIsInAnswersAboutTheLastSeconds) {
  const auto flat = [](Tick tick, float height_m) {
    auto field = std::make_shared<sea::InteractionField>();
    field->cells = {.west = -32, .south = -32, .columns = 64, .rows = 64, .cell_m = 0.5};
    field->height_m.assign(64 * 64, height_m);
    auto snapshot = std::make_shared<sea::InteractionSnapshot>();
    snapshot->tick = tick;
    snapshot->fields = {field};
    return snapshot;
  };
  const sea::InteractionPast past = {flat(100, 1.0f), flat(106, 1.0f)};
  const auto present = flat(110, 2.0f);
  const auto ask = [&](std::optional<Tick> tick, bool with_layer) {
    QueryRequest request = At({{3.25, 1.5}});
    request.tick = tick;
    const auto answer =
        engine.Answer(components, 110, request,
                      {.interaction = with_layer ? present.get() : nullptr, .past = &past});
    EXPECT_TRUE(answer.ok()) << answer.status();
    return *answer;
  };
  const auto layer_at = [&](Tick tick) {
    return ask(tick, true).height_m[0] - ask(tick, false).height_m[0];
  };
  constexpr std::uint32_t kBoth = sea::kLayerSpectral | sea::kLayerInteraction;
  EXPECT_EQ(ask(std::nullopt, true).layers, kBoth);
  EXPECT_EQ(ask(100, true).layers, kBoth);
  EXPECT_NEAR(layer_at(103), 1.0, 1e-6);
  EXPECT_NEAR(layer_at(108), 1.5, 1e-6);
  EXPECT_NEAR(layer_at(110), 2.0, 1e-6);
  for (const Tick tick : {99, 111}) {
    EXPECT_EQ(ask(tick, true).layers, sea::kLayerSpectral) << tick;
    EXPECT_EQ(layer_at(tick), 0.0f);
  }
}

}  // namespace
}  // namespace onesea::server
