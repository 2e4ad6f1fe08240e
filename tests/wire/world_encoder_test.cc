#include "common/wire/world_encoder.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/limits.h"
#include "common/wire/tile_store.h"

namespace onesea::wire {
namespace {

sea::CellRect Rect(std::int64_t west, std::int64_t south, int columns = 96, int rows = 64,
                   double cell_m = 0.5) {
  return {.west = west, .south = south, .columns = columns, .rows = rows, .cell_m = cell_m};
}

// Heights that are a function of the place and of time.
std::shared_ptr<const sea::InteractionField> Field(const sea::CellRect& cells, double t) {
  auto field = std::make_shared<sea::InteractionField>();
  field->cells = cells;
  for (std::int64_t j = cells.south; j < cells.north(); ++j) {
    for (std::int64_t i = cells.west; i < cells.east(); ++i) {
      const Vec2d place = cells.PlaceOf(i, j);
      field->height_m.push_back(
          static_cast<float>(0.2 * std::sin(0.5 * place.x - 2.0 * t) * std::cos(0.3 * place.y)));
    }
  }
  return field;
}

WorldUpdate Encode(WorldEncoder& encoder, const std::vector<sea::CellRect>& rects, Tick tick,
                   const std::vector<RegionStreaming>& streaming = {}) {
  sea::InteractionSnapshot snapshot;
  snapshot.tick = tick;
  for (const sea::CellRect& rect : rects) {
    snapshot.fields.push_back(Field(rect, static_cast<double>(tick) / 60.0));
  }
  WorldState state;
  state.tick = tick;
  state.interaction = &snapshot;
  state.streaming = streaming;
  return encoder.Encode(state);
}

std::vector<std::uint32_t> Ids(const WorldUpdate& update) {
  std::vector<std::uint32_t> ids;
  for (const RegionLayout& region : update.tiles.layout.value()) ids.push_back(region.id);
  return ids;
}

using IdList = std::vector<std::uint32_t>;

TEST(WorldEncoder, ARegionKeepsItsIdWhileItMovesAndGrows) {
  WorldEncoder encoder(1.0 / 60.0);
  EXPECT_EQ(Ids(Encode(encoder, {Rect(0, 0), Rect(320, 0)}, 0)), (IdList{1, 2}));
  EXPECT_FALSE(Encode(encoder, {Rect(0, 0), Rect(320, 0)}, 2).tiles.layout.has_value());
  EXPECT_EQ(Ids(Encode(encoder, {Rect(32, 0), Rect(320, 0)}, 4)), (IdList{1, 2}));
  // Another comes before them, and the second one grows.
  EXPECT_EQ(Ids(Encode(encoder, {Rect(0, 640), Rect(32, 0), Rect(256, 0, 160, 128)}, 6)),
            (IdList{3, 1, 2}));
  // Two merge: the larger share goes on. A jump is a new region.
  EXPECT_EQ(Ids(Encode(encoder, {Rect(0, 9600), Rect(32, 0, 384, 128)}, 8)), (IdList{4, 2}));
  EXPECT_EQ(Ids(Encode(encoder, {}, 10)), IdList{});
  EXPECT_EQ(Ids(Encode(encoder, {Rect(32, 0, 384, 128)}, 12)), (IdList{5}));
}

TEST(WorldEncoder, ReceiversHaveEveryFieldThroughMovesAndMerges) {
  WorldEncoder encoder(1.0 / 60.0);
  TileStore store;
  for (Tick tick = 0; tick < 80; tick += 2) {
    std::vector<sea::CellRect> rects = {Rect(32 * (tick / 10), 0)};
    if (tick < 40) rects.push_back(Rect(320, 32 * (tick / 8)));
    if (tick >= 40) rects[0] = Rect(32 * (tick / 10), -64, 192, 128);
    const WorldUpdate update = Encode(encoder, rects, tick);
    ASSERT_TRUE(store.Apply(update.tiles, tick == 0).ok());
    ASSERT_EQ(store.fields().size(), rects.size());
    for (std::size_t n = 0; n < rects.size(); ++n) {
      const auto truth = Field(rects[n], static_cast<double>(tick) / 60.0);
      ASSERT_EQ(store.fields()[n].layout.cells, rects[n]);
      for (std::size_t cell = 0; cell < truth->height_m.size(); ++cell) {
        ASSERT_NEAR(store.fields()[n].height_m[cell], truth->height_m[cell], 1.001e-3) << tick;
      }
    }
  }
}

TEST(WorldEncoder, EachRegionComesInItsStepsAndAtItsRate) {
  WorldEncoder encoder(1.0 / 60.0);
  TileStore store;
  const std::vector<sea::CellRect> rects = {Rect(0, 0, 64, 64), Rect(320, 0, 64, 64)};
  const std::vector<RegionStreaming> streaming = {{},
                                                  {.height_step_m = 0.02, .frames_per_update = 5}};
  std::vector<float> before;
  int updates = 0;
  double worst = 0.0;
  for (Tick tick = 0; tick < 100; tick += 2) {
    const WorldUpdate update = Encode(encoder, rects, tick, streaming);
    if (tick == 0) {
      EXPECT_EQ(update.tiles.layout->at(0).height_step_m, 1e-3);
      EXPECT_EQ(update.tiles.layout->at(1).height_step_m, 0.02);
    }
    ASSERT_TRUE(store.Apply(update.tiles, tick == 0).ok());
    const std::vector<float>& held = store.fields()[1].height_m;
    if (held == before) continue;
    before = held;
    ++updates;
    const auto truth = Field(rects[1], static_cast<double>(tick) / 60.0);
    for (std::size_t n = 0; n < held.size(); ++n) {
      worst = std::max(worst, static_cast<double>(std::abs(held[n] - truth->height_m[n])));
    }
  }
  EXPECT_GE(updates, 9);
  EXPECT_LE(updates, 11);
  EXPECT_LE(worst, 0.02 * 1.001);
  EXPECT_GT(worst, 0.002);  // it is used
}

TEST(WorldEncoder, WaterLevelIsToldWhenItChangesAndInKeyframes) {
  WorldEncoder encoder(1.0 / 60.0);
  WorldState state;
  state.water_level_m = 0.5;
  EXPECT_EQ(encoder.Encode(state).water_level_m, 0.5);
  EXPECT_FALSE(encoder.Encode(state).water_level_m.has_value());
  EXPECT_EQ(encoder.Keyframe().water_level_m, 0.5);
  state.water_level_m = 0.75;
  EXPECT_EQ(encoder.Encode(state).water_level_m, 0.75);
}

TEST(WorldEncoder, RopesAreToldWhenTheyChangeAndInKeyframes) {
  WorldEncoder encoder(1.0 / 60.0);
  WorldState state;
  EXPECT_EQ(encoder.Encode(state).ropes, nullptr);
  EXPECT_EQ(encoder.Keyframe().ropes, nullptr);
  const auto list =
      std::make_shared<const std::vector<TiedRope>>(std::vector<TiedRope>{{3, {{1, {}}, {2, {}}}}});
  state.ropes = list;
  EXPECT_EQ(encoder.Encode(state).ropes, list);
  EXPECT_EQ(encoder.Encode(state).ropes, nullptr);
  EXPECT_EQ(encoder.Keyframe().ropes, list);
  state.ropes = nullptr;
  const RopeList none = encoder.Encode(state).ropes;
  ASSERT_NE(none, nullptr);
  EXPECT_TRUE(none->empty());
  EXPECT_EQ(encoder.Encode(state).ropes, nullptr);
  EXPECT_EQ(encoder.Keyframe().ropes, nullptr);
}

TEST(WorldEncoder, SprayIsBoundedAndNotInKeyframes) {
  WorldEncoder encoder(1.0 / 60.0);
  const std::vector<Spray> spray(kSprayMax + 10);
  WorldState state;
  state.spray = spray;
  EXPECT_EQ(encoder.Encode(state).spray.size(), static_cast<std::size_t>(kSprayMax));
  EXPECT_TRUE(encoder.Keyframe().spray.empty());
}

}  // namespace
}  // namespace onesea::wire
