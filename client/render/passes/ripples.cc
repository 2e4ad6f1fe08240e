#include "client/render/passes/ripples.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/sea/constants.h"

namespace onesea::render {
namespace {

std::uint64_t NextRandom(std::uint64_t& state) {  // SplitMix64, Steele et al. 2014
  state += 0x9e3779b97f4a7c15ULL;
  std::uint64_t z = state;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

double NextUnit(std::uint64_t& state) {
  return static_cast<double>(NextRandom(state) >> 11) * 0x1p-53;
}

void Allocate(const Texture& texture) {
  BindTexture(0, GL_TEXTURE_2D, texture);
  int level = 0;
  for (int side = RipplePass::kSize; side >= 1; side /= 2, ++level) {
    glTexImage2D(GL_TEXTURE_2D, level, GL_RG16F, side, side, 0, GL_RG, GL_HALF_FLOAT, nullptr);
  }
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, level - 1);
  SetSampling(GL_TEXTURE_2D, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_REPEAT);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.id(), 0);
}

}  // namespace

absl::StatusOr<RipplePass> RipplePass::Create() {
  auto program = ShaderProgram::Build({"fullscreen.vert.glsl"}, {"ripples.frag.glsl"});
  if (!program.ok()) return program.status();
  return RipplePass(std::move(*program));
}

RipplePass::RipplePass(ShaderProgram program) : program_(std::move(program)) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  Allocate(slope_);
  ONESEA_CHECK(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
}

void RipplePass::Draw(const VertexArray& empty, std::uint64_t seed, double time_s, double mss,
                      double wind_to_rad) {
  constexpr int kTurnsMin = 9, kTurnsMax = 44;  // per tile: 41 cm to 8.4 cm, 3 texels at least
  std::array<float, 4 * kWaves> waves{};
  std::uint64_t state = seed ^ 0x5ea5ea5ea5ea5eaULL;
  // Equal slope variance per wave, spread evenly over log k: the saturated range of a wind sea.
  const double amplitude = std::sqrt(2.0 * mss / kWaves);
  stats_ = {};
  for (std::size_t n = 0; n < kWaves; ++n) {
    const double share = (static_cast<double>(n) + NextUnit(state)) / kWaves;
    const double turns = kTurnsMin * std::pow(static_cast<double>(kTurnsMax) / kTurnsMin, share);
    // Short waves run widely around the wind: sum of uniforms is a bell of deviation 47 degrees.
    const double bell = NextUnit(state) + NextUnit(state) + NextUnit(state) - 1.5;
    const double direction = wind_to_rad + 1.65 * bell;
    const double i = std::round(turns * std::cos(direction)),
                 j = std::round(turns * std::sin(direction));
    const double k = 2.0 * sea::kPi / kLengthM * std::hypot(i, j);
    const double omega = std::sqrt(sea::kGravity * k + sea::kSurfaceTensionOverDensity * k * k * k);
    const double phase =
        2.0 * sea::kPi * NextUnit(state) - std::fmod(omega * time_s, 2.0 * sea::kPi);
    waves[4 * n] = static_cast<float>(i);
    waves[4 * n + 1] = static_cast<float>(j);
    waves[4 * n + 2] = static_cast<float>(amplitude);
    waves[4 * n + 3] = static_cast<float>(phase);
    const double norm2 = i * i + j * j, half = 0.5 * amplitude * amplitude;
    stats_.xx += half * i * i / norm2;
    stats_.yy += half * j * j / norm2;
    stats_.xy += half * i * j / norm2;
  }
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glViewport(0, 0, kSize, kSize);
  program_.Use();
  glUniform4fv(program_.Uniform("waves"), kWaves, waves.data());
  glBindVertexArray(empty.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  BindTexture(0, GL_TEXTURE_2D, slope_);
  glGenerateMipmap(GL_TEXTURE_2D);
}

}  // namespace onesea::render
