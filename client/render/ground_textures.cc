#include "client/render/ground_textures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "client/render/foam_texture.h"

namespace onesea::render {
namespace {

constexpr int kUnit = 1 << (GroundTextures::kMips - 1);  // mips of whole units keep their places
constexpr int kRefineMax = 4;
constexpr double kNoisePeriodM = 4096.0;

int RoundUp(int texels) { return (texels + kUnit - 1) / kUnit * kUnit; }

// Samples of one line: every `stride`th, or `refine` - 1 more between two.
struct Line {
  int stride = 1, refine = 1, count = 0;
};

Line FitLine(int samples, int side) {
  Line line;
  while ((side - 1) / line.stride + 1 > GroundTextures::kSideMax) line.stride *= 2;
  while (line.refine < kRefineMax && (side - 1) * line.refine * 2 < GroundTextures::kSideMax) {
    line.refine *= 2;
  }
  line.count = (samples - 1) / line.stride * line.refine + 1;
  return line;
}

// Catmull & Rom 1974: through the samples, with continuous slopes.
std::array<float, 4> CubicWeights(float t) {
  const float t2 = t * t, t3 = t2 * t;
  return {0.5f * (-t3 + 2 * t2 - t), 0.5f * (3 * t3 - 5 * t2 + 2), 0.5f * (-3 * t3 + 4 * t2 + t),
          0.5f * (t3 - t2)};
}

// Resamples `lines` lines of `samples` values that lie `step` apart, the lines `next` apart.
std::vector<float> Resample(const std::vector<float>& in, int samples, int lines,
                            const Line& line) {
  std::vector<float> out(static_cast<std::size_t>(line.count) * static_cast<std::size_t>(lines));
  for (int l = 0; l < lines; ++l) {
    const float* row = &in[static_cast<std::size_t>(l) * static_cast<std::size_t>(samples)];
    // Turned: what were rows are columns, so that the other axis is resampled by the same code.
    for (int n = 0; n < line.count; ++n) {
      const int at = n / line.refine * line.stride;
      const auto sample = [&](int k) { return row[std::clamp(k, 0, samples - 1)]; };
      float value = sample(at);
      if (n % line.refine != 0) {
        const auto w =
            CubicWeights(static_cast<float>(n % line.refine) / static_cast<float>(line.refine));
        value = w[0] * sample(at - 1) + w[1] * sample(at) + w[2] * sample(at + 1) +
                w[3] * sample(at + 2);
        // Walls and quays must not swing over.
        const float a = sample(at), b = sample(at + 1);
        value = std::clamp(value, std::min(a, b), std::max(a, b));
      }
      out[static_cast<std::size_t>(n) * static_cast<std::size_t>(lines) +
          static_cast<std::size_t>(l)] = value;
    }
  }
  return out;
}

// Halves (height x width) texels of elevation, slopes, relief in place.
void Halve(std::vector<float>& texels, std::size_t width, std::size_t height) {
  float* out = texels.data();
  for (std::size_t y = 0; y + 1 < height; y += 2) {
    for (std::size_t x = 0; x + 1 < width; x += 2) {
      const float* a = &texels[4 * (y * width + x)];
      const float *b = a + 4, *c = a + 4 * width, *d = c + 4;
      std::array<float, 4> mean;
      for (std::size_t n = 0; n < 4; ++n) mean[n] = 0.25f * (a[n] + b[n] + c[n] + d[n]);
      mean[3] = 0.5f * (mean[3] + std::max({a[3], b[3], c[3], d[3]}));
      out = std::copy(mean.begin(), mean.end(), out);
    }
  }
}

}  // namespace

void GroundTextures::MakeGrain() {
  constexpr int kSide = kFoamTextureSize;
  const std::vector<std::uint8_t> noise = MakeCloudTexture(kSide), walls = MakeFoamTexture();
  std::vector<std::uint8_t> texels;
  texels.reserve(4 * noise.size());
  const auto at = [&](int x, int y) {
    return noise[static_cast<std::size_t>((y & (kSide - 1)) * kSide + (x & (kSide - 1)))];
  };
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const int dx = at(x + 1, y) - at(x - 1, y), dy = at(x, y + 1) - at(x, y - 1);
      texels.push_back(at(x, y));
      texels.push_back(static_cast<std::uint8_t>(std::clamp(128 + 2 * dx, 0, 255)));
      texels.push_back(static_cast<std::uint8_t>(std::clamp(128 + 2 * dy, 0, 255)));
      texels.push_back(walls[static_cast<std::size_t>(y * kSide + x)]);
    }
  }
  BindTexture(0, GL_TEXTURE_2D, grain_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, kSide, kSide, 0, GL_RGBA, GL_UNSIGNED_BYTE,
               texels.data());
  SetSampling(GL_TEXTURE_2D, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_REPEAT);
  glGenerateMipmap(GL_TEXTURE_2D);
}

void GroundTextures::Upload(const sea::Terrain& terrain) {
  const int side = std::max(terrain.columns, terrain.rows);
  const Line across = FitLine(terrain.columns, side), along = FitLine(terrain.rows, side);
  const std::vector<float> turned =
      Resample(terrain.elevation_m, terrain.columns, terrain.rows, across);
  std::vector<float> elevation = Resample(turned, terrain.rows, across.count, along);
  columns_ = across.count;
  rows_ = along.count;
  first_m_ = {terrain.west_m, terrain.south_m};
  texel_m_ = terrain.cell_m * across.stride / across.refine;
  width_ = RoundUp(columns_);
  height_ = RoundUp(rows_);
  FindRanges(elevation);
  // What is beyond the terrain is as its edge.
  std::vector<float> padded(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      padded[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
             static_cast<std::size_t>(x)] =
          elevation[static_cast<std::size_t>(std::min(y, rows_ - 1)) *
                        static_cast<std::size_t>(columns_) +
                    static_cast<std::size_t>(std::min(x, columns_ - 1))];
    }
  }
  UploadLevels(padded);
}

void GroundTextures::FindRanges(const std::vector<float>& elevation) {
  tiles_.clear();
  TileLevel finest;
  finest.columns = (columns_ - 2) / kTileQuads + 1;
  finest.rows = (rows_ - 2) / kTileQuads + 1;
  finest.ranges.resize(static_cast<std::size_t>(finest.columns) *
                       static_cast<std::size_t>(finest.rows));
  for (int y = 0; y < rows_; ++y) {
    for (int x = 0; x < columns_; ++x) {
      const float z = elevation[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                                static_cast<std::size_t>(x)];
      // Texels on the border of tiles are in all of them.
      for (int j = std::max(y - 1, 0) / kTileQuads; j <= std::min(y / kTileQuads, finest.rows - 1);
           ++j) {
        for (int i = std::max(x - 1, 0) / kTileQuads;
             i <= std::min(x / kTileQuads, finest.columns - 1); ++i) {
          Range& range = finest.ranges[static_cast<std::size_t>(j * finest.columns + i)];
          range.low_m = std::min(range.low_m, z);
          range.high_m = std::max(range.high_m, z);
        }
      }
    }
  }
  tiles_.push_back(std::move(finest));
  while (tiles_.back().columns > 1 || tiles_.back().rows > 1) {
    const TileLevel& fine = tiles_.back();
    TileLevel coarse;
    coarse.columns = (fine.columns + 1) / 2;
    coarse.rows = (fine.rows + 1) / 2;
    coarse.ranges.resize(static_cast<std::size_t>(coarse.columns) *
                         static_cast<std::size_t>(coarse.rows));
    for (int j = 0; j < fine.rows; ++j) {
      for (int i = 0; i < fine.columns; ++i) {
        const Range& from = fine.ranges[static_cast<std::size_t>(j * fine.columns + i)];
        Range& range = coarse.ranges[static_cast<std::size_t>(j / 2 * coarse.columns + i / 2)];
        range.low_m = std::min(range.low_m, from.low_m);
        range.high_m = std::max(range.high_m, from.high_m);
      }
    }
    tiles_.push_back(std::move(coarse));
  }
}

GroundTextures::Range GroundTextures::RangeOf(int level, int column, int row) const {
  const TileLevel& tiles = tiles_[static_cast<std::size_t>(level)];
  if (column >= tiles.columns || row >= tiles.rows) return {};
  return tiles.ranges[static_cast<std::size_t>(row * tiles.columns + column)];
}

void GroundTextures::UploadLevels(const std::vector<float>& elevation) {
  const auto width = static_cast<std::size_t>(width_), height = static_cast<std::size_t>(height_);
  std::vector<float> texels(4 * width * height);
  const float scale = static_cast<float>(0.5 / texel_m_);
  for (std::size_t y = 0; y < height; ++y) {
    const std::size_t south = y > 0 ? y - 1 : y, north = std::min(y + 1, height - 1);
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t west = x > 0 ? x - 1 : x, east = std::min(x + 1, width - 1);
      float* texel = &texels[4 * (y * width + x)];
      texel[0] = texel[3] = elevation[y * width + x];
      texel[1] = scale * (elevation[y * width + east] - elevation[y * width + west]);
      texel[2] = scale * (elevation[north * width + x] - elevation[south * width + x]);
    }
  }
  BindTexture(0, GL_TEXTURE_2D, ground_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  for (int level = 0; level < kMips; ++level) {
    glTexImage2D(GL_TEXTURE_2D, level, GL_RGBA32F, width_ >> level, height_ >> level, 0, GL_RGBA,
                 GL_FLOAT, texels.data());
    Halve(texels, width >> level, height >> level);
  }
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, kMips - 1);
  SetSampling(GL_TEXTURE_2D, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE);
}

void GroundTextures::Update(const std::shared_ptr<const sea::Terrain>& terrain, Vec2d eye,
                            double water_level_m, FrameBlock& block) {
  if (terrain != terrain_) {
    if (terrain_ == nullptr) MakeGrain();
    Upload(*terrain);
    terrain_ = terrain;
  }
  const auto to_float = [](double value) { return static_cast<float>(value); };
  const Vec2d from_first = eye - first_m_;
  block.ground_place = {to_float((from_first.x / texel_m_ + 0.5) / width_),
                        to_float((from_first.y / texel_m_ + 0.5) / height_),
                        to_float(1.0 / (texel_m_ * width_)), to_float(1.0 / (texel_m_ * height_))};
  block.ground_area = {to_float(-from_first.x), to_float(-from_first.y),
                       to_float((columns_ - 1) * texel_m_ - from_first.x),
                       to_float((rows_ - 1) * texel_m_ - from_first.y)};
  const auto wrapped = [&](double metres) {
    return to_float(metres - kNoisePeriodM * std::floor(metres / kNoisePeriodM));
  };
  block.ground_noise = {wrapped(eye.x), wrapped(eye.y), to_float(std::log2(texel_m_)),
                        to_float(water_level_m)};
}

}  // namespace onesea::render
