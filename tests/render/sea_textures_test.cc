#include "client/render/sea_textures.h"

#include <cmath>

#include "client/render/frame_block.h"
#include "tests/render/gl_fixture.h"
#include "tests/render/test_sea.h"

namespace onesea::render {
namespace {

class SeaTexturesTest : public GlTest {};

// At every level, resolved variance (mean of mip²) plus lost variance (mip of squares less square
// of mip) is the same: the mean square slope of the sea. So far water is as rough as near water.
TEST_F(SeaTexturesTest, EveryMipHoldsTheWholeSlopeVariance) {
  TestSea sea(2.0, 7.0, 1.0, 64);
  RenderFrame frame;
  sea.FillFrame(3.0, frame);
  SeaTextures textures;
  textures.Upload(frame.cascades);
  for (std::size_t layer = 0; layer < frame.cascades.size(); ++layer) {
    double expected = 0.0;
    const CascadePlanes& planes = frame.cascades[layer];
    for (std::size_t n = 0; n < planes.slope_x.size(); ++n) {
      expected += planes.slope_x[n] * planes.slope_x[n] + planes.slope_y[n] * planes.slope_y[n];
    }
    expected /= static_cast<double>(planes.slope_x.size());
    for (int level = 0, side = 64; side >= 1; ++level, side /= 2) {
      const std::size_t count = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
      std::vector<float> slope(count * 4 * frame.cascades.size());
      BindTexture(0, GL_TEXTURE_2D_ARRAY, textures.slope());
      glGetTexImage(GL_TEXTURE_2D_ARRAY, level, GL_RGBA, GL_FLOAT, slope.data());
      double resolved = 0.0, lost = 0.0;
      for (std::size_t n = 0; n < count; ++n) {
        const float* s = &slope[4 * (layer * count + n)];
        resolved += s[0] * s[0] + s[1] * s[1];
        lost += s[3] - s[0] * s[0] - s[1] * s[1];
      }
      resolved /= static_cast<double>(count);
      lost /= static_cast<double>(count);
      EXPECT_NEAR((resolved + lost) / expected, 1.0, 0.01)
          << "layer " << layer << " level " << level;
      EXPECT_GT(lost, -0.01 * expected);
      if (side == 1) {
        EXPECT_NEAR(lost / expected, 1.0, 0.02) << "layer " << layer;
      }
    }
  }
}

TEST(MeasureSlopes, AgreesWithTheWholeTile) {
  TestSea sea(2.0, 7.0, 1.0, 128);
  RenderFrame frame;
  sea.FillFrame(0.0, frame);
  for (const CascadePlanes& planes : frame.cascades) {
    double mss = 0.0, variance = 0.0;
    for (std::size_t n = 0; n < planes.height.size(); ++n) {
      mss += planes.slope_x[n] * planes.slope_x[n] + planes.slope_y[n] * planes.slope_y[n];
      variance += planes.height[n] * planes.height[n];
    }
    const double count = static_cast<double>(planes.height.size());
    const SlopeStats stats = MeasureSlopes(planes);
    EXPECT_NEAR((stats.xx + stats.yy) / (mss / count), 1.0, 0.05);
    EXPECT_NEAR(stats.height_variance_m2 / (variance / count), 1.0, 0.05);
  }
}

}  // namespace
}  // namespace onesea::render
