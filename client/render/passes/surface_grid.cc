#include "client/render/passes/surface_grid.h"

#include <cstdint>
#include <vector>

#include "common/base/check.h"

namespace onesea::render {

absl::StatusOr<SurfaceGridPass> SurfaceGridPass::Create() {
  auto open = ShaderProgram::Build({"frame.glsl", "depth.glsl", "surface_grid.vert.glsl"},
                                   {"frame.glsl", "surface_grid.frag.glsl"}, {"ATTENUATED 0"});
  if (!open.ok()) return open.status();
  auto attenuated = ShaderProgram::Build(
      {"frame.glsl", "attenuation.glsl", "depth.glsl", "surface_grid.vert.glsl"},
      {"frame.glsl", "surface_grid.frag.glsl"}, {"ATTENUATED 1"});
  if (!attenuated.ok()) return attenuated.status();
  return SurfaceGridPass(std::move(*open), std::move(*attenuated));
}

void SurfaceGridPass::Allocate(const Texture& texture, GLenum internal_format, GLenum format) {
  BindTexture(0, target(), texture);
  if (samples_ > 1) {
    glTexImage2DMultisample(target(), samples_, internal_format, width_, height_, GL_TRUE);
    return;
  }
  glTexImage2D(target(), 0, static_cast<GLint>(internal_format), width_, height_, 0, format,
               GL_FLOAT, nullptr);
  SetSampling(target(), GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE);
}

void SurfaceGridPass::Resize(int width, int height, int samples) {
  if (width == width_ && height == height_ && samples == samples_) return;
  width_ = width;
  height_ = height;
  if (samples != samples_) {  // a texture keeps the kind of its first binding
    surface_ = Texture();
    depth_ = Texture();
  }
  samples_ = samples;
  Allocate(surface_, GL_RGBA16F, GL_RGBA);
  Allocate(depth_, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, target(), surface_.id(), 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, target(), depth_.id(), 0);
  ONESEA_CHECK(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
}

void SurfaceGridPass::UpdateIndices(const OceanGrid& grid) {
  if (grid.columns == columns_ && grid.rows == rows_) return;
  columns_ = grid.columns;
  rows_ = grid.rows;
  std::vector<std::uint32_t> indices;
  indices.reserve(static_cast<std::size_t>(6 * (columns_ - 1) * (rows_ - 1)));
  // Near rows first, so that hidden water behind them fails the depth test early. Azimuth grows
  // counter-clockwise: this order faces up.
  for (int j = 0; j + 1 < rows_; ++j) {
    for (int i = 0; i + 1 < columns_; ++i) {
      const auto a = static_cast<std::uint32_t>(j * columns_ + i), b = a + 1;
      const auto c = a + static_cast<std::uint32_t>(columns_), d = c + 1;
      indices.insert(indices.end(), {a, c, b, b, c, d});
    }
  }
  index_count_ = static_cast<GLsizei>(indices.size());
  glBindVertexArray(vertices_.id());
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER,
               static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)), indices.data(),
               GL_DYNAMIC_DRAW);
}

void SurfaceGridPass::Draw(const OceanGrid& grid, const SeaTextures& sea,
                           const PatchTextures& patches, const AttenuationTexture& attenuation,
                           int width, int height, int samples) {
  Resize(width, height, samples);
  UpdateIndices(grid);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glViewport(0, 0, width, height);
  glClearColor(0, 0, 0, 0);
  glClearDepth(1.0);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  const ShaderProgram& program = attenuation.any() ? attenuated_ : open_;
  program.Use();
  BindTexture(0, GL_TEXTURE_2D_ARRAY, sea.displacement());
  program.SetSampler("displacement_map", 0);
  BindTexture(1, GL_TEXTURE_2D_ARRAY, patches.height());
  program.SetSampler("patch_height_map", 1);
  BindTexture(2, GL_TEXTURE_2D_ARRAY, attenuation.factors());
  program.SetSampler("attenuation_map", 2);
  glBindVertexArray(vertices_.id());
  glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
  glDisable(GL_DEPTH_TEST);
}

}  // namespace onesea::render
