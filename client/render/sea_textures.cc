#include "client/render/sea_textures.h"

#include <bit>

#include "common/base/check.h"

namespace onesea::render {
namespace {

void AllocateArray(const Texture& texture, int grid_size, int layers) {
  BindTexture(0, GL_TEXTURE_2D_ARRAY, texture);
  int level = 0;
  for (int side = grid_size; side >= 1; side /= 2, ++level) {
    glTexImage3D(GL_TEXTURE_2D_ARRAY, level, GL_RGBA16F, side, side, layers, 0, GL_RGBA,
                 GL_HALF_FLOAT, nullptr);
  }
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, level - 1);
  SetSampling(GL_TEXTURE_2D_ARRAY, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_REPEAT);
}

void UploadLayer(const Texture& texture, int layer, int grid_size, const float* texels) {
  BindTexture(0, GL_TEXTURE_2D_ARRAY, texture);
  glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, layer, grid_size, grid_size, 1, GL_RGBA, GL_FLOAT,
                  texels);
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
    UploadLayer(displacement_, layer, grid_size_, texels_.data());
    out = texels_.data();
    for (std::size_t n = 0; n < count; ++n, out += 4) {
      const float sx = planes.slope_x[n], sy = planes.slope_y[n];
      out[0] = sx;
      out[1] = sy;
      out[2] = planes.jacobian_xx[n] + planes.jacobian_yy[n];
      out[3] = sx * sx + sy * sy;
    }
    UploadLayer(slope_, layer, grid_size_, texels_.data());
  }
}

void SeaTextures::MakeMips() {
  for (const Texture* texture : {&displacement_, &slope_}) {
    BindTexture(0, GL_TEXTURE_2D_ARRAY, *texture);
    glGenerateMipmap(GL_TEXTURE_2D_ARRAY);
  }
}

}  // namespace onesea::render
