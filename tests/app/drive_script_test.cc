#include "client/app/drive_script.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace onesea::client {
namespace {

using ::testing::HasSubstr;

TEST(DriveScript, HoldsKeysFromTheirSecondOn) {
  DriveScript script = *DriveScript::Parse("0=b,1=up,4=up+left,9=");
  EXPECT_TRUE(script.At(0.0).spawn);
  EXPECT_FALSE(script.At(0.5).spawn);  // once
  EXPECT_EQ(script.At(0.9).helm, HelmKeys{});
  EXPECT_EQ(script.At(1.0).helm, HelmKeys{.ahead = true});
  EXPECT_EQ(script.At(5.0).helm, (HelmKeys{.ahead = true, .port = true}));
  EXPECT_EQ(script.At(100.0).helm, HelmKeys{});
}

// A slow picture must not swallow a key.
TEST(DriveScript, NoKeyIsLostBetweenTwoLooks) {
  DriveScript script = *DriveScript::Parse("0=b, 0.1=space, 0.2=x+delete, 0.3=right");
  const SkipperInput keys = script.At(1.0);
  EXPECT_TRUE(keys.spawn && keys.crate && keys.explode && keys.remove);
  EXPECT_EQ(keys.helm, HelmKeys{.starboard = true});
}

TEST(DriveScript, NothingIsNothing) {
  const auto script = DriveScript::Parse("");
  ASSERT_TRUE(script.ok());
  EXPECT_TRUE(script->empty());
}

TEST(DriveScript, NonsenseIsRefusedByName) {
  EXPECT_THAT(std::string(DriveScript::Parse("0=b,1=jump").status().message()),
              HasSubstr("no key 'jump'"));
  for (const char* text : {"b", "x=b", "2=up,1=down", "-1=up", "nan=up", "1e9=up", "=up"}) {
    EXPECT_FALSE(DriveScript::Parse(text).ok()) << text;
  }
}

}  // namespace
}  // namespace onesea::client
