#pragma once

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

/// Kernels for a series of depths.
struct IwaveNodes {
  std::vector<double> depth_cells;
  std::vector<IwaveKernels> kernels;  ///< one each
};

/// Nodes for water of depths up to `greatest`, each √2 times the one before; a single one if all
/// water is as deep. Cost: 0.6 ms a node.
IwaveNodes DesignIwaveNodes(double least_cells, double greatest_cells, double step_number,
                            int levels_max);

/// Water of a depth that varies: T = Σ b_n T_n b_n over node depths in a geometric series, b_n² the
/// weights of linear interpolation in depth. Symmetric whatever the terrain, so energy is kept and
/// a wave's height follows its group velocity; on land T is zero. At a depth between two nodes the
/// frequency is at most 0.7 % low; in the limit of shallow water T is exactly the depth.
class TerrainIntegral {
 public:
  /// `depth_cells`: of still water at the samples of the grid; <= 0 on land.
  TerrainIntegral(const WavePlane& depth_cells, const IwaveNodes& nodes);
  /// Allocates nothing. Cost: about four times that of FlatIntegral.
  void Apply(const WavePlane& in, WavePlane& out);

 private:
  struct Node {
    IwaveTaps taps;
    sea::FloatArray root_weight;  // b_n at the cells of `rows`, one range after the other
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
