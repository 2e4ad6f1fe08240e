#pragma once

#include <compare>
#include <map>
#include <span>

#include "absl/status/statusor.h"
#include "client/render/attenuation_texture.h"
#include "client/render/gl_objects.h"
#include "client/render/ground_textures.h"
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
  bool hulls = false;      ///< their mirror image may be seen
  bool ripples = true;
  bool regular_waves = false;
  int samples = 4;
  int cascades = 4;
  int patches = 0;          ///< of the interaction layer, in view
  bool terrain = false;     ///< the bottom may shine through
  bool attenuated = false;  ///< cascades are lower over terrain
  friend auto operator<=>(const SurfaceVariant&, const SurfaceVariant&) = default;
};

/// The hulls' mirror image in flat water, and where in the picture it may be seen.
struct HullMirror {
  const Texture* picture = nullptr;   ///< premultiplied; null: no hull is in view
  const Texture* distance = nullptr;  ///< of the water that shows it [m], premultiplied
  PixelBox box;
};

/// What the sea's shading reads.
struct SurfaceInput {
  const SurfaceGridPass& geometry;
  const SeaTextures& sea;
  const PatchTextures& patches;
  const GroundTextures& ground;
  const AttenuationTexture& attenuation;
  const RipplePass& ripples;
  const SkyPass& sky;
};

/// Shades the sea, once per covered pixel, over the sky.
class SurfacePass {
 public:
  static absl::StatusOr<SurfacePass> Create();

  void SetFoamWindow(const FoamCells& foam);
  /// Where ClassifyPass found water; `variant.edges` and `.samples` are filled in. A new
  /// variant is compiled on first use.
  void Draw(const VertexArray& empty, const ColorTarget& scene, const SurfaceInput& input,
            const HullMirror& mirror, SurfaceVariant variant);

 private:
  SurfacePass();
  struct Map {
    const char* name;
    GLenum target;
    const Texture& texture;
  };
  void DrawVariant(std::span<const Map> maps, const SurfaceVariant& variant);
  const ShaderProgram& ProgramFor(const SurfaceVariant& variant);

  std::map<SurfaceVariant, ShaderProgram> programs_;
  Texture foam_, foam_window_;
  int window_side_ = 0;
};

}  // namespace onesea::render
