#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/wire/tile_encoder.h"
#include "common/wire/tile_store.h"
#include "tests/sea/allocation_count.h"
#include "tests/wire/pool_scene.h"

namespace onesea::wire {
namespace {

using ::testing::HasSubstr;

RegionLayout Region(std::uint32_t id, std::int64_t west, std::int64_t south, int columns = 96,
                    int rows = 64) {
  return {.id = id,
          .cells = {.west = west, .south = south, .columns = columns, .rows = rows, .cell_m = 0.5}};
}

// Heights that are a function of the place in the world, so that regions may move.
std::vector<float> Waves(const sea::CellRect& cells, double t, double amplitude_m = 0.3) {
  std::vector<float> heights;
  for (std::int64_t j = cells.south; j < cells.north(); ++j) {
    for (std::int64_t i = cells.west; i < cells.east(); ++i) {
      heights.push_back(
          static_cast<float>(amplitude_m * std::sin(0.21 * static_cast<double>(i) - 2.0 * t) *
                             std::cos(0.13 * static_cast<double>(j) + t)));
    }
  }
  return heights;
}

double Worst(std::span<const float> a, std::span<const float> b) {
  EXPECT_EQ(a.size(), b.size());
  double worst = 0.0;
  for (std::size_t n = 0; n < std::min(a.size(), b.size()); ++n) {
    worst = std::max(worst, std::abs(static_cast<double>(a[n]) - b[n]));
  }
  return worst;
}

std::size_t BlobBytes(const TileUpdate& update) {
  std::size_t bytes = 0;
  for (const std::string& blob : update.blobs) bytes += blob.size();
  return bytes;
}

constexpr double kRounding = 2e-6;  // of floats, at heights of some metres

TEST(TileCodec, EveryHeightStaysWithinTheToleranceFrameAfterFrame) {
  for (const float steps : {0.5F, 1.0F, 3.0F}) {
    PoolScene scene(16);
    TileEncoder encoder({.height_steps = steps});
    TileStore store;
    for (int frame = 0; frame < 40; ++frame) {
      scene.Step();
      const TileField field = scene.field();
      ASSERT_TRUE(store.Apply(encoder.Encode({&field, 1}), frame == 0).ok());
      ASSERT_EQ(store.fields().size(), 1U);
      ASSERT_LE(Worst(store.fields()[0].height_m, field.height_m), 1e-3 * steps + kRounding);
    }
  }
}

TEST(TileCodec, CoarserStepsKeepTheirOwnBound) {
  PoolScene scene(4);
  TileEncoder encoder;
  TileStore store;
  for (int frame = 0; frame < 20; ++frame) {
    scene.Step();
    const TileField field = scene.field(4e-3);
    ASSERT_TRUE(store.Apply(encoder.Encode({&field, 1}), frame == 0).ok());
    ASSERT_LE(Worst(store.fields()[0].height_m, field.height_m), 4e-3 + kRounding);
  }
}

TEST(TileCodec, WakesPackThirtyfold) {
  PoolScene scene(4);
  TileEncoder encoder;
  std::size_t bytes = 0;
  constexpr int kFrames = 20;
  for (int frame = 0; frame <= kFrames; ++frame) {
    scene.Step();
    const TileField field = scene.field();
    const TileUpdate& update = encoder.Encode({&field, 1});
    if (frame > 0) bytes += BlobBytes(update);
  }
  EXPECT_LT(bytes, 4 * 256 * 256 * kFrames / 30);
  EXPECT_GT(bytes, 0U);
}

TEST(TileCodec, CalmWaterCostsNothingAndIsSaidOnce) {
  const RegionLayout region = Region(7, -64, -32);
  const std::vector<float> ripples(region.cells.cells(), 0.9e-3F);
  const std::vector<float> waves = Waves(region.cells, 0.0);
  TileEncoder encoder;
  const TileField calm{region, ripples, {}}, rough{region, waves, {}};
  EXPECT_TRUE(encoder.Encode({&calm, 1}).blobs.empty());
  TileStore store;
  ASSERT_TRUE(store.Apply(encoder.Keyframe(), true).ok());
  EXPECT_TRUE(encoder.Encode({&calm, 1}).blobs.empty());
  ASSERT_TRUE(store.Apply(encoder.Encode({&rough, 1}), false).ok());
  // Eight bytes for each of the 2 x 2 groups.
  const TileUpdate& calmed = encoder.Encode({&calm, 1});
  EXPECT_LE(BlobBytes(calmed), 4 * 8U);
  ASSERT_TRUE(store.Apply(calmed, false).ok());
  EXPECT_EQ(*std::max_element(store.fields()[0].height_m.begin(), store.fields()[0].height_m.end()),
            0.0F);
  EXPECT_TRUE(encoder.Encode({&calm, 1}).blobs.empty());
  EXPECT_TRUE(encoder.Keyframe().blobs.empty());
}

// Whoever missed frames and takes the keyframe then has the same bits as who missed nothing, and
// the keyframe disturbs nobody.
TEST(TileCodec, AKeyframeHealsEveryGap) {
  PoolScene scene(4);
  TileEncoder encoder;
  TileStore faithful, late;
  for (int frame = 0; frame < 30; ++frame) {
    scene.Step();
    const TileField field = scene.field();
    const TileUpdate& update = encoder.Encode({&field, 1});
    ASSERT_TRUE(faithful.Apply(update, frame == 0).ok());
    if (frame % 10 == 7) {
      ASSERT_TRUE(late.Apply(encoder.Keyframe(), true).ok());
    } else if (frame % 10 > 7 || (frame % 10 < 4 && frame >= 10)) {
      ASSERT_TRUE(late.Apply(update, false).ok());
    } else {
      continue;
    }
    EXPECT_EQ(late.fields()[0].height_m, faithful.fields()[0].height_m) << frame;
  }
}

TEST(TileCodec, AnUpdateWithoutItsPastIsRefused) {
  PoolScene scene(4);
  const TileField field = scene.field();
  TileEncoder encoder;
  TileStore store;
  EXPECT_FALSE(store.current());
  EXPECT_EQ(store.Apply(encoder.Encode({&field, 1}), false).code(),
            absl::StatusCode::kFailedPrecondition);
  EXPECT_FALSE(store.current());
  EXPECT_TRUE(store.Apply(encoder.Keyframe(), true).ok());
  EXPECT_TRUE(store.current());
}

TEST(TileCodec, RegionsMoveByAnyNumberOfCellsAndVanish) {
  TileEncoder encoder;
  TileStore store;
  std::vector<RegionLayout> regions = {Region(1, -40, -100, 128, 64), Region(2, 200, 7)};
  for (int frame = 0; frame < 60; ++frame) {
    const double t = 0.03 * frame;
    regions[0].cells.west -= frame % 3;
    regions[0].cells.south += frame % 5;
    if (frame == 20) regions[1].cells.west += 1000;
    if (frame == 30) regions.erase(regions.begin() + 1);
    if (frame == 40) regions.insert(regions.begin(), Region(3, -7, 3));
    if (frame == 50) regions[0] = Region(3, -7, 3, 64, 64);
    if (frame == 55) regions[1] = Region(1, regions[1].cells.west - 32, -32, 192, 128);
    std::vector<std::vector<float>> waves;
    std::vector<TileField> fields;
    for (const RegionLayout& region : regions) waves.push_back(Waves(region.cells, t));
    for (std::size_t n = 0; n < regions.size(); ++n) fields.push_back({regions[n], waves[n], {}});
    ASSERT_TRUE(store.Apply(encoder.Encode(fields), frame == 0).ok()) << frame;
    ASSERT_EQ(store.fields().size(), regions.size());
    for (std::size_t n = 0; n < regions.size(); ++n) {
      EXPECT_EQ(store.fields()[n].layout, regions[n]);
      ASSERT_LE(Worst(store.fields()[n].height_m, waves[n]), 1e-3 + kRounding) << frame;
    }
  }
}

// The server's regions grow when bodies part and shrink when they meet: what both have goes on.
TEST(TileCodec, ARegionThatGrowsKeepsItsTiles) {
  const RegionLayout small = Region(1, 0, 0, 128, 64), large = Region(1, -64, 0, 192, 128);
  TileEncoder encoder;
  std::vector<float> waves = Waves(small.cells, 0.0);
  const TileField first{small, waves, {}};
  encoder.Encode({&first, 1});
  std::vector<float> more(large.cells.cells());
  for (std::size_t row = 0; row < 64; ++row) {
    std::copy_n(waves.begin() + row * 128, 128, more.begin() + row * 192 + 64);
  }
  const TileField second{large, more, {}};
  const TileUpdate& update = encoder.Encode({&second, 1});
  EXPECT_TRUE(update.layout.has_value());
  EXPECT_TRUE(update.blobs.empty());
}

TEST(TileCodec, AnAbsentSpanLeavesTheRegionAsItWasSent) {
  const RegionLayout region = Region(1, 0, 0);
  const std::vector<float> waves = Waves(region.cells, 0.0);
  TileEncoder encoder;
  TileStore store;
  const TileField offered{region, waves, {}}, skipped{region, {}, {}};
  ASSERT_TRUE(store.Apply(encoder.Encode({&offered, 1}), true).ok());
  const TileUpdate& update = encoder.Encode({&skipped, 1});
  EXPECT_TRUE(update.blobs.empty());
  EXPECT_FALSE(update.layout.has_value());
  ASSERT_TRUE(store.Apply(update, false).ok());
  EXPECT_LE(Worst(store.fields()[0].height_m, waves), 1e-3);
}

TEST(TileCodec, FoamIsKeptWithinTwoLevels) {
  const RegionLayout region = Region(1, 0, 0);
  TileEncoder encoder;
  TileStore store;
  for (int frame = 0; frame < 30; ++frame) {
    std::vector<float> foam = Waves(region.cells, 0.1 * frame, 1.0);
    const float fade = frame < 20 ? 1.0F : 0.0F;
    for (float& share : foam) share = fade * std::clamp(share, 0.0F, 1.0F);
    const TileField field{region, {}, foam};
    ASSERT_TRUE(store.Apply(encoder.Encode({&field, 1}), frame == 0).ok());
    ASSERT_LE(Worst(store.fields()[0].foam, foam), 2.0 / 255.0 + 1e-6);
  }
  EXPECT_TRUE(encoder.Keyframe().blobs.empty());
}

TEST(TileCodec, HeightsBeyondTheRangeSaturate) {
  const RegionLayout region = Region(1, 0, 0);
  TileEncoder encoder;
  TileStore store;
  for (int frame = 0; frame < 6; ++frame) {
    const float height_m = frame % 2 == 0 ? 100.0F : -1e30F;
    const std::vector<float> heights(region.cells.cells(), height_m);
    const TileField field{region, heights, {}};
    ASSERT_TRUE(store.Apply(encoder.Encode({&field, 1}), frame == 0).ok());
    for (const float height : store.fields()[0].height_m) {
      ASSERT_NEAR(height, frame % 2 == 0 ? 32.767 : -32.767, 1e-5);
    }
  }
}

TEST(TileCodec, TheEncoderAllocatesNothingOnceWarm) {
  PoolScene scene(4);
  TileEncoder encoder;
  RegionLayout moving = Region(2, 0, 0);
  const std::vector<float> waves = Waves(moving.cells, 0.0);
  const auto encode = [&] {
    moving.cells.west += 1;
    const TileField fields[] = {scene.field(), {moving, waves, waves}};
    encoder.Encode(fields);
  };
  for (int frame = 0; frame < 3; ++frame) encode();
  scene.Step();
  const std::int64_t before = AllocationCount();
  for (int frame = 0; frame < 5; ++frame) encode();
  EXPECT_EQ(AllocationCount(), before);
}

TEST(TileCodec, LayoutsOutOfTheirLimitsAreRefused) {
  const auto refused = [](std::vector<RegionLayout> layout, const std::string& words) {
    TileStore store;
    const absl::Status status = store.Apply({.layout = std::move(layout), .blobs = {}}, true);
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
    EXPECT_THAT(std::string(status.message()), HasSubstr(words));
  };
  const RegionLayout good = Region(1, 0, 0);
  refused({good, good}, "is also that of regions[0]");
  refused(std::vector<RegionLayout>(kRegionsMax + 1, good), "the limit is 16");
  const auto with = [&](auto change) {
    RegionLayout layout = good;
    change(layout);
    return std::vector<RegionLayout>{layout};
  };
  refused(with([](auto& r) { r.id = 0; }), "id");
  refused(with([](auto& r) { r.cells.columns = 65; }), "multiple of 32");
  refused(with([](auto& r) { r.cells.rows = -64; }), "rows");
  refused(with([](auto& r) { r.cells.rows = 1 << 20; }), "rows");
  refused(with([](auto& r) { r.cells.west = std::numeric_limits<std::int64_t>::max(); }), "west");
  refused(with([](auto& r) { r.cells.cell_m = std::nan(""); }), "cell_m");
  refused(with([](auto& r) { r.height_step_m = 0.0; }), "height_step_m");
  std::vector<RegionLayout> huge;
  for (std::uint32_t id = 1; id <= 5; ++id) huge.push_back(Region(id, 0, 0, 1024, 1024));
  refused(huge, "regions cells: 5242880");
}

TEST(TileCodec, BlobsThatNoEncoderWritesAreRefused) {
  PoolScene scene(4);
  const TileField field = scene.field();
  TileEncoder encoder;
  const TileUpdate update = encoder.Encode({&field, 1});
  ASSERT_FALSE(update.blobs.empty());
  const std::string good = update.blobs[0];
  const auto refused = [&](const std::string& blob, const std::string& words) {
    TileStore store;
    const absl::Status status = store.Apply({.layout = update.layout, .blobs = {blob}}, true);
    EXPECT_THAT(std::string(status.message()), HasSubstr(words));
    EXPECT_FALSE(store.current());
  };
  refused("", "ends within its header");
  refused(std::string(1, '\x02') + good.substr(1), "no region 2");
  refused(std::string(1, '\0') + good.substr(1), "no such region id");
  refused(std::string("\x01\x7e\x7e\x00\x01", 5), "outside of region");
  refused(good + "x", "exactly one zstd frame");
  refused(good.substr(0, good.size() - 1), "");
  // A bomb: a frame whose content is a megabyte.
  std::string bomb("\x01\x00\x00\x01\x00\x00", 6);
  Packer(1).Append(std::vector<std::uint8_t>(1 << 20), bomb);
  refused(bomb, "content size 1048576, 2048 is due");
}

}  // namespace
}  // namespace onesea::wire
