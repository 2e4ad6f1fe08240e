#pragma once

#include <functional>
#include <vector>

#include "server/world/iwave_design.h"
#include "server/world/iwave_kernel.h"
#include "server/world/wave_plane.h"

/// T of iwave_design.h applied to grids: potential in, potential integrated over the depth out, in
/// units of cells.
namespace onesea::world {

/// Water of one depth.
class FlatIntegral {
 public:
  FlatIntegral(int columns, int rows, const IwaveKernels& kernels);
  /// Allocates nothing. Pre: both have the grid's size, the margin of `in` is zero.
  void Apply(const WavePlane& in, WavePlane& out);

 private:
  IwaveKernels kernels_;
  std::vector<WavePlane> in_, out_;  // of level n + 1
};

/// Water of a depth that varies: T = Σ b_n T_n b_n over node depths in a geometric series, b_n² the
/// weights of linear interpolation in depth. Symmetric whatever the terrain, so energy is kept and
/// a wave's height follows its group velocity; on land T is zero. At a depth between two nodes the
/// frequency is at most 0.7 % low; in the limit of shallow water T is exactly the depth.
class TerrainIntegral {
 public:
  /// `depth_cells(column, row)`: of still water at a sample of the grid; <= 0 on land. Infinity is
  /// allowed. A flat bottom gets one node, its own depth.
  TerrainIntegral(int columns, int rows, const std::function<double(int, int)>& depth_cells,
                  double step_number);
  /// Allocates nothing. Cost: two to three times that of FlatIntegral where the depth varies.
  void Apply(const WavePlane& in, WavePlane& out);

 private:
  struct Node {
    IwaveTaps taps;
    WavePlane root_weight;  // b_n on this level's grid
    // Where b_n is not zero, in blocks: strips for the convolution, which marches along y, and rows
    // of blocks for the passes that stream. `around` is the ring of blocks that it reads beyond.
    std::vector<ConvolveRange> strips, rows, around;
  };
  struct Level {
    WavePlane in, out;  // not used on level 0
    WavePlane weighted, convolved;
    std::vector<Node> nodes;
  };
  void AddNode(const IwaveKernels& kernels, WavePlane weight);

  std::vector<Level> levels_;
  std::vector<WavePlane> ones_;  // R..R 1 per level
};

}  // namespace onesea::world
