#include "client/render/sea_textures.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "common/base/check.h"

namespace onesea::render {
namespace {

void AllocateArray(const Texture& texture, int grid_size, int layers, GLint minify) {
  BindTexture(0, GL_TEXTURE_2D_ARRAY, texture);
  int level = 0;
  for (int side = grid_size; side >= 1; side /= 2, ++level) {
    glTexImage3D(GL_TEXTURE_2D_ARRAY, level, GL_RGBA16F, side, side, layers, 0, GL_RGBA,
                 GL_HALF_FLOAT, nullptr);
  }
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, level - 1);
  SetSampling(GL_TEXTURE_2D_ARRAY, minify, GL_LINEAR, GL_REPEAT);
}

void UploadLayer(const Texture& texture, int layer, int grid_size, const std::uint16_t* texels) {
  BindTexture(0, GL_TEXTURE_2D_ARRAY, texture);
  glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, layer, grid_size, grid_size, 1, GL_RGBA,
                  GL_HALF_FLOAT, texels);
}

}  // namespace

std::uint16_t HalfBits(float value) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
  const std::uint32_t sign = (bits >> 16) & 0x8000U;
  const float magnitude = std::min(std::bit_cast<float>(bits & 0x7fffffffU), 65504.0f);
  const std::uint32_t wide = std::bit_cast<std::uint32_t>(magnitude);
  // Exponent bias 127 becomes 15; the added constant rounds the 13 bits that fall off to even.
  const std::uint32_t normal = (wide - (112U << 23) + 0x0fffU + ((wide >> 13) & 1U)) >> 13;
  // The last bit of 0.5f weighs as much as that of a subnormal half: adding lets the adder round.
  const std::uint32_t subnormal = std::bit_cast<std::uint32_t>(magnitude + 0.5f) - 0x3f000000U;
  return static_cast<std::uint16_t>(sign | (magnitude < 0x1p-14f ? subnormal : normal));
}

void SeaTextures::Allocate(int grid_size, int layers) {
  if (grid_size == grid_size_ && layers == layers_) return;
  ONESEA_CHECK(std::has_single_bit(static_cast<unsigned>(grid_size)));
  ONESEA_CHECK(layers >= 1 && layers <= kRenderCascadesMax);
  grid_size_ = grid_size;
  layers_ = layers;
  texels_.resize(static_cast<std::size_t>(grid_size) * static_cast<std::size_t>(grid_size) * 4);
  AllocateArray(displacement_, grid_size, layers, GL_LINEAR_MIPMAP_LINEAR);
  AllocateArray(slope_, grid_size, layers, GL_LINEAR_MIPMAP_LINEAR);
  // Roughness may step a little from level to level: half the fetches, and nobody sees it.
  AllocateArray(moment_, grid_size, layers, GL_LINEAR_MIPMAP_NEAREST);
}

void SeaTextures::Upload(const std::vector<CascadePlanes>& cascades) {
  ONESEA_CHECK(!cascades.empty());
  Allocate(cascades[0].grid_size, static_cast<int>(cascades.size()));
  const std::size_t count = texels_.size() / 4;
  for (int layer = 0; layer < layers_; ++layer) {
    const CascadePlanes& planes = cascades[static_cast<std::size_t>(layer)];
    ONESEA_CHECK(planes.grid_size == grid_size_ && planes.height.size() == count);
    std::uint16_t* out = texels_.data();
    for (std::size_t n = 0; n < count; ++n, out += 4) {
      out[0] = HalfBits(planes.displacement_x[n]);
      out[1] = HalfBits(planes.displacement_y[n]);
      out[2] = HalfBits(planes.height[n]);
      out[3] = 0;
    }
    UploadLayer(displacement_, layer, grid_size_, texels_.data());
    out = texels_.data();
    for (std::size_t n = 0; n < count; ++n, out += 4) {
      out[0] = HalfBits(planes.slope_x[n]);
      out[1] = HalfBits(planes.slope_y[n]);
      out[2] = HalfBits(planes.jacobian_xx[n]);
      out[3] = HalfBits(planes.jacobian_yy[n]);
    }
    UploadLayer(slope_, layer, grid_size_, texels_.data());
    out = texels_.data();
    for (std::size_t n = 0; n < count; ++n, out += 4) {
      const float sx = planes.slope_x[n], sy = planes.slope_y[n];
      out[0] = HalfBits(planes.jacobian_xy[n]);
      out[1] = HalfBits(sx * sx);
      out[2] = HalfBits(sy * sy);
      out[3] = HalfBits(sx * sy);
    }
    UploadLayer(moment_, layer, grid_size_, texels_.data());
  }
}

void SeaTextures::MakeMips() {
  for (const Texture* texture : {&displacement_, &slope_, &moment_}) {
    BindTexture(0, GL_TEXTURE_2D_ARRAY, *texture);
    glGenerateMipmap(GL_TEXTURE_2D_ARRAY);
  }
}

}  // namespace onesea::render
