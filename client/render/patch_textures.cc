#include "client/render/patch_textures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/base/check.h"

namespace onesea::render {
namespace {

constexpr int kBorder = 2;  // cells around a patch where its slopes end
constexpr int kMips = 6;
constexpr int kUnit = 1 << (kMips - 1);  // sides are multiples, so that mips keep their places
constexpr double kReachM = 10.0;         // of waves above and below the mean level

int RoundUp(int cells) { return (cells + kUnit - 1) / kUnit * kUnit; }

void AllocateArray(const Texture& texture, GLint format, GLenum channels, int width, int rows,
                   int layers) {
  BindTexture(0, GL_TEXTURE_2D_ARRAY, texture);
  for (int level = 0; level < kMips; ++level) {
    glTexImage3D(GL_TEXTURE_2D_ARRAY, level, format, std::max(1, width >> level),
                 std::max(1, rows >> level), layers, 0, channels, GL_FLOAT, nullptr);
  }
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, kMips - 1);
  SetSampling(GL_TEXTURE_2D_ARRAY, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_CLAMP_TO_BORDER);
}

// Halves (rows x width) texels of `channels` floats in place.
void Halve(std::vector<float>& texels, std::size_t width, std::size_t rows, std::size_t channels) {
  float* out = texels.data();
  const std::size_t stride = width * channels;
  for (std::size_t y = 0; y + 1 < rows; y += 2) {
    for (std::size_t x = 0; x + 1 < width; x += 2) {
      std::array<float, 4> mean{};
      for (std::size_t c = 0; c < channels; ++c) {
        const float* at = &texels[y * stride + x * channels + c];
        mean[c] = 0.25f * (at[0] + at[channels] + at[stride] + at[stride + channels]);
      }
      out = std::copy_n(mean.begin(), channels, out);
    }
  }
}

void UploadLevels(const Texture& texture, int layer, int width, int rows, GLenum format,
                  std::size_t channels, std::vector<float>& texels) {
  BindTexture(0, GL_TEXTURE_2D_ARRAY, texture);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  for (int level = 0; level < kMips; ++level) {
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, level, 0, 0, layer, width >> level, rows >> level, 1,
                    format, GL_FLOAT, texels.data());
    Halve(texels, static_cast<std::size_t>(width >> level), static_cast<std::size_t>(rows >> level),
          channels);
  }
}

// 0 at the rim, 1 from `reach` cells inwards.
std::vector<float> Fade(int cells) {
  const int reach = std::clamp(cells / 4, 1, 6);
  std::vector<float> fade(static_cast<std::size_t>(cells));
  for (int n = 0; n < cells; ++n) {
    const float inwards = static_cast<float>(std::min(n, cells - 1 - n)) + 0.5f;
    const float t = std::min(1.0f, inwards / static_cast<float>(reach));
    fade[static_cast<std::size_t>(n)] = t * t * (3.0f - 2.0f * t);
  }
  return fade;
}

bool SameContent(const WaterPatch& a, const WaterPatch& b) {
  return a.first_cell_m == b.first_cell_m && a.cell_m == b.cell_m && a.columns == b.columns &&
         a.rows == b.rows && a.version == b.version;
}

bool CanBeSeen(const WaterPatch& patch, Vec2d eye, const FrameBlock& block) {
  // Out of view if all corners of its box lie beyond the same side of the view.
  const Vec2d low = patch.first_cell_m - eye;
  std::array<int, 5> outside{};
  for (int corner = 0; corner < 8; ++corner) {
    const double x = low.x + (corner & 1 ? patch.columns * patch.cell_m : 0.0);
    const double y = low.y + (corner & 2 ? patch.rows * patch.cell_m : 0.0);
    const glm::vec4 clip =
        block.clip_from_world * glm::vec4(x, y, corner & 4 ? kReachM : -kReachM, 1.0);
    outside[0] += clip.x < -clip.w;
    outside[1] += clip.x > clip.w;
    outside[2] += clip.y < -clip.w;
    outside[3] += clip.y > clip.w;
    outside[4] += clip.w < 0.0f;
  }
  return *std::max_element(outside.begin(), outside.end()) < 8;
}

}  // namespace

PatchTextures::PatchTextures() { Reserve(1, 1, 1); }

void PatchTextures::Reserve(int columns, int rows, int layers) {
  const int width = std::max(width_, RoundUp(columns)), height = std::max(rows_, RoundUp(rows));
  const std::size_t count = std::max(layers_.size(), static_cast<std::size_t>(layers));
  if (width == width_ && height == rows_ && count == layers_.size()) return;
  width_ = width;
  rows_ = height;
  layers_.assign(count, {});
  AllocateArray(height_, GL_R32F, GL_RED, width_, rows_, static_cast<int>(count));
  AllocateArray(slope_, GL_RGBA32F, GL_RGBA, width_, rows_, static_cast<int>(count));
}

void PatchTextures::Upload(const WaterPatch& patch, int layer) {
  const auto width = static_cast<std::size_t>(width_);
  const auto columns = static_cast<std::size_t>(patch.columns);
  const std::vector<float> fade_x = Fade(patch.columns), fade_y = Fade(patch.rows);
  eta_.assign(width * static_cast<std::size_t>(rows_), 0.0f);
  texels_.assign(4 * eta_.size(), 0.0f);
  for (std::size_t j = 0; j < static_cast<std::size_t>(patch.rows); ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      const std::size_t at = (j + kBorder) * width + i + kBorder;
      const float fade = fade_x[i] * fade_y[j];
      eta_[at] = fade * patch.height_m[j * columns + i];
      if (!patch.foam.empty()) texels_[4 * at + 2] = fade * patch.foam[j * columns + i];
    }
  }
  const float scale = static_cast<float>(0.5 / patch.cell_m);
  for (std::size_t j = 1; j < static_cast<std::size_t>(patch.rows) + 2 * kBorder - 1; ++j) {
    for (std::size_t i = 1; i < columns + 2 * kBorder - 1; ++i) {
      const std::size_t at = j * width + i;
      const float sx = scale * (eta_[at + 1] - eta_[at - 1]);
      const float sy = scale * (eta_[at + width] - eta_[at - width]);
      texels_[4 * at] = sx;
      texels_[4 * at + 1] = sy;
      texels_[4 * at + 3] = sx * sx + sy * sy;
    }
  }
  UploadLevels(slope_, layer, width_, rows_, GL_RGBA, 4, texels_);
  UploadLevels(height_, layer, width_, rows_, GL_RED, 1, eta_);
  ++uploads_;
}

void PatchTextures::Update(const std::vector<WaterPatch>& patches, Vec2d eye, FrameBlock& block) {
  std::vector<const WaterPatch*> seen;
  int columns = 1, rows = 1;
  for (const WaterPatch& patch : patches) {
    if (seen.size() == kRenderPatchesMax) break;
    const std::size_t cells = static_cast<std::size_t>(patch.columns) * patch.rows;
    ONESEA_CHECK(patch.height_m.size() == cells && patch.cell_m > 0.0);
    ONESEA_CHECK(patch.foam.empty() || patch.foam.size() == cells);
    if (cells == 0 || !CanBeSeen(patch, eye, block)) continue;
    seen.push_back(&patch);
    columns = std::max(columns, patch.columns + 2 * kBorder);
    rows = std::max(rows, patch.rows + 2 * kBorder);
  }
  block.counts.w = static_cast<float>(seen.size());
  if (seen.empty()) return;
  Reserve(columns, rows, static_cast<int>(seen.size()));

  std::array<int, kRenderPatchesMax> layer_of;
  layer_of.fill(-1);
  std::vector<bool> taken(layers_.size(), false);
  for (std::size_t n = 0; n < seen.size(); ++n) {
    for (std::size_t l = 0; l < layers_.size() && layer_of[n] < 0; ++l) {
      if (taken[l] || !layers_[l].filled || !SameContent(layers_[l].patch, *seen[n])) continue;
      layer_of[n] = static_cast<int>(l);
      taken[l] = true;
    }
  }
  for (std::size_t n = 0; n < seen.size(); ++n) {
    if (layer_of[n] < 0) {
      const auto free = std::find(taken.begin(), taken.end(), false);
      const auto l = static_cast<std::size_t>(free - taken.begin());
      taken[l] = true;
      layer_of[n] = static_cast<int>(l);
      Upload(*seen[n], layer_of[n]);
      layers_[l] = {*seen[n], true};
    }
    const WaterPatch& patch = *seen[n];
    const Vec2d from_first = eye - patch.first_cell_m;
    const double texel = patch.cell_m;
    block.patch_map[n] = {static_cast<float>((from_first.x / texel + kBorder + 0.5) / width_),
                          static_cast<float>((from_first.y / texel + kBorder + 0.5) / rows_),
                          static_cast<float>(1.0 / (texel * width_)),
                          static_cast<float>(1.0 / (texel * rows_))};
    block.patch_cell[n] = {static_cast<float>(std::log2(texel)), static_cast<float>(layer_of[n]), 0,
                           0};
  }
}

double LargestHeightM(const std::vector<WaterPatch>& patches) {
  float largest = 0.0f;
  for (const WaterPatch& patch : patches) {
    for (float height : patch.height_m) largest = std::max(largest, std::abs(height));
  }
  return static_cast<double>(largest);
}

}  // namespace onesea::render
