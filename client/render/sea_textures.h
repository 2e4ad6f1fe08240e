#pragma once

#include <vector>

#include "client/render/gl_objects.h"
#include "client/render/render_frame.h"

namespace onesea::render {

/// The sea's fields on the graphics card: two 2-D arrays, one layer per cascade, with mips.
///
///   displacement  RGBA32F  D_x, D_y, eta, 0
///   slope         RGBA32F  slope_x, slope_y, J_xx + J_yy, slope_x² + slope_y²
///
/// A mip of the squares less the square of the mip is the slope variance that the mip has lost
/// (LEAN mapping, Olano & Baker 2010); the shader shares it out over directions as the whole
/// cascade's and turns it into roughness. Of the folding only the trace is kept: for one wave
/// adj(1 + J) s = s and det(1 + J) = 1 + tr J exactly, and what waves across each other add is of
/// second order. Reads of textures are what a software rasteriser pays for.
class SeaTextures {
 public:
  /// Pre: 1..kRenderCascadesMax cascades of the same power-of-two N, all planes (N x N).
  void Upload(const std::vector<CascadePlanes>& cascades);

  const Texture& displacement() const { return displacement_; }
  const Texture& slope() const { return slope_; }

 private:
  void Allocate(int grid_size, int layers);

  Texture displacement_, slope_;
  int grid_size_ = 0, layers_ = 0;
  std::vector<float> texels_;  // one layer; not halved to 16 bits: that takes longer than it saves
};

}  // namespace onesea::render
