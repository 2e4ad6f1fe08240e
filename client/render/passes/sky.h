#pragma once

#include "absl/status/statusor.h"
#include "client/render/frame_block.h"
#include "client/render/gl_objects.h"
#include "client/render/shader_program.h"
#include "client/render/sky_light.h"

namespace onesea::render {

/// The sky's map and clouds on the graphics card, and the pass that draws them behind everything.
class SkyPass {
 public:
  static absl::StatusOr<SkyPass> Create();

  void SetLight(const SkyLight& light);
  /// Air and clouds for a picture of this size; `block` as the shaders see it. Needs nothing of the
  /// sea: drawn before the lattice, a software rasteriser fills it while vertices are placed.
  void DrawSmall(const VertexArray& empty, const FrameBlock& block, int width, int height);
  /// Puts them, and the sun, where ClassifyPass found no sheet of water alone.
  void Place(const VertexArray& empty, const FrameBlock& block, const ColorTarget& scene);

  const Texture& map() const { return map_; }
  /// One row: what far air adds, by azimuth from the sun.
  const Texture& haze() const { return haze_; }
  const Texture& clouds() const { return clouds_; }

 private:
  SkyPass(ShaderProgram sky, ShaderProgram place, ShaderProgram sun);
  void SetHaze(const SkyLight& light);

  ShaderProgram sky_, place_, sun_;
  ColorTarget small_;
  Texture map_, haze_, clouds_;
};

}  // namespace onesea::render
