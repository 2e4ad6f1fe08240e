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
  /// Where ClassifyPass left sky and edges. `block` is what the shaders see of it.
  void Draw(const VertexArray& empty, const ColorTarget& scene, const FrameBlock& block);

  const Texture& map() const { return map_; }
  const Texture& clouds() const { return clouds_; }

 private:
  SkyPass(ShaderProgram sky, ShaderProgram place);
  ShaderProgram sky_, place_;
  ColorTarget small_;
  Texture map_, clouds_;
};

}  // namespace onesea::render
