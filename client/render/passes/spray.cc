#include "client/render/passes/spray.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "absl/strings/str_cat.h"

namespace onesea::render {
namespace {

constexpr int kDrops = 24;  // of a burst
// Near the water the wind is slower than 10 m up.
constexpr double kLowWindShare = 0.6;

}  // namespace

absl::StatusOr<SprayPass> SprayPass::Create() {
  const std::string drops = absl::StrCat("kDrops ", kDrops);
  auto programs = ShaderProgram::BuildForSamples(
      {"frame.glsl", "spray.vert.glsl"},
      {"frame.glsl", "sky.glsl", "depth.glsl", "spray.frag.glsl"}, {drops, "kNearest 0.2"});
  if (!programs.ok()) return programs.status();
  return SprayPass(std::move((*programs)[0]), std::move((*programs)[1]));
}

SprayPass::SprayPass(ShaderProgram one, ShaderProgram four)
    : one_(std::move(one)), four_(std::move(four)) {
  glBindVertexArray(vertices_.id());
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  const auto attribute = [](GLuint location, GLint size, std::size_t offset) {
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, size, GL_FLOAT, GL_FALSE, sizeof(Instance),
                          reinterpret_cast<const void*>(offset));  // NOLINT: as OpenGL wants it
    glVertexAttribDivisor(location, kDrops);
  };
  attribute(0, 4, offsetof(Instance, x));
  attribute(1, 4, offsetof(Instance, vx));
  attribute(2, 1, offsetof(Instance, seed));
}

void SprayPass::Draw(const RenderFrame& frame, const ColorTarget& scene,
                     const SurfaceGridPass& geometry, const SkyPass& sky) {
  instances_.clear();
  const Vec3d zero{frame.camera.position_m.x, frame.camera.position_m.y, frame.water_level_m};
  const auto first =
      frame.spray.size() - std::min<std::size_t>(frame.spray.size(), kRenderSprayMax);
  for (std::size_t n = first; n < frame.spray.size(); ++n) {
    const SprayBurst& burst = frame.spray[n];
    if (!(burst.age_s >= 0.0 && burst.age_s < kSprayLifeS)) continue;
    const Vec3d at = burst.position_m - zero, v = burst.velocity_m_per_s;
    const auto f = [](double value) { return static_cast<float>(value); };
    // Bits of a finite number: a seed is carried, not reckoned with.
    const float seed = std::bit_cast<float>((burst.seed & 0x3fffffffU) | 0x00800000U);
    instances_.push_back({f(at.x), f(at.y), f(at.z), f(burst.age_s), f(v.x), f(v.y), f(v.z),
                          f(burst.mass_kg), seed});
  }
  if (instances_.empty()) return;
  const bool one = geometry.target() == GL_TEXTURE_2D;
  const ShaderProgram& program = one ? one_ : four_;
  scene.Bind();
  program.Use();
  BindTexture(0, geometry.target(), one ? geometry.depth() : geometry.surface());
  program.SetSampler(one ? "depth_map" : "surface_map", 0);
  BindTexture(1, GL_TEXTURE_2D, sky.clouds());
  program.SetSampler("noise_map", 1);
  BindTexture(2, GL_TEXTURE_2D, sky.haze());
  program.SetSampler("haze_map", 2);
  const double wind = kLowWindShare * frame.weather.wind_speed_m_per_s;
  glUniform4f(program.Uniform("wind_now"),
              static_cast<float>(wind * std::cos(frame.weather.wind_to_rad)),
              static_cast<float>(wind * std::sin(frame.weather.wind_to_rad)), 0.0f,
              static_cast<float>(kSprayLifeS));
  glBindVertexArray(vertices_.id());
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(instances_.size() * sizeof(Instance)),
               instances_.data(), GL_STREAM_DRAW);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(instances_.size()) * kDrops);
  glDisable(GL_BLEND);
}

}  // namespace onesea::render
