#include "server/world/iwave_operator.h"

#include <algorithm>
#include <cmath>

namespace onesea::world {
namespace {

constexpr int kBlock = 16;  // cells of a block's side: a vector, and several times the kernel
constexpr double kNodeMinCells = 0.25;
constexpr double kNodeRatio = 1.41421356237309504880;  // √2

void Clear(const ConvolveRange& range, WavePlane& plane) {
  for (int y = range.first_row; y < range.last_row; ++y) {
    std::fill(plane.Row(y) + range.first_column, plane.Row(y) + range.last_column, 0.0f);
  }
}

ConvolveRange WholeOf(const WavePlane& plane) {
  return {.last_column = plane.columns, .last_row = plane.rows};
}

bool AnyInBlock(const WavePlane& plane, int block_x, int block_y) {
  for (int y = block_y * kBlock; y < std::min((block_y + 1) * kBlock, plane.rows); ++y) {
    const float* row = plane.Row(y);
    for (int x = block_x * kBlock; x < std::min((block_x + 1) * kBlock, plane.columns); ++x) {
      if (row[x] != 0.0f) return true;
    }
  }
  return false;
}

// Which blocks of a plane hold anything.
class BlockMap {
 public:
  explicit BlockMap(const WavePlane& plane)
      : plane_(&plane),
        across_((plane.columns + kBlock - 1) / kBlock),
        along_((plane.rows + kBlock - 1) / kBlock) {
    for (int y = 0; y < along_; ++y) {
      for (int x = 0; x < across_; ++x) any_.push_back(AnyInBlock(plane, x, y));
    }
  }

  bool Active(int x, int y) const {
    return x >= 0 && y >= 0 && x < across_ && y < along_ &&
           any_[static_cast<std::size_t>(y) * across_ + x];
  }
  // Not active itself, but beside one that is.
  bool Ring(int x, int y) const {
    if (Active(x, y)) return false;
    for (int n = 0; n < 9; ++n) {
      if (Active(x + n % 3 - 1, y + n / 3 - 1)) return true;
    }
    return false;
  }

  std::vector<ConvolveRange> Strips() const {
    std::vector<ConvolveRange> runs;
    for (int x = 0; x < across_; ++x) {
      for (int y = 0; y < along_; ++y) {
        if (!Active(x, y)) continue;
        const int first = y;
        while (Active(x, y + 1)) ++y;
        runs.push_back(Range(x, x, first, y));
      }
    }
    return runs;
  }
  std::vector<ConvolveRange> Rows(bool (BlockMap::*has)(int, int) const) const {
    std::vector<ConvolveRange> runs;
    for (int y = 0; y < along_; ++y) {
      for (int x = 0; x < across_; ++x) {
        if (!(this->*has)(x, y)) continue;
        const int first = x;
        while (x + 1 < across_ && (this->*has)(x + 1, y)) ++x;
        runs.push_back(Range(first, x, y, y));
      }
    }
    return runs;
  }

 private:
  ConvolveRange Range(int first_x, int last_x, int first_y, int last_y) const {
    return {.first_column = first_x * kBlock,
            .last_column = std::min((last_x + 1) * kBlock, plane_->columns),
            .first_row = first_y * kBlock,
            .last_row = std::min((last_y + 1) * kBlock, plane_->rows)};
  }

  const WavePlane* plane_;
  int across_, along_;
  std::vector<bool> any_;
};

// The values of these ranges in the order in which Weigh reads them.
sea::FloatArray Packed(const WavePlane& plane, const std::vector<ConvolveRange>& ranges) {
  std::size_t count = 0;
  for (const ConvolveRange& range : ranges) count += PackedCells(range);
  sea::FloatArray packed = sea::AllocateZeros<float>(count + 1);
  float* to = packed.get();
  for (const ConvolveRange& range : ranges) {
    const std::size_t pitch = PackedCells(range) / (range.last_row - range.first_row);
    for (int y = range.first_row; y < range.last_row; ++y, to += pitch) {
      std::copy(plane.Row(y) + range.first_column, plane.Row(y) + range.last_column, to);
    }
  }
  return packed;
}

// Weight of node n for a depth, both in the series kNodeMinCells kNodeRatio^n.
double NodeWeight(const std::vector<double>& depths, std::size_t n, double depth) {
  if (!(depth > 0.0)) return 0.0;
  if (n == 0 && depth <= depths[0]) return depth / depths[0];
  if (n + 1 == depths.size() && depth >= depths[n]) return 1.0;
  if (n > 0 && depth > depths[n - 1] && depth <= depths[n]) {
    return (depth - depths[n - 1]) / (depths[n] - depths[n - 1]);
  }
  if (n + 1 < depths.size() && depth > depths[n] && depth < depths[n + 1]) {
    return (depths[n + 1] - depth) / (depths[n + 1] - depths[n]);
  }
  return 0.0;
}

}  // namespace

FlatIntegral::FlatIntegral(int columns, int rows, const IwaveKernels& kernels) : kernels_(kernels) {
  for (int level = 1; level < kernels.levels; ++level) {
    in_.emplace_back(columns >> level, rows >> level);
    out_.emplace_back(columns >> level, rows >> level);
  }
}

void FlatIntegral::Apply(const WavePlane& in, WavePlane& out) {
  const WavePlane* fine = &in;
  Convolve(in, kernels_.taps[0], WholeOf(in), out);
  for (std::size_t n = 0; n < in_.size(); ++n) {
    Restrict(*fine, in_[n]);
    Convolve(in_[n], kernels_.taps[n + 1], WholeOf(in_[n]), out_[n]);
    fine = &in_[n];
  }
  for (std::size_t n = in_.size(); n-- > 0;) ProlongAdd(out_[n], n > 0 ? out_[n - 1] : out);
}

IwaveNodes DesignIwaveNodes(double least_cells, double greatest_cells, double step_number,
                            int levels_max) {
  IwaveNodes nodes;
  nodes.depth_cells = {least_cells < greatest_cells ? kNodeMinCells : greatest_cells};
  while (nodes.depth_cells.back() < greatest_cells) {
    nodes.depth_cells.push_back(nodes.depth_cells.back() * kNodeRatio);
  }
  for (const double depth : nodes.depth_cells) {
    nodes.kernels.push_back(DesignIwave(depth, step_number, levels_max));
  }
  return nodes;
}

TerrainIntegral::TerrainIntegral(const WavePlane& depth_cells, const IwaveNodes& nodes) {
  const int columns = depth_cells.columns, rows = depth_cells.rows;
  WavePlane ones(columns, rows);
  for (int y = 0; y < rows; ++y) std::fill_n(ones.Row(y), columns, 1.0f);
  for (int level = 0; level < IwaveLevelsFor(columns, rows); ++level) {
    if (level > 0) Restrict(ones_.back(), ones);
    levels_.push_back({});
    if (level > 0) levels_.back().in = WavePlane(columns >> level, rows >> level);
    if (level > 0) levels_.back().out = WavePlane(columns >> level, rows >> level);
    levels_.back().weighted = WavePlane(columns >> level, rows >> level);
    levels_.back().convolved = WavePlane(columns >> level, rows >> level);
    ones_.push_back(std::move(ones));
    ones = WavePlane(columns >> (level + 1), rows >> (level + 1));
  }
  for (std::size_t n = 0; n < nodes.kernels.size(); ++n) {
    WavePlane weight(columns, rows);
    bool any = false;
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) {
        const double part = NodeWeight(nodes.depth_cells, n, depth_cells.Row(y)[x]);
        weight.Row(y)[x] = static_cast<float>(part);
        any = any || part > 0.0;
      }
    }
    if (any) AddNode(nodes.kernels[n], std::move(weight));
  }
}

// On coarser grids the weight is the mean that R takes, over the cells that exist.
void TerrainIntegral::AddNode(const IwaveKernels& kernels, WavePlane weight) {
  for (int level = 0; level < kernels.levels; ++level) {
    WavePlane root(weight.columns, weight.rows);
    for (int y = 0; y < weight.rows; ++y) {
      for (int x = 0; x < weight.columns; ++x) {
        const float share = weight.Row(y)[x];
        if (share > 0.0f) root.Row(y)[x] = std::sqrt(share / ones_[level].Row(y)[x]);
      }
    }
    const BlockMap blocks(root);
    Node node{.taps = kernels.taps[level],
              .root_weight = {},
              .strips = blocks.Strips(),
              .rows = blocks.Rows(&BlockMap::Active),
              .around = blocks.Rows(&BlockMap::Ring)};
    node.root_weight = Packed(root, node.rows);
    levels_[level].nodes.push_back(std::move(node));
    if (level + 1 == kernels.levels) break;
    WavePlane coarse(weight.columns / 2, weight.rows / 2);
    Restrict(weight, coarse);
    weight = std::move(coarse);
  }
}

void TerrainIntegral::Apply(const WavePlane& in, WavePlane& out) {
  std::size_t used = 0;
  while (used < levels_.size() && !levels_[used].nodes.empty()) ++used;
  const WavePlane* fine = &in;
  for (std::size_t n = 0; n < std::max<std::size_t>(used, 1); ++n) {
    Level& level = levels_[n];
    WavePlane& sum = n == 0 ? out : level.out;
    if (n > 0) Restrict(*fine, level.in);
    if (n > 0) fine = &level.in;
    for (int y = 0; y < sum.rows; ++y) std::fill_n(sum.Row(y), sum.columns, 0.0f);
    for (const Node& node : level.nodes) {
      for (const ConvolveRange& range : node.around) Clear(range, level.weighted);
      const float* weight = node.root_weight.get();
      for (const ConvolveRange& range : node.rows) {
        Weigh(*fine, weight, range, level.weighted);
        weight += PackedCells(range);
      }
      for (const ConvolveRange& range : node.strips) {
        Convolve(level.weighted, node.taps, range, level.convolved);
      }
      weight = node.root_weight.get();
      for (const ConvolveRange& range : node.rows) {
        AddWeighed(level.convolved, weight, range, sum);
        weight += PackedCells(range);
      }
    }
  }
  for (std::size_t n = used; n-- > 1;) ProlongAdd(levels_[n].out, n > 1 ? levels_[n - 1].out : out);
}

}  // namespace onesea::world
