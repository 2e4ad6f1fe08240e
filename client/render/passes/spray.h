#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "client/render/gl_objects.h"
#include "client/render/passes/sky.h"
#include "client/render/passes/surface_grid.h"
#include "client/render/render_frame.h"
#include "client/render/shader_program.h"

namespace onesea::render {

/// Draws bursts of spray over the finished scene: each is a handful of drops and puffs whose
/// flight is a closed form of their age, so nothing is kept from picture to picture. Hulls don't
/// hide them.
class SprayPass {
 public:
  static absl::StatusOr<SprayPass> Create();

  /// Cost: 48 triangles a burst, and the pixels that they cover.
  void Draw(const RenderFrame& frame, const ColorTarget& scene, const SurfaceGridPass& geometry,
            const SkyPass& sky);

 private:
  struct Instance {
    float x, y, z, age_s;
    float vx, vy, vz, mass_kg;
    float seed;
  };
  SprayPass(ShaderProgram one, ShaderProgram four);

  ShaderProgram one_, four_;
  VertexArray vertices_;
  Buffer buffer_;
  std::vector<Instance> instances_;
};

}  // namespace onesea::render
