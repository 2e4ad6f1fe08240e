// Land, seabed, shallow water and the sea behind walls, in the picture.
#include <algorithm>
#include <cmath>
#include <memory>

#include "client/render/ground_textures.h"
#include "tests/render/gl_fixture.h"
#include "tests/render/test_sea.h"

namespace onesea::render {
namespace {

constexpr int kWidth = 320, kHeight = 180;
constexpr double kFov = 0.785;

template <typename F>
std::shared_ptr<const sea::Terrain> MakeTerrain(F&& elevation, int side = 101, double cell = 10.0) {
  auto terrain = std::make_shared<sea::Terrain>();
  terrain->west_m = terrain->south_m = -0.5 * (side - 1) * cell;
  terrain->cell_m = cell;
  terrain->columns = terrain->rows = side;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      terrain->elevation_m.push_back(
          static_cast<float>(elevation(terrain->west_m + i * cell, terrain->south_m + j * cell)));
    }
  }
  return terrain;
}

template <typename F>
std::shared_ptr<const sea::AttenuationGrid> MakeFactors(int planes, F&& factor) {
  auto grid = std::make_shared<sea::AttenuationGrid>();
  grid->west_m = grid->south_m = -500.0;
  grid->cell_m = 10.0;
  grid->columns = grid->rows = 101;
  grid->planes = planes;
  for (int j = 0; j < 101; ++j) {
    for (int i = 0; i < 101; ++i) {
      for (int p = 0; p < planes; ++p) {
        grid->factor.push_back(static_cast<float>(factor(-500.0 + 10.0 * i, -500.0 + 10.0 * j, p)));
      }
    }
  }
  return grid;
}

class TerrainTest : public GlTest {
 protected:
  TerrainTest() : calm_(1e-4, 3.0, 2.6, 64), sea_(1.5, 6.0, 2.6, 128) {
    calm_.FillFrame(12.0, frame_);
    frame_.camera = {{0, 0, 3}, 0.0, 0.0, 0.0, kFov};
    frame_.weather.cloud_cover = 0.0;
    frame_.weather.wind_speed_m_per_s = 2.0;
    frame_.sun = {2.6, 0.7};
    frame_.water = WaterType::kII;
    frame_.quality.bloom = false;
  }

  // Mean of a channel over the pixels of a box.
  static double Mean(const Picture& picture, int left, int top, int right, int bottom,
                     int channel) {
    double sum = 0.0;
    for (int y = top; y < bottom; ++y) {
      for (int x = left; x < right; ++x) {
        sum += picture.rgb[static_cast<std::size_t>((y * picture.width + x) * 3 + channel)];
      }
    }
    return sum / ((right - left) * (bottom - top));
  }
  // RMS of second differences up and down the picture: waves, but no even change to the horizon.
  static double Roughness(const Picture& picture, int left, int top, int right, int bottom) {
    double squares = 0.0;
    for (int y = top; y < bottom; ++y) {
      for (int x = left; x < right; ++x) {
        const auto green = [&](int row) {
          return int{picture.rgb[static_cast<std::size_t>((row * picture.width + x) * 3 + 1)]};
        };
        const double bend = green(y - 3) - 2 * green(y) + green(y + 3);
        squares += bend * bend;
      }
    }
    return std::sqrt(squares / ((right - left) * (bottom - top)));
  }
  static int Different(const Picture& a, const Picture& b, int least) {
    int count = 0;
    for (std::size_t n = 0; n < a.rgb.size(); n += 3) {
      int most = 0;
      for (std::size_t c = 0; c < 3; ++c)
        most = std::max(most, std::abs(a.rgb[n + c] - b.rgb[n + c]));
      count += most >= least;
    }
    return count;
  }
  static int BlackPixels(const Picture& picture) {
    int black = 0;
    for (std::size_t n = 0; n < picture.rgb.size(); n += 3) {
      black += picture.rgb[n] + picture.rgb[n + 1] + picture.rgb[n + 2] < 6;
    }
    return black;
  }

  TestSea calm_, sea_;
  RenderFrame frame_;
};

// Straight down on calm clear water: at half a metre the sand shows, in fifty metres nothing does,
// and between them red, which water takes away first, is gone before green.
TEST_F(TerrainTest, BottomShinesThroughShallowWaterOnly) {
  frame_.camera.position_m.z = 12.0;
  frame_.camera.pitch_rad = -1.4;
  for (int samples : {1, 4}) {
    frame_.quality.samples = samples;
    frame_.terrain = nullptr;
    const Picture open = Draw(frame_, kWidth, kHeight);
    const auto brighter = [&](double depth_m, int channel) {
      frame_.terrain = MakeTerrain([&](double, double) { return -depth_m; });
      const Picture over = Draw(frame_, kWidth, kHeight);
      return Mean(over, 60, 40, 260, 160, channel) - Mean(open, 60, 40, 260, 160, channel);
    };
    EXPECT_GT(brighter(0.5, 0), 30.0);
    EXPECT_GT(brighter(0.5, 1), 30.0);
    EXPECT_GT(brighter(2.0, 1), brighter(5.0, 1) + 5.0);
    EXPECT_GT(brighter(5.0, 1), brighter(10.0, 1) + 5.0);
    EXPECT_GT(brighter(8.0, 1), 5.0 + 3.0 * std::abs(brighter(8.0, 0)));
    for (int channel : {0, 1, 2}) EXPECT_LT(std::abs(brighter(50.0, channel)), 1.5);
  }
}

// A wall across the view, 200 m away, from 10 m under water to 12 m above it.
TEST_F(TerrainTest, LandStandsWhereItsProjectionIs) {
  const auto wall = MakeTerrain(
      [](double x, double y) { return x > 205 && x < 300 && std::abs(y) < 55 ? 12.0 : -40.0; });
  for (int samples : {1, 4}) {
    frame_.quality.samples = samples;
    frame_.terrain = nullptr;
    const Picture open = Draw(frame_, kWidth, kHeight);
    frame_.terrain = wall;
    const Picture with = Draw(frame_, kWidth, kHeight);
    const double scale = 0.5 * kHeight / std::tan(0.5 * kFov);
    const auto changed = [&](double y_m, double z_m, double x_m) {
      const auto x = std::lround(0.5 * kWidth - 0.5 - scale * y_m / x_m);
      const auto y = std::lround(0.5 * kHeight - 0.5 - scale * (z_m - 3.0) / x_m);
      const auto at = static_cast<std::size_t>((y * kWidth + x) * 3);
      int most = 0;
      for (std::size_t c = 0; c < 3; ++c)
        most = std::max(most, std::abs(with.rgb[at + c] - open.rgb[at + c]));
      return most > 12;
    };
    for (double y : {-40.0, -10.0, 0.0, 25.0, 40.0}) {
      EXPECT_TRUE(changed(y, 5.0, 208)) << y << ", " << samples << " samples";
      EXPECT_TRUE(changed(y, 9.0, 208)) << y << ", " << samples << " samples";
      EXPECT_FALSE(changed(y, 16.0, 208)) << y << ", " << samples << " samples";
    }
    for (double y : {-75.0, 75.0}) EXPECT_FALSE(changed(y, 7.0, 208)) << samples << " samples";
  }
}

TEST_F(TerrainTest, LandBehindTheEyeIsNoPartOfThePicture) {
  const Picture open = Draw(frame_, kWidth, kHeight);
  frame_.terrain = MakeTerrain([](double x, double) { return x < -50 ? 20.0 : -60.0; });
  EXPECT_LE(Different(open, Draw(frame_, kWidth, kHeight), 3), 0);
}

// A grid of ones changes nothing; behind a line where the factors fall to 0 the sea is flat.
TEST_F(TerrainTest, FactorsLowerTheSeaWhereTheyAreSmall) {
  sea_.FillFrame(12.0, frame_);
  frame_.camera = {{0, 0, 12}, 0.0, -0.2, 0.0, kFov};
  frame_.quality.ripples = false;
  for (int samples : {1, 4}) {
    frame_.quality.samples = samples;
    frame_.attenuation = nullptr;
    const Picture whole = Draw(frame_, kWidth, kHeight);
    frame_.attenuation = MakeFactors(4, [](double, double, int) { return 1.0; });
    EXPECT_EQ(Different(whole, Draw(frame_, kWidth, kHeight), 3), 0);
    // North of the line of view the sea is hidden behind a wall: that is the left half.
    frame_.attenuation = MakeFactors(4, [](double, double y, int) { return y > 0 ? 0.0 : 1.0; });
    const Picture half = Draw(frame_, kWidth, kHeight);
    const double rough = Roughness(whole, 20, 110, 130, 170);
    const double flat = Roughness(half, 20, 110, 130, 170);
    EXPECT_GT(rough, 5.0);
    EXPECT_LT(flat, 0.35 * rough) << samples << " samples";
    EXPECT_NEAR(Roughness(half, 190, 110, 300, 170), Roughness(whole, 190, 110, 300, 170), 1.5);
  }
}

// Planes are cascades in order, and after them the regular waves.
TEST_F(TerrainTest, EveryPlaneHasItsOwnFactor) {
  frame_.camera = {{0, 0, 12}, 0.0, -0.2, 0.0, kFov};
  frame_.quality.ripples = false;
  const double k = 2.0 * 3.14159265 / 30.0;
  const auto roughness = [&](int plane) {
    frame_.attenuation =
        MakeFactors(5, [&](double, double, int p) { return p == plane ? 0.0 : 1.0; });
    return Roughness(Draw(frame_, kWidth, kHeight), 20, 110, 300, 170);
  };
  calm_.FillFrame(12.0, frame_);
  frame_.regular_waves = {{k, 0, 0.8, 0.0}};
  const double with = roughness(3), without = roughness(4);
  EXPECT_LT(without, 0.4 * with);
  // Of the sea's cascades the third holds most of the slopes.
  sea_.FillFrame(12.0, frame_);
  frame_.regular_waves.clear();
  EXPECT_LT(roughness(2), roughness(0));
}

// Eye and sea lifted by the same tide: the same picture. Land is drowned by it.
TEST_F(TerrainTest, TideLiftsTheSeaAndDrownsLand) {
  sea_.FillFrame(12.0, frame_);
  const Picture low = Draw(frame_, kWidth, kHeight);
  frame_.camera.position_m.z += 2.5;
  frame_.water_level_m = 2.5;
  EXPECT_EQ(low.rgb, Draw(frame_, kWidth, kHeight).rgb);

  calm_.FillFrame(12.0, frame_);
  frame_.camera.position_m.z = 20.0;
  frame_.camera.pitch_rad = -0.3;
  // A beach that rises ahead, 1 in 20.
  const auto beach = MakeTerrain([](double x, double) { return 0.05 * (x - 100.0); });
  double row = 0.0;
  for (double level : {0.0, 2.5}) {
    frame_.water_level_m = level;
    frame_.terrain = nullptr;
    const Picture open = Draw(frame_, kWidth, kHeight);
    frame_.terrain = beach;
    const Picture with = Draw(frame_, kWidth, kHeight);
    // The lowest row where land shows in the middle: deep water below it is as the open sea.
    int lowest = 0;
    for (int y = 0; y < kHeight; ++y) {
      const auto at = static_cast<std::size_t>((y * kWidth + kWidth / 2) * 3);
      if (with.rgb[at] > open.rgb[at] + 25) lowest = y;
    }
    EXPECT_GT(lowest, 40);
    if (level > 0.0) {
      EXPECT_LT(lowest, row - 6);
    }
    row = lowest;
  }
}

TEST_F(TerrainTest, ShoreFromEverywhereHasNoHolesNorErrors) {
  sea_.FillFrame(12.0, frame_);
  frame_.weather.wind_speed_m_per_s = 9.0;
  frame_.terrain = MakeTerrain([](double x, double y) {
    return 12.0 * std::sin(x / 60.0) * std::cos(y / 45.0) - 3.0 - 0.00005 * (x * x + y * y);
  });
  frame_.attenuation =
      MakeFactors(4, [](double x, double, int) { return std::clamp(0.5 + x / 100, 0.0, 1.2); });
  for (int samples : {1, 4}) {
    frame_.quality.samples = samples;
    for (double height : {-4.0, 0.4, 2.0, 30.0, 900.0}) {
      for (double pitch : {-1.3, -0.3, 0.0, 0.6}) {
        for (double yaw : {0.0, 2.0, 4.0}) {
          frame_.camera.position_m.z = height;
          frame_.camera.pitch_rad = pitch;
          frame_.camera.yaw_rad = yaw;
          const Picture picture = Draw(frame_, 96, 54);
          EXPECT_EQ(BlackPixels(picture), 0)
              << height << " m, pitch " << pitch << ", yaw " << yaw << ", " << samples;
          ASSERT_EQ(glGetError(), GLenum{GL_NO_ERROR});
        }
      }
    }
  }
}

// The finest level goes through the samples, is smooth between them, and large terrain is thinned.
TEST_F(TerrainTest, TexelsGoThroughTheSamples) {
  GroundTextures ground;
  FrameBlock block{};
  const auto wavy = [](double x, double y) { return 3.0 * std::sin(x / 40.0) + 0.1 * y; };
  const auto terrain = MakeTerrain(wavy, 61, 10.0);
  const Vec2d eye{37.0, -12.0};
  ground.Update(terrain, eye, 0.7, block);
  BindTexture(0, GL_TEXTURE_2D, ground.ground());
  GLint width = 0, rows = 0;
  glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &width);
  glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_HEIGHT, &rows);
  std::vector<float> texels(static_cast<std::size_t>(4 * width * rows));
  glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_FLOAT, texels.data());
  double worst_slope = 0.0;
  for (int j = 2; j < 59; ++j) {
    for (int i = 2; i < 59; ++i) {
      const Vec2d place{terrain->west_m + 10.0 * i, terrain->south_m + 10.0 * j};
      const double u =
          ((place.x - eye.x) * block.ground_place.z + block.ground_place.x) * width - 0.5;
      const double v =
          ((place.y - eye.y) * block.ground_place.w + block.ground_place.y) * rows - 0.5;
      ASSERT_NEAR(u, std::round(u), 2e-3);
      ASSERT_NEAR(v, std::round(v), 2e-3);
      const auto at = static_cast<std::size_t>(4 * (std::lround(v) * width + std::lround(u)));
      EXPECT_FLOAT_EQ(texels[at], terrain->elevation_m[static_cast<std::size_t>(j * 61 + i)]);
      worst_slope =
          std::max(worst_slope, std::abs(texels[at + 1] - 3.0 / 40.0 * std::cos(place.x / 40.0)));
      EXPECT_NEAR(texels[at + 2], 0.1, 1e-3);
    }
  }
  EXPECT_LT(worst_slope, 2e-3);
  EXPECT_LT(ground.texel_m(), 10.0);
  EXPECT_FLOAT_EQ(block.ground_noise.w, 0.7f);

  ground.Update(MakeTerrain(wavy, 4096, 2.0), eye, 0.0, block);
  EXPECT_LE(ground.columns(), GroundTextures::kSideMax);
  EXPECT_DOUBLE_EQ(ground.texel_m(), 4.0);
}

}  // namespace
}  // namespace onesea::render
