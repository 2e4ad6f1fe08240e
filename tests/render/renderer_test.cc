#include "client/render/renderer.h"

#include <cmath>
#include <cstdlib>

#include "tests/render/gl_fixture.h"
#include "tests/render/test_sea.h"

namespace onesea::render {
namespace {

class RendererTest : public GlTest {
 protected:
  RendererTest() : sea_(2.1, 7.5, 2.6, 128) {
    sea_.FillFrame(12.0, frame_);
    frame_.camera.position_m = {100.0, -40.0, 4.0};
    frame_.weather.wind_to_rad = 2.6;
  }
  TestSea sea_;
  RenderFrame frame_;
};

double MeanLuma(const Picture& picture, int from_row, int to_row) {
  double sum = 0.0;
  for (int y = from_row; y < to_row; ++y) {
    for (int n = 0; n < picture.width * 3; ++n)
      sum += picture.rgb[static_cast<std::size_t>(y * picture.width * 3 + n)];
  }
  return sum / (3.0 * picture.width * (to_row - from_row));
}

int BlackPixels(const Picture& picture) {
  int black = 0;
  for (std::size_t n = 0; n < picture.rgb.size(); n += 3) {
    if (picture.rgb[n] + picture.rgb[n + 1] + picture.rgb[n + 2] < 6) ++black;
  }
  return black;
}

TEST_F(RendererTest, SixtyFramesWithoutAnOpenGlError) {
  for (int n = 0; n < 60; ++n) {
    frame_.camera.yaw_rad = 0.1 * n;
    frame_.camera.position_m.x += 3.0;
    frame_.time_s += 1.0 / 30.0;
    Draw(frame_, 160, 90);
    ASSERT_EQ(glGetError(), GLenum{GL_NO_ERROR}) << "frame " << n;
  }
}

TEST_F(RendererTest, SamePictureTwice) {
  const Picture first = Draw(frame_, 160, 90);
  frame_.camera.yaw_rad += 1.0;
  Draw(frame_, 160, 90);
  frame_.camera.yaw_rad -= 1.0;
  EXPECT_EQ(first.rgb, Draw(frame_, 160, 90).rgb);
}

// A million metres from the origin the same waves must be drawn: the eye is rebased in double.
TEST_F(RendererTest, FarFromTheOriginIsAsSharpAsNear) {
  frame_.cascades.resize(1);  // one tile: moving by whole tiles changes nothing
  frame_.camera.position_m = {0.0, 0.0, 4.0};
  frame_.quality.ripples = false;
  frame_.weather.wind_speed_m_per_s = 0.0;
  const Picture near = Draw(frame_, 160, 90);
  frame_.camera.position_m.x = frame_.cascades[0].length_m * 512.0;
  const Picture far = Draw(frame_, 160, 90);
  double difference = 0.0;
  for (std::size_t n = 0; n < near.rgb.size(); ++n)
    difference += std::abs(near.rgb[n] - far.rgb[n]);
  EXPECT_LT(difference / static_cast<double>(near.rgb.size()), 0.05);
}

// Half in the water, under it, looking up, down and rolled: no hole, no black pixel, no crash.
TEST_F(RendererTest, NoHolesAnywhereNearTheSurface) {
  for (double height : {-6.0, -0.4, 0.0, 0.3, 1.5, 50.0, 3000.0}) {
    for (double pitch : {-1.5, -0.6, 0.0, 0.8}) {
      for (double roll : {0.0, 1.1}) {
        frame_.camera.position_m.z = height;
        frame_.camera.pitch_rad = pitch;
        frame_.camera.roll_rad = roll;
        const Picture picture = Draw(frame_, 96, 54);
        EXPECT_LE(BlackPixels(picture), 0) << height << " m, pitch " << pitch << ", roll " << roll;
      }
    }
  }
}

// The far sea is rough, so it reflects higher, darker sky: at 8 m/s the horizon is a line.
TEST_F(RendererTest, SeaIsDarkerThanTheSkyAboveTheHorizon) {
  frame_.camera.pitch_rad = 0.0;
  frame_.weather.cloud_cover = 0.0;
  frame_.sun = {3.0, 0.8};
  const Picture picture = Draw(frame_, 320, 180);
  EXPECT_LT(MeanLuma(picture, 93, 97), MeanLuma(picture, 82, 87) - 8.0);
}

TEST_F(RendererTest, OneSampleAndFourAgreeOnAverage) {
  const Picture four = Draw(frame_, 160, 90);
  frame_.quality.samples = 1;
  const Picture one = Draw(frame_, 160, 90);
  EXPECT_NEAR(MeanLuma(four, 0, 90), MeanLuma(one, 0, 90), 1.0);
}

TEST_F(RendererTest, NightAndOvercastHaveNoNan) {
  for (double elevation : {-0.19, -0.02, 0.01, 1.5707}) {
    for (double cover : {0.0, 1.0}) {
      frame_.sun.elevation_rad = elevation;
      frame_.weather.cloud_cover = cover;
      EXPECT_EQ(BlackPixels(Draw(frame_, 96, 54)), 0) << elevation << " " << cover;
    }
  }
}

}  // namespace
}  // namespace onesea::render
