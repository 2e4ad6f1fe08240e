#pragma once

#include <array>

#include "absl/status/statusor.h"
#include "client/render/gl_objects.h"
#include "client/render/shader_program.h"

namespace onesea::render {

/// Exposure, a little glow around what is too bright for the display, film curve, dither to 8 bits.
class ToneMapPass {
 public:
  static absl::StatusOr<ToneMapPass> Create();

  /// Draws `scene` into `framebuffer` (0: the window's) of the same size.
  void Draw(const VertexArray& empty, const ColorTarget& scene, GLuint framebuffer, bool bloom);

 private:
  ToneMapPass(ShaderProgram down, ShaderProgram up, ShaderProgram map)
      : down_(std::move(down)), up_(std::move(up)), map_(std::move(map)) {}
  void MakeGlow(const ColorTarget& scene);

  ShaderProgram down_, up_, map_;
  ColorTarget glow_sum_;
  std::array<ColorTarget, 4> glow_;  // a quarter of the scene, an eighth, ...
};

}  // namespace onesea::render
