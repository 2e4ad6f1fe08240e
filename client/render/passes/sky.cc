#include "client/render/passes/sky.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

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

struct Box {
  int x = 0, y = 0, side = 0;
};

// The pixels round the sun's disc; none when it is behind the eye. A disc near the picture's corner
// is drawn out by at most 1 / cos² of its angle from the middle.
Box SunBox(const FrameBlock& block, int width, int height) {
  const glm::vec3 sun(block.sun_direction), forward(block.ray_forward);
  const glm::vec3 right(block.ray_right), up(block.ray_up);
  const float depth = glm::dot(sun, forward);
  if (!(depth > 0.05f)) return {};
  // In [-1, 1] within the picture.
  const float x = glm::dot(sun, right) / (depth * glm::dot(right, right));
  const float y = glm::dot(sun, up) / (depth * glm::dot(up, up));
  if (std::abs(x) > 4.0f || std::abs(y) > 4.0f) return {};
  const float radius_px = 4.0f + 0.00465f / (block.ray_forward.w * depth * depth);
  const float left = 0.5f * (x + 1.0f) * static_cast<float>(width) - radius_px;
  const float bottom = 0.5f * (y + 1.0f) * static_cast<float>(height) - radius_px;
  return {static_cast<int>(std::floor(left)), static_cast<int>(std::floor(bottom)),
          static_cast<int>(std::ceil(2.0f * radius_px)) + 1};
}

}  // namespace

absl::StatusOr<SkyPass> SkyPass::Create() {
  auto sky =
      ShaderProgram::Build({"fullscreen.vert.glsl"}, {"frame.glsl", "sky.glsl", "sky.frag.glsl"});
  if (!sky.ok()) return sky.status();
  auto place = ShaderProgram::Build({"fullscreen.vert.glsl"}, {"frame.glsl", "sky_place.frag.glsl"},
                                    {"SUN 0"});
  if (!place.ok()) return place.status();
  auto sun = ShaderProgram::Build({"fullscreen.vert.glsl"}, {"frame.glsl", "sky_place.frag.glsl"},
                                  {"SUN 1"});
  if (!sun.ok()) return sun.status();
  return SkyPass(std::move(*sky), std::move(*place), std::move(*sun));
}

SkyPass::SkyPass(ShaderProgram sky, ShaderProgram place, ShaderProgram sun)
    : sky_(std::move(sky)), place_(std::move(place)), sun_(std::move(sun)) {
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
  SetHaze(light);
  BindTexture(0, GL_TEXTURE_3D, map_);
  glTexImage3D(GL_TEXTURE_3D, 0, GL_RGB16F, SkyLight::kColumns, SkyLight::kRows,
               SkyLight::kBlurLevels, 0, GL_RGB, GL_FLOAT, light.radiance.data());
  SetSampling(GL_TEXTURE_3D, GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_WRAP_R, GL_CLAMP_TO_EDGE);
}

void SkyPass::SetHaze(const SkyLight& light) {
  // The lowest row that sky_at() reads, sharp: water lost in haze must have the colour of the sky
  // that it meets, or the horizon shows as a line of dashes.
  const double row = std::sqrt(0.004) * (SkyLight::kRows - 1);
  const auto below = static_cast<std::size_t>(row);
  const float share = static_cast<float>(row - std::floor(row));
  std::vector<glm::vec3> haze(SkyLight::kColumns);
  for (std::size_t column = 0; column < haze.size(); ++column) {
    const glm::vec3* at = &light.radiance[below * SkyLight::kColumns + column];
    haze[column] = glm::mix(at[0], at[SkyLight::kColumns], share);
  }
  BindTexture(0, GL_TEXTURE_2D, haze_);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB16F, SkyLight::kColumns, 1, 0, GL_RGB, GL_FLOAT,
               haze.data());
  SetSampling(GL_TEXTURE_2D, GL_LINEAR, GL_LINEAR, GL_REPEAT);
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

void SkyPass::Place(const VertexArray& empty, const FrameBlock& block, const ColorTarget& scene) {
  scene.Bind();
  place_.Use();
  BindTexture(0, GL_TEXTURE_2D, small_.texture);
  place_.SetSampler("small_sky", 0);
  ClassifyPass::ChooseNotSheets(place_);
  glBindVertexArray(empty.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  if (const Box box = SunBox(block, scene.width, scene.height); box.side > 0) {
    sun_.Use();
    sun_.SetSampler("small_sky", 0);
    ClassifyPass::ChooseNotSheets(sun_);
    glEnable(GL_SCISSOR_TEST);
    glScissor(box.x, box.y, box.side, box.side);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
  }
  ClassifyPass::ChooseAll();
}

}  // namespace onesea::render
