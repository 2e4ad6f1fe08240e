#include "tests/fuzz/wire_input.h"

#include <cmath>
#include <vector>

#include "common/base/check.h"
#include "common/wire/terrain_codec.h"
#include "common/wire/tile_encoder.h"
#include "common/wire/tile_store.h"

namespace onesea::fuzz {
namespace {

constexpr wire::RegionLayout kRegion = {
    .id = 1, .cells = {.west = -32, .south = -32, .columns = 96, .rows = 64, .cell_m = 0.5}};

// Two frames of a sea, so that every prediction has what it needs.
const std::vector<wire::TileUpdate>& FirstFrames() {
  static const auto& updates = *new std::vector<wire::TileUpdate>([] {
    wire::TileEncoder encoder;
    std::vector<wire::TileUpdate> frames;
    std::vector<float> heights(kRegion.cells.cells());
    for (int frame = 0; frame < 2; ++frame) {
      for (std::size_t n = 0; n < heights.size(); ++n) {
        heights[n] = std::sin(0.01F * static_cast<float>(n) + static_cast<float>(frame));
      }
      const wire::TileField field{kRegion, heights, {}};
      frames.push_back(encoder.Encode({&field, 1}));
    }
    return frames;
  }());
  return updates;
}

void CheckTiles(std::string_view blob) {
  wire::TileStore store;
  for (std::size_t n = 0; n < FirstFrames().size(); ++n) {
    ONESEA_CHECK(store.Apply(FirstFrames()[n], n == 0).ok());
  }
  const absl::Status status =
      store.Apply({.layout = std::nullopt, .blobs = {std::string(blob)}}, false);
  ONESEA_CHECK(status.ok() == store.current());
  ONESEA_CHECK(status.ok() || !status.message().empty());
  ONESEA_CHECK(store.fields().size() == 1);
  for (const float height_m : store.fields()[0].height_m) {
    ONESEA_CHECK(std::fabs(height_m) <= 32.769F) << height_m;
  }
  for (const float foam : store.fields()[0].foam) ONESEA_CHECK(foam >= 0.0F && foam <= 1.0F);
}

void CheckTerrain(std::string_view bytes) {
  const auto terrain = wire::DecodeTerrain(bytes);
  ONESEA_CHECK(terrain.ok() ? sea::ValidateTerrain(*terrain).ok()
                            : !terrain.status().message().empty());
}

}  // namespace

void DecodeAndCheck(std::string_view input) {
  if (input.empty()) return;
  const char choice = input.front();
  input.remove_prefix(1);
  if (choice == 0) CheckTiles(input);
  if (choice == 'T') CheckTerrain(input);
}

}  // namespace onesea::fuzz
