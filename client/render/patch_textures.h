#pragma once

#include <vector>

#include "client/render/frame_block.h"
#include "client/render/gl_objects.h"
#include "client/render/render_frame.h"

namespace onesea::render {

/// The interaction layer on the graphics card: two 2-D arrays, one layer per patch in view, with
/// mips. Beyond a patch both are 0.
///
///   height  R32F     eta
///   slope   RGBA32F  slope_x, slope_y, foam, slope_x² + slope_y²
///
/// Slopes are central differences: those of a Catmull-Rom spline at the cells.
class PatchTextures {
 public:
  PatchTextures();

  /// Uploads what changed of the patches that `block`'s camera can see, and fills the block's
  /// patch words and counts.w. Cost: 2 ms for 256² cells; nothing for a patch that did not change.
  void Update(const std::vector<WaterPatch>& patches, Vec2d eye, FrameBlock& block);

  const Texture& height() const { return height_; }
  const Texture& slope() const { return slope_; }

  /// Layers uploaded so far, for tests.
  int uploads() const { return uploads_; }

 private:
  struct Layer {
    WaterPatch patch;  // its spans are stale
    bool filled = false;
  };
  void Reserve(int columns, int rows, int layers);
  void Upload(const WaterPatch& patch, int layer);

  Texture height_, slope_;
  int width_ = 0, rows_ = 0;  // of a layer
  std::vector<Layer> layers_;
  std::vector<float> eta_, texels_;
  int uploads_ = 0;
};

/// The greatest height [m], up or down, of any patch.
double LargestHeightM(const std::vector<WaterPatch>& patches);

}  // namespace onesea::render
