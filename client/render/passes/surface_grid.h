#pragma once

#include "absl/status/statusor.h"
#include "client/render/attenuation_texture.h"
#include "client/render/gl_objects.h"
#include "client/render/ocean_grid.h"
#include "client/render/patch_textures.h"
#include "client/render/sea_textures.h"
#include "client/render/shader_program.h"

namespace onesea::render {

/// Draws the displaced lattice into a picture of (displacement, distance): what the surface
/// pass shades once per pixel. Shading here would shade the blocks of each
/// small triangle anew.
class SurfaceGridPass {
 public:
  static absl::StatusOr<SurfaceGridPass> Create();

  /// Leaves its framebuffer bound: what else has a surface may be drawn into it.
  void Draw(const OceanGrid& grid, const SeaTextures& sea, const PatchTextures& patches,
            const AttenuationTexture& attenuation, int width, int height, int samples);

  const Texture& surface() const { return surface_; }
  /// Of a picture of one sample per pixel.
  const Texture& depth() const { return depth_; }
  GLenum target() const { return samples_ > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D; }

 private:
  SurfaceGridPass(ShaderProgram open, ShaderProgram attenuated)
      : open_(std::move(open)), attenuated_(std::move(attenuated)) {}
  void Allocate(const Texture& texture, GLenum internal_format, GLenum format);
  void Resize(int width, int height, int samples);
  void UpdateIndices(const OceanGrid& grid);

  ShaderProgram open_, attenuated_;
  Texture surface_, depth_;
  Framebuffer framebuffer_;
  VertexArray vertices_;
  Buffer indices_;
  int width_ = 0, height_ = 0, samples_ = 0;
  int columns_ = 0, rows_ = 0;
  GLsizei index_count_ = 0;
};

}  // namespace onesea::render
