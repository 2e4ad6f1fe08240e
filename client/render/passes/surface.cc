#include "client/render/passes/surface.h"

#include "client/render/foam_texture.h"

namespace onesea::render {

absl::StatusOr<SurfacePass> SurfacePass::Create() {
  std::array<ShaderProgram, 4> programs;
  for (std::size_t n = 0; n < programs.size(); ++n) {
    auto program = ShaderProgram::Build(
        {"fullscreen.vert.glsl"}, {"frame.glsl", "sky.glsl", "optics.glsl", "surface.frag.glsl"},
        {(n & 1) != 0 ? "SAMPLES 4" : "SAMPLES 1", (n & 2) != 0 ? "UNDERSIDE 1" : "UNDERSIDE 0"});
    if (!program.ok()) return program.status();
    programs[n] = std::move(*program);
  }
  return SurfacePass(std::move(programs));
}

SurfacePass::SurfacePass(std::array<ShaderProgram, 4> programs) : programs_(std::move(programs)) {
  const std::vector<std::uint8_t> foam = MakeFoamTexture();
  BindTexture(0, GL_TEXTURE_2D, foam_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, kFoamTextureSize, kFoamTextureSize, 0, GL_RED,
               GL_UNSIGNED_BYTE, foam.data());
  SetSampling(GL_TEXTURE_2D, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_REPEAT);
  glGenerateMipmap(GL_TEXTURE_2D);
  // A window of one dark cell until there is foam: samplers must always have a texture.
  constexpr std::uint8_t kNone = 0;
  SetFoamWindow({{&kNone, 1}, 1, 1.0, {}});
}

void SurfacePass::SetFoamWindow(const FoamCells& foam) {
  if (foam.cells.empty()) return;
  BindTexture(0, GL_TEXTURE_2D, foam_window_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  if (foam.side != window_side_) {
    window_side_ = foam.side;
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, foam.side, foam.side, 0, GL_RED, GL_UNSIGNED_BYTE,
                 foam.cells.data());
    SetSampling(GL_TEXTURE_2D, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_REPEAT);
  } else {
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, foam.side, foam.side, GL_RED, GL_UNSIGNED_BYTE,
                    foam.cells.data());
  }
  glGenerateMipmap(GL_TEXTURE_2D);
}

void SurfacePass::Draw(const VertexArray& empty, const ColorTarget& scene,
                       const SurfaceGridPass& geometry, const SeaTextures& sea,
                       const RipplePass& ripples, const SkyPass& sky, bool underside_seen) {
  scene.Bind();
  const std::size_t variant =
      (geometry.target() == GL_TEXTURE_2D ? 0U : 1U) + (underside_seen ? 2U : 0U);
  const ShaderProgram& program = programs_[variant];
  program.Use();
  const struct {
    const char* name;
    GLenum target;
    const Texture& texture;
  } kInputs[] = {
      {"surface_map", geometry.target(), geometry.surface()},
      {"slope_map", GL_TEXTURE_2D_ARRAY, sea.slope()},
      {"moment_map", GL_TEXTURE_2D_ARRAY, sea.moment()},
      {"ripple_slope_map", GL_TEXTURE_2D, ripples.slope()},
      {"foam_map", GL_TEXTURE_2D, foam_},
      {"foam_window_map", GL_TEXTURE_2D, foam_window_},
      {"sky_map", GL_TEXTURE_3D, sky.map()},
  };
  int unit = 0;
  for (const auto& input : kInputs) {
    BindTexture(unit, input.target, input.texture);
    program.SetSampler(input.name, unit++);
  }
  glEnable(GL_BLEND);  // covered share of the pixel over the sky; colours are premultiplied
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glBindVertexArray(empty.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_BLEND);
}

}  // namespace onesea::render
