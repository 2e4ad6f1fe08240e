#include "client/render/sea_textures.h"

#include <algorithm>
#include <array>
#include <bit>

#include "common/base/check.h"

namespace onesea::render {
namespace {

void AllocateArray(const Texture& texture, int grid_size, int layers) {
  BindTexture(0, GL_TEXTURE_2D_ARRAY, texture);
  int level = 0;
  for (int side = grid_size; side >= 1; side /= 2, ++level) {
    glTexImage3D(GL_TEXTURE_2D_ARRAY, level, GL_RGBA32F, side, side, layers, 0, GL_RGBA, GL_FLOAT,
                 nullptr);
  }
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, level - 1);
  SetSampling(GL_TEXTURE_2D_ARRAY, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_REPEAT);
}

// Halves (side x side) texels of four floats in place. What is written has been read already.
void Halve(std::vector<float>& texels, std::size_t side) {
  float* out = texels.data();
  for (std::size_t y = 0; y < side; y += 2) {
    const float* row = &texels[4 * y * side];
    for (std::size_t x = 0; x < side; x += 2, row += 8, out += 4) {
      std::array<float, 4> mean;
      for (std::size_t c = 0; c < 4; ++c) {
        mean[c] = 0.25f * (row[c] + row[c + 4] + row[c + 4 * side] + row[c + 4 * side + 4]);
      }
      std::copy(mean.begin(), mean.end(), out);
    }
  }
}

// All levels of one layer; leaves the coarsest in `texels`. Made here because a driver without a
// graphics card draws each level of each layer as a picture of its own: 4 ms, this is under one.
void UploadLayer(const Texture& texture, int layer, int grid_size, std::vector<float>& texels) {
  BindTexture(0, GL_TEXTURE_2D_ARRAY, texture);
  int level = 0;
  for (int side = grid_size; side >= 1; side /= 2, ++level) {
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, level, 0, 0, layer, side, side, 1, GL_RGBA, GL_FLOAT,
                    texels.data());
    if (side > 1) Halve(texels, static_cast<std::size_t>(side));
  }
}

}  // namespace

void SeaTextures::Allocate(int grid_size, int layers) {
  if (grid_size == grid_size_ && layers == layers_) return;
  ONESEA_CHECK(std::has_single_bit(static_cast<unsigned>(grid_size)));
  ONESEA_CHECK(layers >= 1 && layers <= kRenderCascadesMax);
  grid_size_ = grid_size;
  layers_ = layers;
  texels_.resize(static_cast<std::size_t>(grid_size) * static_cast<std::size_t>(grid_size) * 4);
  AllocateArray(displacement_, grid_size, layers);
  AllocateArray(slope_, grid_size, layers);
}

void SeaTextures::Upload(const std::vector<CascadePlanes>& cascades) {
  ONESEA_CHECK(!cascades.empty());
  Allocate(cascades[0].grid_size, static_cast<int>(cascades.size()));
  const std::size_t count = texels_.size() / 4;
  for (int layer = 0; layer < layers_; ++layer) {
    const CascadePlanes& planes = cascades[static_cast<std::size_t>(layer)];
    ONESEA_CHECK(planes.grid_size == grid_size_ && planes.height.size() == count);
    float* out = texels_.data();
    for (std::size_t n = 0; n < count; ++n, out += 4) {
      out[0] = planes.displacement_x[n];
      out[1] = planes.displacement_y[n];
      out[2] = planes.height[n];
      out[3] = 0;
    }
    UploadLayer(displacement_, layer, grid_size_, texels_);
    out = texels_.data();
    for (std::size_t n = 0; n < count; ++n, out += 4) {
      const float sx = planes.slope_x[n], sy = planes.slope_y[n];
      out[0] = sx;
      out[1] = sy;
      out[2] = planes.jacobian_xx[n] + planes.jacobian_yy[n];
      out[3] = sx * sx + sy * sy;
    }
    UploadLayer(slope_, layer, grid_size_, texels_);
  }
}

}  // namespace onesea::render
