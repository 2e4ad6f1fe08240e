#include "client/render/passes/smooth_steps.h"

namespace onesea::render {
namespace {

void DrawSteps(const ShaderProgram& program) {
  ClassifyPass::ChooseSteps(program);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  ClassifyPass::ChooseAll();
}

}  // namespace

absl::StatusOr<SmoothStepsPass> SmoothStepsPass::Create() {
  auto smooth = ShaderProgram::Build({"fullscreen.vert.glsl"},
                                     {"frame.glsl", "steps.glsl", "smooth_steps.frag.glsl"});
  if (!smooth.ok()) return smooth.status();
  auto copy = ShaderProgram::Build({"fullscreen.vert.glsl"}, {"copy.frag.glsl"});
  if (!copy.ok()) return copy.status();
  return SmoothStepsPass(std::move(*smooth), std::move(*copy));
}

void SmoothStepsPass::Draw(const VertexArray& empty, const ColorTarget& scene,
                           const SurfaceGridPass& geometry, const ClassifyPass& classes) {
  smoothed_.Resize(scene.width, scene.height, GL_RGBA16F);
  classes.ShareClasses(smoothed_);
  glBindVertexArray(empty.id());
  smoothed_.Bind();
  smooth_.Use();
  BindTexture(0, GL_TEXTURE_2D, geometry.depth());
  smooth_.SetSampler("depth_map", 0);
  BindTexture(1, GL_TEXTURE_2D, scene.texture);
  smooth_.SetSampler("scene", 1);
  DrawSteps(smooth_);
  // A picture can't be read while it is drawn into: back from the second one.
  scene.Bind();
  copy_.Use();
  BindTexture(0, GL_TEXTURE_2D, smoothed_.texture);
  copy_.SetSampler("source", 0);
  DrawSteps(copy_);
}

}  // namespace onesea::render
