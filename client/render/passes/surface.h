#pragma once

#include <array>

#include "absl/status/statusor.h"
#include "client/render/gl_objects.h"
#include "client/render/passes/ripples.h"
#include "client/render/passes/sky.h"
#include "client/render/passes/surface_grid.h"
#include "client/render/sea_textures.h"
#include "client/render/shader_program.h"

namespace onesea::render {

/// Shades the sea, once per covered pixel, over the sky.
class SurfacePass {
 public:
  static absl::StatusOr<SurfacePass> Create();

  void SetFoamWindow(const FoamCells& foam);
  void Draw(const VertexArray& empty, const ColorTarget& scene, const SurfaceGridPass& geometry,
            const SeaTextures& sea, const RipplePass& ripples, const SkyPass& sky,
            bool underside_seen);

 private:
  explicit SurfacePass(std::array<ShaderProgram, 4> programs);
  std::array<ShaderProgram, 4> programs_;  // bit 0: four samples a pixel, bit 1: underside seen
  Texture foam_, foam_window_;
  int window_side_ = 0;
};

}  // namespace onesea::render
