#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "client/render/frame_block.h"
#include "client/render/gl_objects.h"
#include "client/render/render_frame.h"

namespace onesea::render {

/// Terrain on the graphics card, with mips:
///
///   ground  RGBA32F  elevation [m], slope_x, slope_y, relief [m]
///   grain   RGBA8    fine noise, periodic: value, two slopes (0.5 is level), walls between cells
///
/// Samples of small terrain are interpolated by Catmull-Rom's cubic, which goes through them, kept
/// between its neighbours; large terrain is thinned to kSideMax. Relief is elevation at the finest
/// level; above, the mean of the mean and the highest, so that narrow walls stand in a coarse mesh,
/// too.
class GroundTextures {
 public:
  static constexpr int kSideMax = 2048;
  static constexpr int kMips = 8;

  /// Uploads `terrain` if it is another one than last time (0.1 to 0.5 s) and fills the block's
  /// ground words. Before the first one, the textures are empty. Pre: not null.
  void Update(const std::shared_ptr<const sea::Terrain>& terrain, Vec2d eye, double water_level_m,
              FrameBlock& block);

  const Texture& ground() const { return ground_; }
  const Texture& grain() const { return grain_; }

  /// Of the finest level: place of texel (0, 0), its size, texels that hold terrain.
  Vec2d first_m() const { return first_m_; }
  double texel_m() const { return texel_m_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  /// Square tiles of (kTileQuads << level) texels a side; of one level there are enough to cover
  /// the terrain, of the last one there is one.
  static constexpr int kTileQuads = 16;
  int levels() const { return static_cast<int>(tiles_.size()); }
  struct Range {
    float low_m = 1e9f, high_m = -1e9f;
  };
  /// Lowest and highest elevation of a tile; low > high beyond the terrain.
  Range RangeOf(int level, int column, int row) const;

 private:
  void MakeGrain();
  void Upload(const sea::Terrain& terrain);
  void FindRanges(const std::vector<float>& elevation_m);
  void UploadLevels(const std::vector<float>& elevation_m);

  std::shared_ptr<const sea::Terrain> terrain_;
  Texture ground_, grain_;
  Vec2d first_m_;
  double texel_m_ = 1.0;
  int columns_ = 0, rows_ = 0, width_ = 0, height_ = 0;
  struct TileLevel {
    int columns = 0, rows = 0;
    std::vector<Range> ranges;
  };
  std::vector<TileLevel> tiles_;
};

}  // namespace onesea::render
