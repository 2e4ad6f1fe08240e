#include "client/render/passes/sky.h"

#include <algorithm>
#include <cmath>

#include "client/render/foam_texture.h"
#include "client/render/passes/classify.h"

namespace onesea::render {
namespace {

// The lowest row of `rows` that can show sky: the horizon of a round sea is less than 0.05 below
// level for any eye under 8 km.
int LowestSkyRow(const FrameBlock& block, int rows) {
  constexpr float kBelowLevel = 0.05f;
  if (!(block.ray_up.z > 0.1f * std::abs(block.ray_right.z))) return 0;
  const float low =
      (-kBelowLevel - block.ray_forward.z - std::abs(block.ray_right.z)) / block.ray_up.z;
  const float row = (0.5f + 0.5f * std::clamp(low, -1.0f, 1.0f)) * static_cast<float>(rows);
  return std::max(0, static_cast<int>(row) - 2);
}

}  // namespace

absl::StatusOr<SkyPass> SkyPass::Create() {
  auto sky =
      ShaderProgram::Build({"fullscreen.vert.glsl"}, {"frame.glsl", "sky.glsl", "sky.frag.glsl"});
  if (!sky.ok()) return sky.status();
  auto place =
      ShaderProgram::Build({"fullscreen.vert.glsl"}, {"frame.glsl", "sky_place.frag.glsl"});
  if (!place.ok()) return place.status();
  return SkyPass(std::move(*sky), std::move(*place));
}

SkyPass::SkyPass(ShaderProgram sky, ShaderProgram place)
    : sky_(std::move(sky)), place_(std::move(place)) {
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

void SkyPass::DrawSmall(const VertexArray& empty, const FrameBlock& block, int width, int height) {
  // Clouds are drawn out along the horizon: only tall pictures can spare half of their rows.
  constexpr int kTallRows = 540;
  small_.Resize((width + 1) / 2, height < kTallRows ? height : (height + 1) / 2, GL_RGBA16F);
  small_.Bind();
  sky_.Use();
  BindTexture(0, GL_TEXTURE_3D, map_);
  sky_.SetSampler("sky_map", 0);
  BindTexture(1, GL_TEXTURE_2D, clouds_);
  sky_.SetSampler("cloud_map", 1);
  const int lowest = LowestSkyRow(block, small_.height);
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, lowest, small_.width, small_.height - lowest);
  glBindVertexArray(empty.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_SCISSOR_TEST);
}

void SkyPass::Place(const VertexArray& empty, const ColorTarget& scene) {
  scene.Bind();
  place_.Use();
  BindTexture(0, GL_TEXTURE_2D, small_.texture);
  place_.SetSampler("small_sky", 0);
  ClassifyPass::ChooseNotSheets(place_);
  glBindVertexArray(empty.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  ClassifyPass::ChooseAll();
}

}  // namespace onesea::render
