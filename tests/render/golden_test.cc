// Pictures against ones that a person has looked at. To accept new ones after a change that was
// meant: ONESEA_ACCEPT_PICTURES=1 golden_picture_test, look at tests/render/golden/, and commit.
#include <cmath>
#include <cstdlib>

#include "client/app/png_writer.h"
#include "tests/render/image_diff.h"
#include "tests/render/test_sea.h"
#include "tests/render/test_wake.h"

namespace onesea::render {
namespace {

// Other drivers round differently; a changed light, wave or filter shows far more than this.
constexpr double kRmseMax = 5.0;
constexpr double kSsimMin = 0.96;

class GoldenTest : public GlTest {
 protected:
  void Check(const std::string& name, const RenderFrame& frame) {
    const std::string path = "tests/render/golden/" + name + ".png";
    const Picture picture = Draw(frame, 320, 180);
    if (std::getenv("ONESEA_ACCEPT_PICTURES") != nullptr) {
      ASSERT_TRUE(client::WritePng(path, 320, 180, picture.rgb).ok());
    }
    const Likeness likeness = Compare(picture, ReadPng(path));
    if (likeness.rmse > kRmseMax || likeness.ssim < kSsimMin) {
      const std::string seen = testing::TempDir() + name + ".png";
      (void)client::WritePng(seen, 320, 180, picture.rgb);
      ADD_FAILURE() << path << ": rmse " << likeness.rmse << " (at most " << kRmseMax << "), ssim "
                    << likeness.ssim << " (at least " << kSsimMin << "); drawn now: " << seen;
    }
  }
};

TEST_F(GoldenTest, WindSeaAtNoonFromTheDeck) {
  TestSea sea(2.1, 7.5, 2.6, 128);
  RenderFrame frame;
  sea.FillFrame(20.0, frame);
  frame.camera = {{0, 0, 4}, 0.2, -0.06, 0.0, 0.785};
  frame.sun = {2.3, 0.9};
  frame.weather = {10.0, 2.6, 35'000.0, 0.3};
  Check("noon", frame);
}

TEST_F(GoldenTest, StormAtSunsetFromTheMast) {
  TestSea sea(4.7, 10.0, 0.4, 128);
  RenderFrame frame;
  sea.FillFrame(7.0, frame);
  frame.camera = {{300, 900, 40}, 1.0, -0.16, 0.03, 0.785};
  frame.sun = {1.1, 0.10};
  frame.weather = {17.0, 0.4, 25'000.0, 0.5};
  Check("sunset", frame);
}

TEST_F(GoldenTest, BoatsAndWakesInTheAfternoon) {
  TestSea sea(0.5, 3.6, 2.6, 128);
  const std::vector<TestWake> wakes = HarbourWakes();
  RenderFrame frame;
  sea.FillFrame(5.0, frame);
  FillHarbour(sea, wakes, frame);
  frame.camera = {{0, 0, 3.2}, 0.16, -0.08, 0.0, 0.8};
  frame.sun = {2.0, 0.75};
  frame.weather = {5.0, 2.6, 30'000.0, 0.25};
  frame.water = WaterType::kII;
  Check("harbour", frame);
}

// The measure itself must be able to fail: a brighter, a shifted and a smoothed sea are not alike.
TEST_F(GoldenTest, OtherPicturesAreNotAlike) {
  const Picture golden = ReadPng("tests/render/golden/noon.png");
  ASSERT_FALSE(golden.rgb.empty());
  Picture brighter = golden, shifted = golden, smooth = golden;
  for (std::size_t n = 0; n < golden.rgb.size(); ++n) {
    brighter.rgb[n] = static_cast<std::uint8_t>(std::min(255, golden.rgb[n] + 8));
    shifted.rgb[n] = golden.rgb[std::min(n + 6, golden.rgb.size() - 1)];
    if (n >= 9 && n + 9 < golden.rgb.size()) {
      smooth.rgb[n] = static_cast<std::uint8_t>(
          (golden.rgb[n - 9] + golden.rgb[n - 3] + golden.rgb[n + 3] + golden.rgb[n + 9]) / 4);
    }
  }
  EXPECT_GT(Compare(golden, brighter).rmse, kRmseMax);
  EXPECT_LT(Compare(golden, shifted).ssim, kSsimMin);
  EXPECT_LT(Compare(golden, smooth).ssim, kSsimMin);
  EXPECT_EQ(Compare(golden, golden).ssim, 1.0);
}

}  // namespace
}  // namespace onesea::render
