#pragma once

#include <array>
#include <cstdint>

#include "absl/status/statusor.h"
#include "client/render/frame_block.h"
#include "client/render/gl_objects.h"
#include "client/render/shader_program.h"

namespace onesea::render {

/// Draws the tile of cosmetic ripples: waves of 8 to 45 cm by the capillary-gravity dispersion,
/// with phases from the session's seed and sea time, so that two viewers show the same ripples.
class RipplePass {
 public:
  static constexpr int kSize = 128;
  static constexpr int kWaves = 48;
  static constexpr double kLengthM = 3.7;

  static absl::StatusOr<RipplePass> Create();

  /// `mss` is the slope variance the ripples shall have; they run along `wind_to_rad`.
  void Draw(const VertexArray& empty, std::uint64_t seed, double time_s, double mss,
            double wind_to_rad);

  const SlopeStats& stats() const { return stats_; }
  const Texture& slope() const { return slope_; }

 private:
  explicit RipplePass(ShaderProgram program);
  ShaderProgram program_;
  Texture slope_;
  Framebuffer framebuffer_;
  SlopeStats stats_;
};

}  // namespace onesea::render
