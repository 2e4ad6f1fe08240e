#include "tests/fuzz/wire_input.h"

#include <cmath>
#include <vector>

#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/wire/body_table.h"
#include "common/wire/frame.h"
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

bool Within(Vec3d v, double max) {
  return std::fabs(v.x) <= max && std::fabs(v.y) <= max && std::fabs(v.z) <= max;
}

void CheckBodies(std::string_view bytes) {
  const auto bodies = wire::ReadBodies(bytes);
  if (!bodies.ok()) {
    ONESEA_CHECK(!bodies.status().message().empty());
    return;
  }
  ONESEA_CHECK(bodies->size() <= kBodiesMax);
  for (const wire::SentBody& body : *bodies) {
    ONESEA_CHECK(body.state.id > 0 && body.age_ticks >= 0);
    ONESEA_CHECK(Within(body.state.position_m, kQueryCoordinateMaxM));
    ONESEA_CHECK(Within(body.state.velocity_m_per_s, kBodySpeedMaxMPerS));
    ONESEA_CHECK(Within(body.state.spin_rad_per_s, kBodySpinMaxRadPerS));
    ONESEA_CHECK(std::fabs(Dot(body.state.turn, body.state.turn) - 1.0) < 1e-9);
  }
  // What was read is written and read again as the same.
  std::string again;
  wire::AppendBodies(*bodies, again);
  const auto twice = wire::ReadBodies(again);
  ONESEA_CHECK(twice.ok() && twice->size() == bodies->size()) << twice.status();
}

void CheckFrame(std::string_view bytes) {
  const auto frame = wire::DecodeFrame(bytes);
  if (!frame.ok() || !frame->world) return;
  wire::TileStore tiles;
  if (tiles.Apply(frame->world->tiles, true).ok()) {
    ONESEA_CHECK(tiles.fields().size() == frame->world->tiles.layout->size());
  }
  wire::BodyTable bodies;
  if (IsTickInRange(frame->world->tick, 60)) {
    bodies.Apply(frame->world->bodies, frame->world->tick, 60, true).IgnoreError();
  }
  if (frame->world->ropes != nullptr) {
    ONESEA_CHECK(frame->world->ropes->size() <= static_cast<std::size_t>(kRopesMax));
    for (const wire::TiedRope& rope : *frame->world->ropes) {
      ONESEA_CHECK(rope.id > 0 && wire::ValidateRopeSpec("", rope.spec).ok());
    }
  }
  for (const wire::BodyTable::Body& body : bodies.bodies()) {
    ONESEA_CHECK(body.info != nullptr && body.info->id == body.newest.id);
    ONESEA_CHECK(std::isfinite(Norm(body.At(SimTime::FromSeconds(1e9)).position_m)));
  }
}

}  // namespace

void DecodeAndCheck(std::string_view input) {
  if (input.empty()) return;
  const char choice = input.front();
  input.remove_prefix(1);
  if (choice == 0) CheckTiles(input);
  if (choice == 'T') CheckTerrain(input);
  if (choice == 1) CheckBodies(input);
  if (choice == 2) CheckFrame(input);
}

}  // namespace onesea::fuzz
