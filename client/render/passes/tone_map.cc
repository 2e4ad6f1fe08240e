#include "client/render/passes/tone_map.h"

#include <algorithm>

namespace onesea::render {

absl::StatusOr<ToneMapPass> ToneMapPass::Create() {
  auto down = ShaderProgram::Build({"fullscreen.vert.glsl"}, {"bloom_down.frag.glsl"});
  if (!down.ok()) return down.status();
  auto up = ShaderProgram::Build({"fullscreen.vert.glsl"}, {"bloom_up.frag.glsl"});
  if (!up.ok()) return up.status();
  auto map = ShaderProgram::Build({"fullscreen.vert.glsl"}, {"frame.glsl", "tone_map.frag.glsl"});
  if (!map.ok()) return map.status();
  return ToneMapPass(std::move(*down), std::move(*up), std::move(*map));
}

void ToneMapPass::MakeGlow(const ColorTarget& scene) {
  down_.Use();
  down_.SetSampler("source", 0);
  const ColorTarget* source = &scene;
  for (ColorTarget& target : glow_) {
    const int divisor = source == &scene ? 4 : 2;
    target.Resize(std::max(1, source->width / divisor), std::max(1, source->height / divisor),
                  GL_R11F_G11F_B10F);
    target.Bind();
    BindTexture(0, GL_TEXTURE_2D, source->texture);
    // Four bilinear taps between texels cover 4 x 4 of them; for halving they overlap into a tent.
    glUniform2f(down_.Uniform("texel"), 1.0f / static_cast<float>(source->width),
                1.0f / static_cast<float>(source->height));
    glDrawArrays(GL_TRIANGLES, 0, 3);
    source = &target;
  }
  glow_sum_.Resize(glow_[1].width, glow_[1].height, GL_RGBA16F);
  glow_sum_.Bind();
  up_.Use();
  const char* names[] = {"glow0", "glow1", "glow2"};
  for (int n = 0; n < 3; ++n) {
    BindTexture(n, GL_TEXTURE_2D, glow_[static_cast<std::size_t>(n + 1)].texture);
    up_.SetSampler(names[n], n);
  }
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void ToneMapPass::Draw(const VertexArray& empty, const ColorTarget& scene, GLuint framebuffer,
                       bool bloom) {
  glBindVertexArray(empty.id());
  if (bloom) MakeGlow(scene);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, scene.width, scene.height);
  map_.Use();
  BindTexture(0, GL_TEXTURE_2D, scene.texture);
  map_.SetSampler("scene", 0);
  BindTexture(1, GL_TEXTURE_2D, glow_sum_.texture);
  map_.SetSampler("glow", 1);
  glUniform1f(map_.Uniform("glow_share"), bloom ? 0.045f : 0.0f);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace onesea::render
