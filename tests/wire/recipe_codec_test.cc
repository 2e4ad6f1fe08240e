#include "common/wire/recipe_codec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/limits.h"
#include "common/wire/direction.h"
#include "common/wire/proto_sea.h"
#include "tests/wire/recipe_examples.h"

namespace onesea::wire {
namespace {

using ::testing::HasSubstr;

std::string Message(const absl::Status& status) { return std::string(status.message()); }

// Bits, not values: -0 == 0 and NaN != NaN would hide what a text or float detour loses.
void ExpectSameBytes(const sea::Recipe& recipe) {
  const std::string bytes = EncodeRecipe(recipe);
  const absl::StatusOr<sea::Recipe> decoded = DecodeRecipe(bytes);
  ASSERT_TRUE(decoded.ok()) << decoded.status();
  EXPECT_EQ(*decoded, recipe);
  EXPECT_EQ(EncodeRecipe(*decoded), bytes);
}

TEST(RecipeCodec, RoundTripKeepsEveryBit) {
  ExpectSameBytes(RecipeOf(ParametricSea()));
  ExpectSameBytes(RecipeOf(BuoySea()));
  ExpectSameBytes(RecipeOf(GridSea()));
}

TEST(RecipeCodec, RoundTripKeepsATimelineOfSeveralSeas) {
  sea::Recipe recipe = RecipeOf(ParametricSea());
  recipe.timeline.push_back({600, 3600, BuoySea()});
  recipe.timeline.push_back({1234567890, 0, GridSea()});
  ExpectSameBytes(recipe);
}

TEST(RecipeCodec, RoundTripKeepsTheSignOfZero) {
  const absl::StatusOr<sea::Recipe> decoded = DecodeRecipe(EncodeRecipe(RecipeOf(ParametricSea())));
  ASSERT_TRUE(decoded.ok()) << decoded.status();
  EXPECT_TRUE(std::signbit(decoded->timeline[0].sea.regular_waves[0].phase_rad));
}

TEST(RecipeCodec, IsSmall) {
  sea::SeaState one;
  one.name = "storm";
  one.systems.push_back(sea::JonswapSystem{});
  EXPECT_LE(EncodeRecipe(RecipeOf(one)).size(), 1024u);
  EXPECT_LE(EncodeRecipe(RecipeOf(ParametricSea())).size(), 1024u);
  EXPECT_LE(EncodeRecipe(RecipeOf(BuoySea())).size(), 16u * 1024u);
  EXPECT_LE(EncodeRecipe(RecipeOf(GridSea())).size(), 16u * 1024u);
}

TEST(RecipeCodec, RefusesARecipeThatIsTooLong) {
  sea::Recipe recipe = RecipeOf(GridSea());
  EXPECT_TRUE(CheckRecipeBytes(recipe).ok());
  for (int n = 1; n < 4; ++n) recipe.timeline.push_back({n * 100, 10, GridSea()});
  EXPECT_THAT(Message(CheckRecipeBytes(recipe)), HasSubstr("the limit is 16384"));
}

TEST(RecipeCodec, RefusesAnUnknownModelVersion) {
  v1::Recipe proto;
  ToProto(RecipeOf(ParametricSea()), &proto);
  proto.set_sea_model_version(2);
  const absl::Status status = DecodeRecipe(proto.SerializeAsString()).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_THAT(Message(status), HasSubstr("sea_model_version: 2"));
}

TEST(RecipeCodec, NamesTheFieldOfABadNumber) {
  v1::Recipe proto;
  ToProto(RecipeOf(ParametricSea()), &proto);
  proto.mutable_timeline(0)->mutable_sea()->mutable_systems(0)->mutable_jonswap()->set_hs_m(99.0);
  const absl::Status status = DecodeRecipe(proto.SerializeAsString()).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(Message(status), HasSubstr("timeline[0].sea.systems[0]"));
  EXPECT_THAT(Message(status), HasSubstr("hs_m"));
  EXPECT_THAT(Message(status), HasSubstr("99"));
}

TEST(RecipeCodec, RefusesASpectrumFileOverTheNetwork) {
  v1::Recipe proto;
  ToProto(RecipeOf(ParametricSea()), &proto);
  proto.mutable_timeline(0)->mutable_sea()->mutable_systems(0)->mutable_file()->set_path("a.gz");
  EXPECT_THAT(Message(DecodeRecipe(proto.SerializeAsString()).status()),
              HasSubstr("beside a session file only"));
}

TEST(RecipeCodec, RefusesTooManySystems) {
  v1::Recipe proto;
  ToProto(RecipeOf(ParametricSea()), &proto);
  v1::SeaState* sea = proto.mutable_timeline(0)->mutable_sea();
  while (sea->systems_size() <= kWaveSystemsMax) *sea->add_systems() = sea->systems(0);
  EXPECT_THAT(Message(DecodeRecipe(proto.SerializeAsString()).status()),
              HasSubstr("timeline[0].sea.systems: 9 elements, the limit is 8"));
}

TEST(RecipeCodec, RefusesTooManyFrequencies) {
  v1::Recipe proto;
  ToProto(RecipeOf(BuoySea()), &proto);
  v1::WaveSystem* system = proto.mutable_timeline(0)->mutable_sea()->mutable_systems(0);
  while (system->buoy().r1_size() < 1000) system->mutable_buoy()->add_r1(0.1f);
  EXPECT_THAT(Message(DecodeRecipe(proto.SerializeAsString()).status()),
              HasSubstr("buoy.r1: 1000 elements, the limit is 128"));
}

// Coming from the north (0°) a wave travels south: 270° counter-clockwise from east.
TEST(Direction, NauticalDegreesBecomeRadiansOfTravel) {
  EXPECT_EQ(ToRadFromNauticalDeg(270.0), 0.0);                          // from west to east
  EXPECT_NEAR(ToRadFromNauticalDeg(180.0), 1.5707963267948966, 1e-15);  // from south to north
  EXPECT_NEAR(ToRadFromNauticalDeg(90.0), 3.141592653589793, 1e-15);    // from east to west
  EXPECT_NEAR(ToRadFromNauticalDeg(0.0), 4.71238898038469, 1e-15);      // from north to south
  EXPECT_EQ(ToRadFromNauticalDeg(360.0), ToRadFromNauticalDeg(0.0));
  EXPECT_EQ(ToRadFromNauticalDeg(-90.0), ToRadFromNauticalDeg(270.0));
}

}  // namespace
}  // namespace onesea::wire
