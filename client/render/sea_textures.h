#pragma once

#include <vector>

#include "client/render/gl_objects.h"
#include "client/render/render_frame.h"

namespace onesea::render {

/// The sea's fields on the graphics card: three 2-D arrays, one layer per cascade, with mips.
///
///   displacement  RGBA16F  D_x, D_y, eta, 0
///   slope         RGBA16F  slope_x, slope_y, J_xx, J_yy
///   moment        RGBA16F  J_xy, slope_x², slope_y², slope_x slope_y
///
/// A mip of the squares less the square of the mip is the slope variance that the mip has lost
/// (LEAN mapping, Olano & Baker 2010); the shader turns it into roughness.
class SeaTextures {
 public:
  /// Pre: 1..kRenderCascadesMax cascades of the same power-of-two N, all planes (N x N).
  void Upload(const std::vector<CascadePlanes>& cascades);
  /// Rebuilds the mips; separate from Upload() so that it can be timed.
  void MakeMips();

  const Texture& displacement() const { return displacement_; }
  const Texture& slope() const { return slope_; }
  const Texture& moment() const { return moment_; }

 private:
  void Allocate(int grid_size, int layers);

  Texture displacement_, slope_, moment_;
  int grid_size_ = 0, layers_ = 0;
  std::vector<float> texels_;  // one layer; the driver makes halves of them, faster than we could
};

}  // namespace onesea::render
