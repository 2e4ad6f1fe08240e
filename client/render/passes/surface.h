#pragma once

#include <compare>
#include <map>

#include "absl/status/statusor.h"
#include "client/render/gl_objects.h"
#include "client/render/passes/ripples.h"
#include "client/render/passes/sky.h"
#include "client/render/passes/surface_grid.h"
#include "client/render/patch_textures.h"
#include "client/render/sea_textures.h"
#include "client/render/shader_program.h"

namespace onesea::render {

/// What the shader is compiled for: software rasterisers pay for every branch that it could take.
struct SurfaceVariant {
  bool edges = false;      ///< pixels of several sheets of water, or of water and sky
  bool underside = false;  ///< the eye may look at the surface from below
  bool ripples = true;
  bool regular_waves = false;
  int samples = 4;
  int cascades = 4;
  int patches = 0;  ///< of the interaction layer, in view
  friend auto operator<=>(const SurfaceVariant&, const SurfaceVariant&) = default;
};

/// Shades the sea, once per covered pixel, over the sky.
class SurfacePass {
 public:
  static absl::StatusOr<SurfacePass> Create();

  void SetFoamWindow(const FoamCells& foam);
  /// Where ClassifyPass found water; `variant.edges` and `.samples` are filled in. A new
  /// variant is compiled on first use.
  void Draw(const VertexArray& empty, const ColorTarget& scene, const SurfaceGridPass& geometry,
            const SeaTextures& sea, const PatchTextures& patches, const RipplePass& ripples,
            const SkyPass& sky, SurfaceVariant variant);

 private:
  SurfacePass();
  const ShaderProgram& ProgramFor(const SurfaceVariant& variant);

  std::map<SurfaceVariant, ShaderProgram> programs_;
  Texture foam_, foam_window_;
  int window_side_ = 0;
};

}  // namespace onesea::render
