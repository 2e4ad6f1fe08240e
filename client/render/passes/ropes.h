#pragma once

#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "client/render/frame_block.h"
#include "client/render/gl_objects.h"
#include "client/render/passes/sky.h"
#include "client/render/passes/surface_grid.h"
#include "client/render/render_frame.h"
#include "client/render/shader_program.h"

namespace onesea::render {

/// Draws ropes over the finished scene, as hanging lines: ribbons that face the eye, shaded as
/// round, never thinner than 1.2 pixels but fainter instead. Sea, land and hulls hide them; what
/// hangs under water isn't seen from above.
class RopePass {
 public:
  static absl::StatusOr<RopePass> Create();

  /// Makes the lines of those in view. False: there is nothing to draw. `lowest_m`: relative to the
  /// water level; what lies below it altogether is hidden.
  bool Prepare(const RenderFrame& frame, const FrameBlock& block, double lowest_m, int width,
               int height);
  /// Around each of them: where the hulls' depth must be known.
  std::span<const PixelBox> boxes() const { return boxes_; }

  /// After Prepare() of the same picture. `hull_depth` as HullPass::depth(). Cost: 64 triangles a
  /// rope, and the pixels that they cover.
  void Draw(const ColorTarget& scene, const SurfaceGridPass& geometry, const SkyPass& sky,
            const Texture* hull_depth);

 private:
  struct Point {
    float x, y, z, along_m;
    float tx, ty, tz, radius_m;  // t: along the line
  };
  RopePass(ShaderProgram one, ShaderProgram four);
  void AddLine(const RopeLine& rope, std::span<const glm::vec3> line);

  ShaderProgram one_, four_;
  VertexArray vertices_;
  Buffer buffer_;
  std::vector<Point> points_;  // each twice, for both edges
  std::vector<GLint> firsts_;
  std::vector<GLsizei> counts_;
  std::vector<PixelBox> boxes_;
};

}  // namespace onesea::render
