#include "client/app/cli_arguments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace onesea::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::vector<OptionSpec> kOptions = {
    {"at", "X,Y", "a place"}, {"time", "T", "a time"}, {"json", "", "a switch"}, {"help", "", ""}};

absl::StatusOr<Arguments> Parse(const std::vector<std::string>& words) {
  return ParseArguments(kOptions, words);
}

TEST(ParseArguments, TakesBothSpellingsRepeatsAndOperands) {
  const auto arguments = Parse({"a", "--at", "1,2", "--json", "--at=3,4", "b", "--", "--time"});
  ASSERT_TRUE(arguments.ok()) << arguments.status();
  EXPECT_THAT(arguments->GetAll("at"), ElementsAre("1,2", "3,4"));
  EXPECT_EQ(arguments->Get("at"), "3,4");
  EXPECT_TRUE(arguments->Has("json"));
  EXPECT_FALSE(arguments->Has("time"));
  EXPECT_EQ(arguments->Get("time"), std::nullopt);
  EXPECT_THAT(arguments->operands(), ElementsAre("a", "b", "--time"));
}

TEST(ParseArguments, ValueMayBeginWithADashOrBeEmpty) {
  EXPECT_EQ(Parse({"--at", "-3,-4"})->Get("at"), "-3,-4");
  EXPECT_EQ(Parse({"--at="})->Get("at"), "");
  EXPECT_THAT(Parse({"-5"})->operands(), ElementsAre("-5"));
  EXPECT_TRUE(Parse({"-h"})->Has("help"));
}

TEST(ParseArguments, ErrorsNameTheWord) {
  EXPECT_THAT(Parse({"--tiem", "3"}).status().message(),
              HasSubstr("unknown option --tiem; known: --at, --time, --json"));
  EXPECT_THAT(Parse({"--time"}).status().message(), HasSubstr("--time T"));
  EXPECT_THAT(Parse({"--json=1"}).status().message(), HasSubstr("--json takes no value"));
}

TEST(ParseNumber, RefusesNanInfinityRubbishAndTheOutOfRange) {
  EXPECT_EQ(*ParseNumber("--time", "-12.5e1", -200, 200), -125.0);
  EXPECT_EQ(*ParseNumber("--time", "200", -200, 200), 200.0);
  for (const char* text : {"nan", "inf", "-inf", "", "x", "1x", "201", "1e999", "0x", "--"}) {
    EXPECT_FALSE(ParseNumber("--time", text, -200, 200).ok()) << text;
  }
  EXPECT_EQ(ParseNumber("--time", "abc", -1, 2).status().message(),
            "--time is 'abc', it must be a number in [-1, 2]");
}

TEST(ParseInteger, RefusesFractionsAndOverflow) {
  EXPECT_EQ(*ParseInteger("N", "36000", 1, 36000), 36000);
  for (const char* text : {"0", "36001", "1.5", "", "nan", "99999999999999999999", "1 2"}) {
    EXPECT_FALSE(ParseInteger("N", text, 1, 36000).ok()) << text;
  }
}

TEST(ParsePlace, NeedsTwoFiniteNumbersWithinTheLimit) {
  EXPECT_EQ(*ParsePlace("--at", "12.5,-3"), (Vec2d{12.5, -3.0}));
  for (const char* text : {"", "1", "1,", ",1", "1,2,3", "nan,0", "0,inf", "1e8,0", "a,b"}) {
    EXPECT_FALSE(ParsePlace("--at", text).ok()) << text;
  }
}

TEST(ParseSpan, KnowsUnits) {
  EXPECT_EQ(*ParseSpan("--over", "90", 0, 1e5), 90.0);
  EXPECT_EQ(*ParseSpan("--over", "90s", 0, 1e5), 90.0);
  EXPECT_EQ(*ParseSpan("--over", "1.5min", 0, 1e5), 90.0);
  EXPECT_EQ(*ParseSpan("--over", "2h", 0, 1e5), 7200.0);
  EXPECT_EQ(*ParseSpan("--over", "250ms", 0, 1e5), 0.25);
  for (const char* text : {"", "s", "min", "1m", "-1s", "nan", "nans", "2d", "1e9h"}) {
    EXPECT_FALSE(ParseSpan("--over", text, 0, 86400).ok()) << text;
  }
}

}  // namespace
}  // namespace onesea::app
