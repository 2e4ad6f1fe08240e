#include "client/render/passes/classify.h"

#include <vector>

#include "common/base/check.h"

namespace onesea::render {
namespace {

constexpr float kLow = 0.25f, kStep = 0.5f, kHigh = 0.75f;
constexpr float kLandOfOne = 0.875f, kLandOfFour = 0.625f;
enum Programs : std::size_t { kOne, kFour, kOneOverTerrain };

void Choose(const ShaderProgram& program, float depth, GLenum test) {
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  glDepthFunc(test);
  glUniform1f(program.Uniform("plane"), 2.0f * depth - 1.0f);
}

}  // namespace

absl::StatusOr<ClassifyPass> ClassifyPass::Create() {
  std::array<ShaderProgram, 3> programs;
  for (std::size_t n = 0; n < programs.size(); ++n) {
    std::vector<std::string_view> files = {"frame.glsl", "steps.glsl", "classify.frag.glsl"};
    if (n == kFour) files.erase(files.begin() + 1);
    auto program = ShaderProgram::Build(
        {"fullscreen.vert.glsl"}, files,
        {n == kFour ? "SAMPLES 4" : "SAMPLES 1", n == kOneOverTerrain ? "TERRAIN 1" : "TERRAIN 0"});
    if (!program.ok()) return program.status();
    programs[n] = std::move(*program);
  }
  return ClassifyPass(std::move(programs));
}

void ClassifyPass::Draw(const VertexArray& empty, const ColorTarget& scene,
                        const SurfaceGridPass& geometry, bool terrain) {
  scene.Bind();
  if (scene.width != width_ || scene.height != height_) {
    width_ = scene.width;
    height_ = scene.height;
    glBindRenderbuffer(GL_RENDERBUFFER, depth_.id());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width_, height_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
    ONESEA_CHECK(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
  }
  const bool one = geometry.target() == GL_TEXTURE_2D;
  const ShaderProgram& program = programs_[one ? (terrain ? kOneOverTerrain : kOne) : kFour];
  program.Use();
  BindTexture(0, geometry.target(), geometry.surface());
  program.SetSampler("surface_map", 0);
  if (one) {
    BindTexture(1, GL_TEXTURE_2D, geometry.depth());
    program.SetSampler("depth_map", 1);
  }
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_ALWAYS);
  glDepthMask(GL_TRUE);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glBindVertexArray(empty.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  ChooseAll();
}

void ClassifyPass::ShareClasses(const ColorTarget& other) const {
  glBindFramebuffer(GL_FRAMEBUFFER, other.framebuffer.id());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
}
void ClassifyPass::ChooseSheets(const ShaderProgram& program) { Choose(program, kLow, GL_GREATER); }
void ClassifyPass::ChooseSheetsAndSteps(const ShaderProgram& program) {
  Choose(program, kHigh, GL_GREATER);
}
void ClassifyPass::ChooseSteps(const ShaderProgram& program) { Choose(program, kStep, GL_EQUAL); }
void ClassifyPass::ChooseEdges(const ShaderProgram& program) { Choose(program, kHigh, GL_LESS); }
void ClassifyPass::ChooseNotSheets(const ShaderProgram& program) { Choose(program, kLow, GL_LESS); }
void ClassifyPass::ChooseLand(const ShaderProgram& program, int samples) {
  Choose(program, samples == 1 ? kLandOfOne : kLandOfFour, GL_EQUAL);
}
void ClassifyPass::ChooseAll() {
  glDisable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
}

}  // namespace onesea::render
