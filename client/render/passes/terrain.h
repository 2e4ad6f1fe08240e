#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "client/render/frame_block.h"
#include "client/render/gl_objects.h"
#include "client/render/ground_textures.h"
#include "client/render/passes/sky.h"
#include "client/render/passes/surface_grid.h"
#include "client/render/shader_program.h"

namespace onesea::render {

/// A square of terrain to draw: GroundTextures::kTileQuads quads a side.
struct TerrainTile {
  glm::vec2 south_west;  // relative to the eye [m]
  float quad_m;
  float mip;
};

/// What of the terrain is in view, above `lowest_m` over the water level, in tiles whose quads are
/// about `pixels` wide; the finest tiles have the ground's own texels.
std::vector<TerrainTile> ChooseTerrainTiles(const GroundTextures& ground, const FrameBlock& block,
                                            double lowest_m, double pixels);

/// Draws land, and seabed for eyes under water, into the picture of the geometry, then shades it
/// where it is in front.
///
/// The mesh is anchored in the world and only carries the outline: light and matter come from
/// textures by pixel, so that no facets show.
class TerrainPass {
 public:
  static absl::StatusOr<TerrainPass> Create();

  /// Finds what is in view; false: nothing is.
  bool Prepare(const GroundTextures& ground, const FrameBlock& block, double lowest_m,
               double pixels);
  /// After SurfaceGridPass::Draw() of the same picture.
  void DrawGeometry(const GroundTextures& ground);
  /// After ClassifyPass::Draw() and the sea's shading.
  void Shade(const VertexArray& empty, const ColorTarget& scene, const SurfaceGridPass& geometry,
             const GroundTextures& ground, const SkyPass& sky);

 private:
  TerrainPass(ShaderProgram geometry, ShaderProgram one, ShaderProgram four);

  ShaderProgram geometry_, one_, four_;
  VertexArray vertices_;
  Buffer indices_, tile_buffer_;
  GLsizei index_count_ = 0;
  std::vector<TerrainTile> tiles_;
};

}  // namespace onesea::render
