#pragma once

#include "absl/status/statusor.h"
#include "client/render/gl_objects.h"
#include "client/render/passes/classify.h"
#include "client/render/passes/surface_grid.h"
#include "client/render/shader_program.h"

namespace onesea::render {

/// Takes the stairs off crests and horizon in a picture that was drawn with one sample per pixel.
/// On a software rasteriser four samples make the whole picture dearer by a third, this by a tenth.
/// Frames differ from each other no more than with four samples (docs/measurements.md).
class SmoothStepsPass {
 public:
  static absl::StatusOr<SmoothStepsPass> Create();

  /// Changes `scene` where ClassifyPass found steps.
  void Draw(const VertexArray& empty, const ColorTarget& scene, const SurfaceGridPass& geometry,
            const ClassifyPass& classes);

 private:
  SmoothStepsPass(ShaderProgram smooth, ShaderProgram copy)
      : smooth_(std::move(smooth)), copy_(std::move(copy)) {}
  ShaderProgram smooth_, copy_;
  ColorTarget smoothed_;
};

}  // namespace onesea::render
