// The interaction layer in the picture: where a wake is, and nowhere else.
#include <cmath>

#include "client/render/patch_textures.h"
#include "tests/render/gl_fixture.h"
#include "tests/render/test_sea.h"

namespace onesea::render {
namespace {

constexpr int kWidth = 320, kHeight = 180;
constexpr double kEyeM = 6.0, kPitch = -0.25, kFov = 0.785;

// A train of waves in a window of cosine shape: eta = A sin(k x) w(x) w(y).
struct Train {
  static constexpr int kColumns = 48, kRows = 40;
  static constexpr double kCell = 0.5, kWave = 1.1, kAmplitude = 0.25;
  Vec2d first{20.0, -6.0};
  std::vector<float> height, foam;

  Train() {
    for (int j = 0; j < kRows; ++j) {
      for (int i = 0; i < kColumns; ++i) {
        const double w =
            std::sin(3.14159265 * i / (kColumns - 1)) * std::sin(3.14159265 * j / (kRows - 1));
        height.push_back(static_cast<float>(kAmplitude * std::sin(kWave * i * kCell) * w * w));
      }
    }
  }
  WaterPatch Patch(std::uint64_t version = 1) const {
    return {first, kCell, kColumns, kRows, version, height, foam};
  }
};

class PatchesTest : public GlTest {
 protected:
  PatchesTest() : sea_(1e-4, 3.0, 2.6, 64) {
    sea_.FillFrame(12.0, frame_);
    frame_.camera = {{0, 0, kEyeM}, 0.0, kPitch, 0.0, kFov};
    frame_.weather.wind_speed_m_per_s = 2.0;
    frame_.weather.cloud_cover = 0.0;
    frame_.sun = {0.3, 0.5};
    frame_.quality.bloom = false;  // light would spread over the picture
  }

  // Where the ray through a pixel meets z = height; false above the horizon.
  static bool Meets(int x, int y, double height, Vec2d& place) {
    const double t = std::tan(0.5 * kFov);
    const double right = t * kWidth / kHeight * (2.0 * (x + 0.5) / kWidth - 1.0);
    const double up = t * (1.0 - 2.0 * (y + 0.5) / kHeight);
    const double forward = std::cos(kPitch) - up * std::sin(kPitch);
    const double z = std::sin(kPitch) + up * std::cos(kPitch);
    if (z >= -1e-3) return false;
    const double along = (height - kEyeM) / z;
    place = {along * forward, -along * right};
    return true;
  }

  TestSea sea_;
  Train train_;
  RenderFrame frame_;
};

int Difference(const Picture& a, const Picture& b, int x, int y) {
  int most = 0;
  for (int c = 0; c < 3; ++c) {
    const auto at = static_cast<std::size_t>((y * a.width + x) * 3 + c);
    most = std::max(most, std::abs(a.rgb[at] - b.rgb[at]));
  }
  return most;
}

TEST_F(PatchesTest, WakeChangesThePictureWhereItIsAndNowhereElse) {
  for (int samples : {1, 4}) {
    frame_.quality.samples = samples;
    frame_.patches.clear();
    const Picture calm = Draw(frame_, kWidth, kHeight);
    frame_.patches = {train_.Patch()};
    const Picture waves = Draw(frame_, kWidth, kHeight);
    int inside = 0, changed = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        // Far and near bounds of where the ray may meet waves of this height.
        const double reach = 2.0 * Train::kCell + 0.6;  // border, and a pixel of smoothed steps
        bool may = false;
        for (double height : {-0.3, 0.0, 0.3}) {
          Vec2d place;
          if (!Meets(x, y, height, place)) continue;
          const Vec2d off = place - train_.first;
          may |= off.x > -reach && off.y > -reach &&
                 off.x < Train::kColumns * Train::kCell + reach &&
                 off.y < Train::kRows * Train::kCell + reach;
        }
        const int difference = Difference(calm, waves, x, y);
        if (!may) {
          ASSERT_LE(difference, 1) << x << " " << y << ", " << samples << " samples";
        }
        Vec2d place;
        if (!Meets(x, y, 0.0, place)) continue;
        const Vec2d off = place - train_.first;
        if (off.x < 6 || off.x > 18 || off.y < 5 || off.y > 15) continue;
        ++inside;
        changed += difference > 3;
      }
    }
    EXPECT_GT(inside, 1000);
    EXPECT_GT(changed, inside * 6 / 10) << samples << " samples";
  }
}

TEST_F(PatchesTest, FlatPatchIsThePictureWithoutIt) {
  const Picture none = Draw(frame_, kWidth, kHeight);
  train_.height.assign(train_.height.size(), 0.0f);
  train_.foam.assign(train_.height.size(), 0.0f);
  frame_.patches = {train_.Patch()};
  const Picture flat = Draw(frame_, kWidth, kHeight);
  int most = 0;
  for (std::size_t n = 0; n < none.rgb.size(); ++n)
    most = std::max(most, std::abs(none.rgb[n] - flat.rgb[n]));
  EXPECT_LE(most, 1);  // another program, another rounding
}

TEST_F(PatchesTest, FoamWhitens) {
  frame_.sun = {3.0, 0.6};  // no glitter
  const Picture none = Draw(frame_, kWidth, kHeight);
  train_.height.assign(train_.height.size(), 0.0f);
  train_.foam.assign(train_.height.size(), 1.0f);
  frame_.patches = {train_.Patch()};
  const Picture white = Draw(frame_, kWidth, kHeight);
  double before = 0.0, after = 0.0;
  int count = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      Vec2d place;
      if (!Meets(x, y, 0.0, place)) continue;
      const Vec2d off = place - train_.first;
      if (off.x < 6 || off.x > 18 || off.y < 5 || off.y > 15) continue;
      ++count;
      before += none.rgb[static_cast<std::size_t>((y * kWidth + x) * 3)];
      after += white.rgb[static_cast<std::size_t>((y * kWidth + x) * 3)];
    }
  }
  EXPECT_GT(after / count, before / count + 60.0);
}

// What the shader reads is the height and its slope at the cells, faded towards the rim.
TEST_F(PatchesTest, TexelsAreHeightsAndCentralSlopes) {
  PatchTextures textures;
  FrameBlock block{};
  block.clip_from_world[3][3] = 1e6f;  // everything is in view
  textures.Update({train_.Patch()}, {}, block);
  EXPECT_EQ(block.counts.w, 1.0f);
  BindTexture(0, GL_TEXTURE_2D_ARRAY, textures.slope());
  GLint width = 0, rows = 0;
  glGetTexLevelParameteriv(GL_TEXTURE_2D_ARRAY, 0, GL_TEXTURE_WIDTH, &width);
  glGetTexLevelParameteriv(GL_TEXTURE_2D_ARRAY, 0, GL_TEXTURE_HEIGHT, &rows);
  std::vector<float> slope(static_cast<std::size_t>(4 * width * rows));
  glGetTexImage(GL_TEXTURE_2D_ARRAY, 0, GL_RGBA, GL_FLOAT, slope.data());
  for (int j = 10; j < Train::kRows - 10; ++j) {
    for (int i = 10; i < Train::kColumns - 10; ++i) {
      // The coordinate of the cell's own place must be the centre of its texel.
      const Vec2d place = train_.first + Vec2d{i * Train::kCell, j * Train::kCell};
      const double u = (place.x * block.patch_map[0].z + block.patch_map[0].x) * width - 0.5;
      const double v = (place.y * block.patch_map[0].w + block.patch_map[0].y) * rows - 0.5;
      const auto column = std::lround(u), row = std::lround(v);
      ASSERT_NEAR(u, static_cast<double>(column), 1e-3);
      ASSERT_NEAR(v, static_cast<double>(row), 1e-3);
      const auto at = [&](int di, int dj) {
        return train_.height[static_cast<std::size_t>((j + dj) * Train::kColumns + i + di)];
      };
      const float* texel = &slope[static_cast<std::size_t>(4 * (row * width + column))];
      EXPECT_NEAR(texel[0], (at(1, 0) - at(-1, 0)) / (2 * Train::kCell), 1e-5);
      EXPECT_NEAR(texel[1], (at(0, 1) - at(0, -1)) / (2 * Train::kCell), 1e-5);
    }
  }
}

TEST_F(PatchesTest, OnlyChangedPatchesAreUploaded) {
  PatchTextures textures;
  FrameBlock block{};
  block.clip_from_world[3][3] = 1e6f;
  Train other;
  other.first = {200, 50};
  textures.Update({train_.Patch(1), other.Patch(1)}, {}, block);
  EXPECT_EQ(textures.uploads(), 2);
  textures.Update({other.Patch(1), train_.Patch(1)}, {5, 5}, block);
  EXPECT_EQ(textures.uploads(), 2);
  textures.Update({other.Patch(1), train_.Patch(2)}, {5, 5}, block);
  EXPECT_EQ(textures.uploads(), 3);
  textures.Update({}, {}, block);
  EXPECT_EQ(block.counts.w, 0.0f);
}

}  // namespace
}  // namespace onesea::render
