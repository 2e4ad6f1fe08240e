#include "client/render/attenuation_texture.h"

#include <algorithm>
#include <vector>

#include "common/base/check.h"

namespace onesea::render {

AttenuationTexture::AttenuationTexture() { UploadOne(); }

void AttenuationTexture::UploadOne() {
  sea::AttenuationGrid one;
  one.columns = one.rows = one.planes = 1;
  one.factor = {1.0f};
  Upload(one);
}

void AttenuationTexture::Upload(const sea::AttenuationGrid& grid) {
  const auto cells = static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows);
  const auto planes = static_cast<std::size_t>(grid.planes);
  ONESEA_CHECK(planes >= 1 && grid.factor.size() == cells * planes);
  // Planes that the grid hasn't are left alone.
  std::vector<float> texels(4 * cells * kLayers, 1.0f);
  for (std::size_t plane = 0; plane < std::min<std::size_t>(planes, 4 * kLayers); ++plane) {
    float* out = &texels[plane / 4 * 4 * cells + plane % 4];
    for (std::size_t n = 0; n < cells; ++n) out[4 * n] = grid.factor[n * planes + plane];
  }
  BindTexture(0, GL_TEXTURE_2D_ARRAY, factors_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_RGBA16F, grid.columns, grid.rows, kLayers, 0, GL_RGBA,
               GL_FLOAT, texels.data());
  SetSampling(GL_TEXTURE_2D_ARRAY, GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE);
}

void AttenuationTexture::Update(const std::shared_ptr<const sea::AttenuationGrid>& grid, Vec2d eye,
                                FrameBlock& block) {
  if (grid == nullptr || grid->factor.empty()) {
    if (grid_ != nullptr) UploadOne();
    grid_ = nullptr;
    return;
  }
  if (grid != grid_) Upload(*grid);
  grid_ = grid;
  const auto offset = [&](double from, int cells) {
    return static_cast<float>((from / grid->cell_m + 0.5) / cells);
  };
  block.attenuation_place = {offset(eye.x - grid->west_m, grid->columns),
                             offset(eye.y - grid->south_m, grid->rows),
                             static_cast<float>(1.0 / (grid->cell_m * grid->columns)),
                             static_cast<float>(1.0 / (grid->cell_m * grid->rows))};
}

}  // namespace onesea::render
