#include "client/render/passes/sky.h"

#include "client/render/foam_texture.h"
#include "client/render/passes/classify.h"

namespace onesea::render {

absl::StatusOr<SkyPass> SkyPass::Create() {
  auto program =
      ShaderProgram::Build({"fullscreen.vert.glsl"}, {"frame.glsl", "sky.glsl", "sky.frag.glsl"});
  if (!program.ok()) return program.status();
  return SkyPass(std::move(*program));
}

SkyPass::SkyPass(ShaderProgram program) : program_(std::move(program)) {
  constexpr int kCloudSize = 512;
  const std::vector<std::uint8_t> clouds = MakeCloudTexture(kCloudSize);
  BindTexture(0, GL_TEXTURE_2D, clouds_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, kCloudSize, kCloudSize, 0, GL_RED, GL_UNSIGNED_BYTE,
               clouds.data());
  SetSampling(GL_TEXTURE_2D, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_REPEAT);
  glGenerateMipmap(GL_TEXTURE_2D);
}

void SkyPass::SetLight(const SkyLight& light) {
  BindTexture(0, GL_TEXTURE_3D, map_);
  glTexImage3D(GL_TEXTURE_3D, 0, GL_RGB16F, SkyLight::kColumns, SkyLight::kRows,
               SkyLight::kBlurLevels, 0, GL_RGB, GL_FLOAT, light.radiance.data());
  SetSampling(GL_TEXTURE_3D, GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_WRAP_R, GL_CLAMP_TO_EDGE);
}

void SkyPass::Draw(const VertexArray& empty, const ColorTarget& scene) {
  scene.Bind();
  program_.Use();
  BindTexture(0, GL_TEXTURE_3D, map_);
  program_.SetSampler("sky_map", 0);
  BindTexture(1, GL_TEXTURE_2D, clouds_);
  program_.SetSampler("cloud_map", 1);
  ClassifyPass::ChooseSkyAndEdges(program_);
  glBindVertexArray(empty.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  ClassifyPass::ChooseAll();
}

}  // namespace onesea::render
