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

TerrainIntegral::TerrainIntegral(int columns, int rows,
                                 const std::function<double(int, int)>& depth_cells,
                                 double step_number) {
  const int levels_max = IwaveLevelsFor(columns, rows);
  WavePlane ones(columns, rows), depth(columns, rows);
  double greatest = 0.0, least = kIwaveDeepCells;  // of water
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      ones.Row(y)[x] = 1.0f;
      const double cells = std::clamp(depth_cells(x, y), 0.0, kIwaveDeepCells);
      depth.Row(y)[x] = static_cast<float>(cells);
      greatest = std::max(greatest, cells);
      if (cells > 0.0) least = std::min(least, cells);
    }
  }
  for (int level = 0; level < levels_max; ++level) {
    if (level > 0) Restrict(ones_.back(), ones);
    levels_.push_back({});
    if (level > 0) levels_.back().in = WavePlane(columns >> level, rows >> level);
    if (level > 0) levels_.back().out = WavePlane(columns >> level, rows >> level);
    levels_.back().weighted = WavePlane(columns >> level, rows >> level);
    levels_.back().convolved = WavePlane(columns >> level, rows >> level);
    ones_.push_back(std::move(ones));
    ones = WavePlane(columns >> (level + 1), rows >> (level + 1));
  }
  std::vector<double> depths{least < greatest ? kNodeMinCells : greatest};
  while (depths.back() < greatest) depths.push_back(depths.back() * kNodeRatio);
  for (std::size_t n = 0; n < depths.size(); ++n) {
    WavePlane weight(columns, rows);
    bool any = false;
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) {
        weight.Row(y)[x] = static_cast<float>(NodeWeight(depths, n, depth.Row(y)[x]));
        any = any || weight.Row(y)[x] > 0.0f;
      }
    }
    if (any) AddNode(DesignIwave(depths[n], step_number, levels_max), std::move(weight));
  }
}

// On coarser grids the weight is the mean that R takes, over the cells that exist.
void TerrainIntegral::AddNode(const IwaveKernels& kernels, WavePlane weight) {
  for (int level = 0; level < kernels.levels; ++level) {
    Node node{.taps = kernels.taps[level],
              .root_weight = WavePlane(weight.columns, weight.rows),
              .strips = {},
              .rows = {},
              .around = {}};
    for (int y = 0; y < weight.rows; ++y) {
      for (int x = 0; x < weight.columns; ++x) {
        node.root_weight.Row(y)[x] = std::sqrt(weight.Row(y)[x] / ones_[level].Row(y)[x]);
      }
    }
    const BlockMap blocks(node.root_weight);
    node.strips = blocks.Strips();
    node.rows = blocks.Rows(&BlockMap::Active);
    node.around = blocks.Rows(&BlockMap::Ring);
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
      for (const ConvolveRange& range : node.rows) {
        Weigh(*fine, node.root_weight, range, level.weighted);
      }
      for (const ConvolveRange& range : node.strips) {
        Convolve(level.weighted, node.taps, range, level.convolved);
      }
      for (const ConvolveRange& range : node.rows) {
        AddWeighed(level.convolved, node.root_weight, range, sum);
      }
    }
  }
  for (std::size_t n = used; n-- > 1;) ProlongAdd(levels_[n].out, n > 1 ? levels_[n - 1].out : out);
}

}  // namespace onesea::world
