#pragma once

#include <memory>

#include "client/render/frame_block.h"
#include "client/render/gl_objects.h"
#include "client/render/render_frame.h"

namespace onesea::render {

/// What the planes of the sea are multiplied with at a place: a 2-D array, RGBA16F, four planes a
/// layer.
class AttenuationTexture {
 public:
  static constexpr int kLayers = 3;  ///< 8 cascades and the regular waves

  AttenuationTexture();

  /// Uploads a grid that is another one than last time, and fills the block's words. Null or
  /// without cells: 1 everywhere. Cost: 1 ms for 400 x 400 cells and 4 planes.
  void Update(const std::shared_ptr<const sea::AttenuationGrid>& grid, Vec2d eye,
              FrameBlock& block);

  const Texture& factors() const { return factors_; }
  bool any() const { return grid_ != nullptr; }

 private:
  void Upload(const sea::AttenuationGrid& grid);
  void UploadOne();

  Texture factors_;
  std::shared_ptr<const sea::AttenuationGrid> grid_;
};

}  // namespace onesea::render
