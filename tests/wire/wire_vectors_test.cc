// The bytes that proto/onesea/v1/WIRE.md shows are the bytes that we send and understand.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "absl/strings/escaping.h"
#include "common/wire/body_codec.h"
#include "common/wire/frame.h"
#include "common/wire/proto_query.h"
#include "common/wire/proto_world.h"
#include "common/wire/recipe_codec.h"
#include "common/wire/terrain_codec.h"
#include "common/wire/tile_encoder.h"
#include "common/wire/tile_store.h"
#include "onesea/v1/frame.pb.h"

namespace onesea::wire {
namespace {

std::map<std::string, std::string> ReadVectors() {
  std::ifstream page("proto/onesea/v1/WIRE.md");
  std::map<std::string, std::string> vectors;
  std::string line;
  while (std::getline(page, line)) {
    if (line != "## Test vectors") continue;
    while (std::getline(page, line) && line != "```") {
    }
    std::string name, hex;
    while (std::getline(page, line) && line != "```") {
      std::istringstream(line) >> name >> hex;
      vectors[name] = absl::HexStringToBytes(hex);
    }
  }
  return vectors;
}

std::string Hex(const std::string& bytes) { return absl::BytesToHexString(bytes); }

class WireVectors : public ::testing::Test {
 protected:
  const std::string& Bytes(const std::string& name) { return vectors.at(name); }
  std::map<std::string, std::string> vectors = ReadVectors();
};

TEST_F(WireVectors, AllAreThere) { EXPECT_EQ(vectors.size(), 14u); }

TEST_F(WireVectors, Stamp) {
  Frame frame;
  frame.sequence = 300;
  frame.stamp = Stamp{.tick = 600,
                      .server_monotonic_ns = 1'000'000'000,
                      .speed = 1.0,
                      .pace = Pace::kRealTime,
                      .actual_speed = 1.0};
  EXPECT_EQ(EncodeFrame(frame), Bytes("stamp"));
  const Frame decoded = DecodeFrame(Bytes("stamp")).value();
  EXPECT_EQ(decoded.sequence, 300);
  ASSERT_TRUE(decoded.stamp.has_value());
  EXPECT_EQ(decoded.stamp->tick, 600);
  EXPECT_EQ(decoded.stamp->server_monotonic_ns, 1'000'000'000);
  EXPECT_EQ(decoded.stamp->speed, 1.0);
  EXPECT_FALSE(decoded.probes || decoded.welcome || decoded.farewell || decoded.keyframe);
}

TEST_F(WireVectors, HeldWithProbes) {
  const Frame decoded = DecodeFrame(Bytes("held")).value();
  EXPECT_TRUE(decoded.keyframe);
  EXPECT_EQ(decoded.stamp->pace, Pace::kHeld);
  EXPECT_EQ(decoded.stamp->speed, 0.0);
  EXPECT_EQ(decoded.probes->tick, 600);
  EXPECT_EQ(decoded.probes->height_m, (std::vector<float>{1.5f, -0.25f}));
  EXPECT_EQ(EncodeFrame(decoded), Bytes("held"));
}

TEST_F(WireVectors, Farewell) {
  const Frame decoded = DecodeFrame(Bytes("farewell")).value();
  EXPECT_EQ(decoded.farewell, "bye");
  EXPECT_EQ(EncodeFrame(decoded), Bytes("farewell"));
}

TEST_F(WireVectors, ViewerMessages) {
  v1::WatchRequest open;
  open.mutable_open()->set_session("tank");
  open.mutable_open()->set_credit(8);
  EXPECT_EQ(open.SerializeAsString(), Bytes("open"));
  v1::WatchRequest ack;
  ack.mutable_ack()->set_sequence(300);
  ack.mutable_ack()->set_drift_m(0.5f);
  EXPECT_EQ(ack.SerializeAsString(), Bytes("ack"));
}

TEST_F(WireVectors, Query) {
  QueryRequest request;
  request.session = "tank";
  request.id = 7;
  request.points_m = {{1.0, -2.0}};
  request.tick = 600;
  v1::QueryPointsRequest proto;
  ToProto(request, &proto);
  EXPECT_EQ(proto.SerializeAsString(), Bytes("query"));
}

TEST_F(WireVectors, Answer) {
  v1::QueryPointsResponse proto;
  ASSERT_TRUE(proto.ParseFromString(Bytes("answer")));
  const QueryAnswer answer = FromProto(proto).value();
  EXPECT_EQ(answer.id, 7);
  EXPECT_EQ(answer.time_s, 10.0);
  EXPECT_EQ(answer.layers, 1u);
  EXPECT_EQ(answer.height_m, std::vector<float>{0.5f});
  EXPECT_EQ(answer.height_error_bound_m, 0.0078125);
}

TEST_F(WireVectors, Recipe) {
  const sea::Recipe recipe = DecodeRecipe(Bytes("recipe")).value();
  EXPECT_EQ(recipe.seed, 1u);
  EXPECT_EQ(recipe.tick_rate_hz, 60);
  EXPECT_EQ(recipe.depth_m, 12.0);
  EXPECT_EQ(recipe.choppiness, 1.0);
  ASSERT_EQ(recipe.cascades.size(), 1u);
  EXPECT_EQ(recipe.cascades[0].length_m, 200.0);
  EXPECT_EQ(recipe.cascades[0].wavenumber_max_rad_per_m, 0.125);
  EXPECT_EQ(recipe.cascades[0].query_grid_size, 64);
  ASSERT_EQ(recipe.timeline.size(), 1u);
  EXPECT_EQ(recipe.timeline[0].sea.name, "tank");
  ASSERT_EQ(recipe.timeline[0].sea.regular_waves.size(), 1u);
  EXPECT_EQ(recipe.timeline[0].sea.regular_waves[0].amplitude_m, 0.5);
  EXPECT_EQ(recipe.timeline[0].sea.regular_waves[0].period_s, 8.0);
  EXPECT_EQ(EncodeRecipe(recipe), Bytes("recipe"));
}

// Decoded only: the packed bytes are those of one version of Zstandard.
TEST_F(WireVectors, Terrain) {
  const auto terrain = DecodeTerrain(Bytes("terrain"));
  ASSERT_TRUE(terrain.ok()) << terrain.status();
  EXPECT_EQ(terrain->west_m, -5.0);
  EXPECT_EQ(terrain->south_m, 10.0);
  EXPECT_EQ(terrain->cell_m, 2.5);
  EXPECT_EQ(terrain->columns, 3);
  EXPECT_EQ(terrain->rows, 2);
  EXPECT_EQ(terrain->elevation_m, (std::vector<float>{-4.5f, -4.25f, -4.0f, -3.0f, -0.75f, 1.5f}));
}

// Two tiles of one group: the south-west one slopes by a step a column, the north-east one foams.
// Zstandard may pack the same otherwise in another version, so only the reading is exact.
TEST_F(WireVectors, Tiles) {
  const RegionLayout region = {
      .id = 3,
      .cells = {.west = -64, .south = 0, .columns = 64, .rows = 64, .cell_m = 0.5},
      .height_step_m = 1e-3};
  std::vector<float> heights(region.cells.cells()), foam(region.cells.cells());
  for (std::size_t row = 0; row < 32; ++row) {
    for (std::size_t column = 0; column < 32; ++column) {
      heights[row * 64 + column] = 0.001F * static_cast<float>(column);
      foam[(32 + row) * 64 + 32 + column] = 0.2F;
    }
  }
  TileEncoder encoder;
  const TileField field{region, heights, foam};
  const TileUpdate& encoded = encoder.Encode({&field, 1});
  ASSERT_EQ(encoded.blobs.size(), 1u);
  EXPECT_EQ(Hex(encoded.blobs[0].substr(0, 6)), Hex(Bytes("tiles").substr(0, 6)))
      << Hex(encoded.blobs[0]);
  TileStore store;
  const TileUpdate update{.layout = std::vector<RegionLayout>{region}, .blobs = {Bytes("tiles")}};
  ASSERT_TRUE(store.Apply(update, true).ok());
  for (std::size_t cell = 0; cell < heights.size(); ++cell) {
    ASSERT_NEAR(store.fields()[0].height_m[cell], heights[cell], 1e-6) << cell;
    ASSERT_NEAR(store.fields()[0].foam[cell], foam[cell], 1e-6) << cell;
  }
}

TEST_F(WireVectors, Bodies) {
  SentBody boat, buoy;
  boat.state.id = 1;
  boat.state.flags = kBodyDriven;
  boat.state.position_m = {100.25, -20.5, 0.125};
  boat.state.turn = TurnBy({0.0, 0.0, 1.5707963267948966});
  boat.state.velocity_m_per_s = {0.0, 5.0, -0.25};
  boat.state.spin_rad_per_s = {0.0, 0.0, 0.5};
  buoy.state.id = 300;
  buoy.age_ticks = 90;
  buoy.state.position_m = {101.0, -22.0, 0.0};
  std::string bytes;
  AppendBodies(std::vector<SentBody>{boat, buoy}, bytes);
  EXPECT_EQ(Hex(bytes), Hex(Bytes("bodies")));
  const std::vector<SentBody> read = ReadBodies(Bytes("bodies")).value();
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].state.position_m, boat.state.position_m);
  EXPECT_EQ(read[0].state.velocity_m_per_s, boat.state.velocity_m_per_s);
  EXPECT_LT(AngleBetween(read[0].state.turn, boat.state.turn), 1e-4);
  EXPECT_EQ(read[1].state.id, 300u);
  EXPECT_EQ(read[1].age_ticks, 90);
  EXPECT_EQ(read[1].state.turn, Quaternion{});
}

TEST_F(WireVectors, World) {
  Frame frame;
  frame.sequence = 300;
  frame.world.emplace();
  frame.world->tick = 600;
  frame.world->tiles.layout = std::vector<RegionLayout>{
      {.id = 3,
       .cells = {.west = -64, .south = 0, .columns = 64, .rows = 64, .cell_m = 0.5},
       .height_step_m = 0.0009765625}};
  frame.world->bodies.removed_ids = {7};
  frame.world->bodies.states = Bytes("bodies");
  frame.world->water_level_m = 0.5;
  EXPECT_EQ(Hex(EncodeFrame(frame)), Hex(Bytes("world")));
  const Frame read = DecodeFrame(Bytes("world")).value();
  EXPECT_EQ(read.world->tiles.layout, frame.world->tiles.layout);
  EXPECT_EQ(read.world->bodies.states, Bytes("bodies"));
  EXPECT_EQ(read.world->water_level_m, 0.5);
}

TEST_F(WireVectors, Ropes) {
  Frame frame;
  frame.sequence = 301;
  frame.world.emplace();
  frame.world->tick = 602;
  const TiedRope mooring = {5, {{1, {3.0, 0.0, 0.5}}, {0, {20.0, 0.0, 1.0}}, 18.0, 3000.0, 300.0}};
  frame.world->ropes =
      std::make_shared<const std::vector<TiedRope>>(std::vector<TiedRope>{mooring});
  EXPECT_EQ(Hex(EncodeFrame(frame)), Hex(Bytes("ropes")));
  const Frame read = DecodeFrame(Bytes("ropes")).value();
  ASSERT_NE(read.world->ropes, nullptr);
  ASSERT_EQ(read.world->ropes->size(), 1u);
  EXPECT_EQ(read.world->ropes->front(), mooring);
}

TEST_F(WireVectors, Drive) {
  v1::DriveBodyRequest proto;
  ToProto(CommandHeader{"tank", "r1", 700, "key"}, proto.mutable_command());
  ToProto(DriveBody{1, {1.0}, {-0.5}}, &proto);
  EXPECT_EQ(Hex(proto.SerializeAsString()), Hex(Bytes("drive")));
  v1::DriveBodyRequest read;
  ASSERT_TRUE(read.ParseFromString(Bytes("drive")));
  const HeadedCommand command = FromProto(read).value();
  EXPECT_EQ(command.header.tick, 700);
  EXPECT_EQ(std::get<DriveBody>(command.command).rudder, std::vector<double>{-0.5});
}

}  // namespace
}  // namespace onesea::wire
