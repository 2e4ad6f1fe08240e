#include "client/app/json_writer.h"

#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace onesea::app {
namespace {

TEST(JsonWriter, NestsInTheOrderOfTheCalls) {
  JsonWriter json;
  json.BeginObject().Key("a").Value(1).Key("b").BeginArray().Value(true).Value("x").Null();
  json.BeginObject().EndObject().EndArray().Key("c").Value(-0.5).EndObject();
  EXPECT_EQ(json.text(), R"({"a":1,"b":[true,"x",null,{}],"c":-0.5})");
}

TEST(JsonWriter, NumbersReadBackExactlyAndNonFiniteOnesAreNull) {
  JsonWriter json;
  json.BeginArray().Value(0.1).Value(0.1f).Value(1e300).Value(std::nan("")).Value(-HUGE_VALF);
  json.Value(std::numeric_limits<std::int64_t>::min()).EndArray();
  EXPECT_EQ(json.text(), "[0.1,0.1,1e+300,null,null,-9223372036854775808]");
}

// An independent reader gets back what was written, control characters included.
TEST(JsonWriter, TextSurvivesAnotherReader) {
  const std::string nasty = std::string("quote\" slash\\ line\n tab\t bell\x07 nul") + '\0' + "é λ";
  JsonWriter json;
  json.BeginObject().Key(nasty).Value(nasty).EndObject();
  google::protobuf::Struct read;
  ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(json.text(), &read).ok()) << json.text();
  EXPECT_EQ(read.fields().at(nasty).string_value(), nasty);
}

}  // namespace
}  // namespace onesea::app
