// Cut, mutated and random bytes without a fuzzer: the same in every run.
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "common/wire/frame.h"
#include "common/wire/tile_encoder.h"
#include "tests/fuzz/wire_input.h"

namespace onesea::fuzz {
namespace {

wire::BodyView Boat(std::uint32_t id) {
  wire::BodyView boat;
  boat.state.id = id;
  boat.state.position_m = {1000.0 * id, -3.5, 0.25};
  boat.state.velocity_m_per_s = {1.0, -2.0, 0.5};
  wire::BodyInfo info;
  info.id = id;
  info.name = "boat";
  boat.info = std::make_shared<const wire::BodyInfo>(info);
  return boat;
}

std::vector<std::string> Corpus() {
  std::vector<std::string> corpus;
  wire::TileEncoder tiles;
  wire::BodyEncoder bodies(1.0 / 60.0);
  const wire::RegionLayout region = {
      .id = 1, .cells = {.west = -32, .south = -32, .columns = 96, .rows = 64, .cell_m = 0.5}};
  std::vector<float> values(region.cells.cells());
  for (std::size_t frame = 0; frame < 3; ++frame) {
    for (std::size_t n = 0; n < values.size(); ++n) {
      values[n] = 0.1F * static_cast<float>((n * 2654435761U >> (7 + frame)) % 10);
    }
    const wire::TileField field{region, values, values};
    wire::Frame whole;
    whole.world.emplace();
    whole.world->tiles = tiles.Encode({&field, 1});
    whole.world->bodies =
        bodies.Encode(static_cast<Tick>(frame) * 60, std::vector{Boat(2), Boat(700)});
    whole.world->spray.resize(2);
    whole.world->ropes = std::make_shared<const std::vector<wire::TiedRope>>(
        std::vector<wire::TiedRope>{{3, {{2, {}}, {700, {}}}}, {4, {{2, {}}, {0, {1, 2, 3}}}}});
    for (const std::string& blob : whole.world->tiles.blobs) {
      corpus.push_back(std::string(1, '\0') + blob);
    }
    corpus.push_back(std::string(1, '\1') + whole.world->bodies.states);
    corpus.push_back(std::string(1, '\2') + wire::EncodeFrame(whole));
  }
  return corpus;
}

TEST(WireReplay, EveryCutIsSurvived) {
  for (const std::string& whole : Corpus()) {
    const std::size_t stride = 1 + whole.size() / 200;
    for (std::size_t size = 0; size < whole.size(); size += stride) {
      DecodeAndCheck(std::string_view(whole).substr(0, size));
    }
  }
}

TEST(WireReplay, MutationsAreSurvived) {
  std::mt19937_64 random(20261122);
  const std::vector<std::string> corpus = Corpus();
  for (int trial = 0; trial < 5'000; ++trial) {
    std::string bytes = corpus[random() % corpus.size()];
    for (std::uint64_t edits = 1 + random() % 4; edits > 0; --edits) {
      // Most of what can go wrong is decided by the first bytes.
      const std::size_t range =
          random() % 2 == 0 ? std::min<std::size_t>(bytes.size(), 40) : bytes.size();
      const std::size_t at = 1 + random() % (range - 1);
      bytes[at] = static_cast<char>(random() % 3 == 0 ? random() : bytes[at] ^ (1 << random() % 8));
    }
    DecodeAndCheck(bytes);
  }
}

TEST(WireReplay, RandomBytesAreSurvived) {
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 5'000; ++trial) {
    std::string bytes(1 + random() % 60, '\0');
    for (std::size_t n = 1; n < bytes.size(); ++n) bytes[n] = static_cast<char>(random());
    bytes[0] = static_cast<char>(random() % 3);
    DecodeAndCheck(bytes);
  }
}

}  // namespace
}  // namespace onesea::fuzz
