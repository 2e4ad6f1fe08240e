// Bursts of spray in the picture: where their drops fly, and only while they do.
#include <cmath>

#include "tests/render/gl_fixture.h"
#include "tests/render/test_sea.h"

namespace onesea::render {
namespace {

constexpr int kWidth = 320, kHeight = 180;
constexpr double kFov = 0.785, kEyeM = 3.0;

class SprayTest : public GlTest {
 protected:
  SprayTest() : sea_(1e-4, 3.0, 2.6, 64) {
    sea_.FillFrame(12.0, frame_);
    frame_.camera = {{0, 0, kEyeM}, 0.0, 0.0, 0.0, kFov};
    frame_.weather.cloud_cover = 0.0;
    frame_.weather.wind_speed_m_per_s = 0.0;
    frame_.sun = {2.6, 0.7};
    frame_.quality.bloom = false;
  }
  void SetUp() override {
    GlTest::SetUp();
    none_ = Draw(frame_, kWidth, kHeight);
  }

  struct Seen {
    int pixels = 0;
    double x = 0.0, y = 0.0;  // mean place [px]
    int left = kWidth, right = -1, top = kHeight, bottom = -1;
  };
  Seen Look() {
    const Picture with = Draw(frame_, kWidth, kHeight);
    Seen seen;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const auto at = static_cast<std::size_t>((y * kWidth + x) * 3);
        int most = 0;
        for (std::size_t c = 0; c < 3; ++c)
          most = std::max(most, std::abs(with.rgb[at + c] - none_.rgb[at + c]));
        if (most < 4) continue;
        ++seen.pixels;
        seen.x += x;
        seen.y += y;
        seen.left = std::min(seen.left, x);
        seen.right = std::max(seen.right, x);
        seen.top = std::min(seen.top, y);
        seen.bottom = std::max(seen.bottom, y);
      }
    }
    seen.x /= std::max(seen.pixels, 1);
    seen.y /= std::max(seen.pixels, 1);
    return seen;
  }
  static double Scale(double distance_m) {
    return 0.5 * kHeight / std::tan(0.5 * kFov) / distance_m;
  }

  TestSea sea_;
  RenderFrame frame_;
  Picture none_;
};

TEST_F(SprayTest, RisesFallsAndIsGone) {
  frame_.spray = {{{20, 0, 0.2}, {0, 0, 6}, 20.0, 0.05, 7}};
  const Seen start = Look();
  EXPECT_GT(start.pixels, 20);
  // Thrown up at 6 m/s it can't be higher than 1.3² · 36 / 2g = 3.1 m plus its own width, nor aside
  // by more than it is tossed.
  const double scale = Scale(20.0);
  for (double age : {0.15, 0.4, 0.8, 1.5}) {
    frame_.spray[0].age_s = age;
    const Seen seen = Look();
    EXPECT_GE(seen.top, 0.5 * kHeight - scale * (5.5 - kEyeM)) << age;
    EXPECT_GE(seen.left, 0.5 * kWidth - scale * 6.0) << age;
    EXPECT_LE(seen.right, 0.5 * kWidth + scale * 6.0) << age;
    if (age == 0.4) {
      EXPECT_LT(seen.y, start.y - 3) << "it rises";
    }
  }
  frame_.spray[0].age_s = kSprayLifeS;
  EXPECT_EQ(Look().pixels, 0);
  frame_.spray[0].age_s = -0.1;
  EXPECT_EQ(Look().pixels, 0);
}

TEST_F(SprayTest, DriftsWithTheWind) {
  frame_.spray = {{{20, 0, 0.2}, {0, 0, 6}, 20.0, 0.7, 7}};
  const double still = Look().x;
  frame_.weather.wind_speed_m_per_s = 8.0;
  frame_.weather.wind_to_rad = -1.5708;  // to the right
  std::vector<SprayBurst> spray;
  std::swap(spray, frame_.spray);
  none_ = Draw(frame_, kWidth, kHeight);
  std::swap(spray, frame_.spray);
  EXPECT_GT(Look().x, still + 5.0);
}

TEST_F(SprayTest, HeavierBurstsAreLarger) {
  frame_.spray = {{{20, 0, 0.5}, {0, 0, 5}, 1.0, 0.3, 3}};
  const int small = Look().pixels;
  frame_.spray[0].mass_kg = 200.0;
  EXPECT_GT(Look().pixels, 2 * small);
}

TEST_F(SprayTest, SameSeedSamePictureAndOnlyTheLastAreDrawn) {
  frame_.spray = {{{20, 0, 0.5}, {0, 0, 5}, 10.0, 0.3, 3}};
  const Picture first = Draw(frame_, kWidth, kHeight);
  EXPECT_EQ(first.rgb, Draw(frame_, kWidth, kHeight).rgb);
  frame_.spray.assign(kRenderSprayMax, {{20, 0, 0.5}, {0, 0, 5}, 10.0, 5.0, 3});
  frame_.spray.insert(frame_.spray.begin(), {{20, 0, 0.5}, {0, 0, 5}, 10.0, 0.3, 3});
  EXPECT_EQ(none_.rgb, Draw(frame_, kWidth, kHeight).rgb);
}

// Behind a wave, or a hill, it is not seen.
TEST_F(SprayTest, SeaHidesWhatIsBelowIt) {
  frame_.spray = {{{20, 0, -9.0}, {0, 0, 3}, 20.0, 0.2, 7}};
  EXPECT_EQ(Look().pixels, 0);
}

}  // namespace
}  // namespace onesea::render
