#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/sea/foam_kernel.cc"
#include "hwy/foreach_target.h"
//
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "common/sea/foam_kernel.h"
#include "common/sea/grid_cell-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace onesea::sea {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;
constexpr std::size_t kBlock = 64;

struct alignas(64) FoamBlock {
  std::int32_t offset[kBlock];  // of the cell's lower left corner, in floats
  float wu[kBlock], wv[kBlock];
  std::int32_t iu[kBlock], iv[kBlock];
  float corners[4][4 * kBlock];
  float xx[kBlock], yy[kBlock], xy[kBlock];
};

// Cell and weights of each foam cell's centre.
HWY_INLINE void Place(const FoamGrid& grid, const FoamRow& row, std::int64_t first_i,
                      FoamBlock& block) {
  const GridCells::DD d;
  const GridCells cells(grid.cosine, grid.sine, grid.cells_per_m, grid.grid_size);
  const auto cell = hn::Set(d, row.cell_m);
  const auto y = hn::Set(d, row.origin_m.y + (static_cast<double>(row.j) + 0.5) * row.cell_m);
  for (std::size_t n = 0; n < kBlock; n += hn::Lanes(d)) {
    const auto i = hn::Add(hn::Iota(d, static_cast<double>(n) + 0.5),
                           hn::Set(d, static_cast<double>(first_i)));
    const auto x = hn::Add(hn::Set(d, row.origin_m.x), hn::Mul(i, cell));
    cells.Place(x, y, block.wu + n, block.iu + n, block.wv + n, block.iv + n);
  }
  const hn::RebindToSigned<D> d32;
  const auto pitch = hn::Set(d32, grid.grid_size + 1);
  for (std::size_t n = 0; n < kBlock; n += hn::Lanes(d32)) {
    const auto at =
        hn::Add(hn::Mul(hn::Load(d32, block.iv + n), pitch), hn::Load(d32, block.iu + n));
    hn::Store(hn::ShiftLeft<2>(at), d32, block.offset + n);
  }
}

HWY_INLINE V Lerp(V a, V b, V w) { return hn::Add(a, hn::Mul(w, hn::Sub(b, a))); }

HWY_INLINE void AddGrid(const FoamGrid& grid, FoamBlock& block) {
  const D d;
  const std::size_t up = 4 * static_cast<std::size_t>(grid.grid_size + 1);
  for (std::size_t n = 0; n < kBlock; ++n) {
    const float* at = grid.values.get() + block.offset[n];
    std::memcpy(block.corners[0] + 4 * n, at, 16);
    std::memcpy(block.corners[1] + 4 * n, at + 4, 16);
    std::memcpy(block.corners[2] + 4 * n, at + up, 16);
    std::memcpy(block.corners[3] + 4 * n, at + up + 4, 16);
  }
  for (std::size_t n = 0; n < kBlock; n += hn::Lanes(d)) {
    V xx[4], yy[4], xy[4], unused;
    for (int c = 0; c < 4; ++c) {
      hn::LoadInterleaved4(d, block.corners[c] + 4 * n, xx[c], yy[c], xy[c], unused);
    }
    const V wu = hn::Load(d, block.wu + n), wv = hn::Load(d, block.wv + n);
    const auto add = [&](float* sum, const V(&c)[4]) HWY_ATTR {
      const V value = Lerp(Lerp(c[0], c[1], wu), Lerp(c[2], c[3], wu), wv);
      hn::Store(hn::Add(hn::Load(d, sum + n), value), d, sum + n);
    };
    add(block.xx, xx);
    add(block.yy, yy);
    add(block.xy, xy);
  }
}

void GrowthOfRow(std::span<const FoamGrid> grids, const FoamRow& row, float threshold, float gain,
                 std::span<std::uint8_t> growth) {
  const D d;
  const hn::RebindToSigned<D> di;
  FoamBlock block;
  for (std::size_t start = 0; start < growth.size(); start += kBlock) {
    std::memset(block.xx, 0, 3 * sizeof block.xx);
    for (const FoamGrid& grid : grids) {
      Place(grid, row, row.first_i + static_cast<std::int64_t>(start), block);
      AddGrid(grid, block);
    }
    const V one = hn::Set(d, 1.0f);
    for (std::size_t n = 0; n < kBlock; n += hn::Lanes(d)) {
      const V xx = hn::Add(one, hn::Load(d, block.xx + n));
      const V yy = hn::Add(one, hn::Load(d, block.yy + n));
      const V xy = hn::Load(d, block.xy + n);
      const V determinant = hn::Sub(hn::Mul(xx, yy), hn::Mul(xy, xy));
      const V excess = hn::Mul(hn::Set(d, gain), hn::Sub(hn::Set(d, threshold), determinant));
      const V clamped = hn::Min(hn::Max(excess, hn::Zero(d)), one);
      const V scaled = hn::Add(hn::Mul(clamped, hn::Set(d, 255.0f)), hn::Set(d, 0.5f));
      hn::Store(hn::ConvertTo(di, scaled), di, block.offset + n);
    }
    const std::size_t count = HWY_MIN(kBlock, growth.size() - start);
    for (std::size_t n = 0; n < count; ++n) {
      growth[start + n] = static_cast<std::uint8_t>(block.offset[n]);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace onesea::sea
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "common/sea/wave_frame.h"

namespace onesea::sea {
HWY_EXPORT(GrowthOfRow);

FoamGrid::FoamGrid(const Cascade& cascade) : grid_size(cascade.query_grid_size) {
  const CascadeFrame frame(cascade);
  cosine = frame.cosine;
  sine = frame.sine;
  cells_per_m = grid_size / frame.length_m;
  const std::size_t pitch = static_cast<std::size_t>(grid_size) + 1;
  values = AllocateZeros<float>(4 * pitch * pitch);
}

void FoamGrid::Fill(const CascadeFields& fields) {
  const float* xx = fields.Plane(Field::kJacobianXX).data();
  const float* yy = fields.Plane(Field::kJacobianYY).data();
  const float* xy = fields.Plane(Field::kJacobianXY).data();
  const std::size_t size = static_cast<std::size_t>(grid_size), pitch = size + 1;
  for (std::size_t y = 0; y < size; ++y) {
    float* row = values.get() + 4 * y * pitch;
    for (std::size_t x = 0; x < size; ++x) {
      row[4 * x] = xx[y * size + x];
      row[4 * x + 1] = yy[y * size + x];
      row[4 * x + 2] = xy[y * size + x];
    }
    std::memcpy(row + 4 * size, row, 4 * sizeof(float));
  }
  std::memcpy(values.get() + 4 * size * pitch, values.get(), 4 * pitch * sizeof(float));
}

void FoamGrowth(std::span<const FoamGrid> grids, const FoamRow& row, float threshold, float gain,
                std::span<std::uint8_t> growth) {
  HWY_DYNAMIC_DISPATCH(GrowthOfRow)(grids, row, threshold, gain, growth);
}

}  // namespace onesea::sea
#endif  // HWY_ONCE
