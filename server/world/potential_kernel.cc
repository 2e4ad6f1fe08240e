#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/world/potential_kernel.cc"
#include "hwy/foreach_target.h"
//
#include <algorithm>
#include <cstddef>

#include "hwy/highway.h"
#include "server/world/potential_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace onesea::world {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;

HWY_INLINE V Calmed(V value) {
  const D d;
  return hn::IfThenZeroElse(hn::Lt(hn::Abs(value), hn::Set(d, kCalm)), value);
}

// keep_x keep_y; inside the border keep_x need not be read, and 1 changes no bit.
HWY_INLINE V Keep(const GridPass& grid, V keep_y, int x) {
  const D d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  if (x >= grid.border && x + lanes <= grid.columns - grid.border) return keep_y;
  return hn::Mul(hn::Load(d, grid.keep_x + x), keep_y);
}

HWY_INLINE void PotentialRow(const GridPass& grid, const PotentialPass& pass, int y) {
  const D d;
  float* phi = pass.phi->Row(y);
  const float* height = grid.height + static_cast<std::size_t>(y) * grid.columns;
  const V g_dt = hn::Set(d, pass.g_dt);
  const V keep_y = hn::Set(d, grid.keep_y[y] * pass.keep);
  const auto row = [&](const float* head) HWY_ATTR {
    for (int x = 0; x < grid.columns; x += static_cast<int>(hn::Lanes(d))) {
      V level = hn::Load(d, height + x);
      if (head != nullptr) level = hn::Add(level, hn::LoadU(d, head + x));
      const V moved = hn::Sub(hn::Load(d, phi + x), hn::Mul(g_dt, level));
      const V keep = Keep(grid, keep_y, x);
      hn::Store(Calmed(hn::Mul(moved, keep)), d, phi + x);
    }
  };
  row(pass.pressure_head == nullptr
          ? nullptr
          : pass.pressure_head + static_cast<std::size_t>(y) * grid.columns);
}

HWY_INLINE void CloseSides(WavePlane& psi, int y) {
  float* row = psi.Row(y);
  row[-1] = row[0];
  row[psi.columns] = row[psi.columns - 1];
}

HWY_INLINE void UniformRow(const GridPass& grid, const HeightPass& pass, int y) {
  const D d;
  const float* here = pass.psi->Row(y);
  const float* south = pass.psi->Row(std::max(y - 1, 0));
  const float* north = pass.psi->Row(std::min(y + 1, grid.rows - 1));
  float* height = grid.height + static_cast<std::size_t>(y) * grid.columns;
  const V conductance = hn::Set(d, pass.uniform), keep_y = hn::Set(d, grid.keep_y[y]);
  for (int x = 0; x < grid.columns; x += static_cast<int>(hn::Lanes(d))) {
    const V centre = hn::Load(d, here + x);
    const V across = hn::Sub(hn::Sub(hn::LoadU(d, here + x + 1), centre),
                             hn::Sub(centre, hn::LoadU(d, here + x - 1)));
    const V along =
        hn::Sub(hn::Sub(hn::Load(d, north + x), centre), hn::Sub(centre, hn::Load(d, south + x)));
    const V moved = hn::Sub(hn::Load(d, height + x), hn::Mul(conductance, hn::Add(across, along)));
    const V keep = Keep(grid, keep_y, x);
    hn::Store(Calmed(hn::Mul(moved, keep)), d, height + x);
  }
}

// The last column's east face and the last row's north face are closed (0), and so is the east face
// of the row before at its last column, which is read as the first column's west face.
HWY_INLINE void FacesRow(const GridPass& grid, const HeightPass& pass, int y) {
  const D d;
  const std::size_t at = static_cast<std::size_t>(y) * grid.columns;
  const float* here = pass.psi->Row(y);
  const float* south = pass.psi->Row(std::max(y - 1, 0));
  const float* north = pass.psi->Row(std::min(y + 1, grid.rows - 1));
  const float* east_face = pass.east + at;
  const float* north_face = pass.north + at;
  const float* south_face = y > 0 ? north_face - grid.columns : north_face;
  float* height = grid.height + at;
  const V keep_y = hn::Set(d, grid.keep_y[y]);
  for (int x = 0; x < grid.columns; x += static_cast<int>(hn::Lanes(d))) {
    const V centre = hn::Load(d, here + x);
    const V to_east =
        hn::Mul(hn::Load(d, east_face + x), hn::Sub(hn::LoadU(d, here + x + 1), centre));
    const V from_west =
        hn::Mul(hn::LoadU(d, east_face + x - 1), hn::Sub(centre, hn::LoadU(d, here + x - 1)));
    const V to_north =
        hn::Mul(hn::Load(d, north_face + x), hn::Sub(hn::Load(d, north + x), centre));
    const V from_south =
        hn::Mul(hn::Load(d, south_face + x), hn::Sub(centre, hn::Load(d, south + x)));
    const V moved = hn::Sub(hn::Load(d, height + x),
                            hn::Add(hn::Sub(to_east, from_west), hn::Sub(to_north, from_south)));
    const V keep = Keep(grid, keep_y, x);
    hn::Store(Calmed(hn::Mul(moved, keep)), d, height + x);
  }
}

HWY_INLINE void HeightRow(const GridPass& grid, const HeightPass& pass, int y) {
  if (pass.east == nullptr) {
    UniformRow(grid, pass, y);
  } else {
    FacesRow(grid, pass, y);
  }
}

void PotentialRows(const GridPass& grid, const PotentialPass& pass) {
  for (int y = 0; y < grid.rows; ++y) PotentialRow(grid, pass, y);
}

void HeightRows(const GridPass& grid, const HeightPass& pass) {
  for (int y = 0; y < grid.rows; ++y) CloseSides(*pass.psi, y);
  for (int y = 0; y < grid.rows; ++y) HeightRow(grid, pass, y);
}

// A row of heights follows two rows behind the potential: it needs the one to its north.
void BothRows(const GridPass& grid, const PotentialPass& potential, const HeightPass& height) {
  for (int y = 0; y < grid.rows; ++y) {
    PotentialRow(grid, potential, y);
    CloseSides(*potential.phi, y);
    if (y > 0) HeightRow(grid, height, y - 1);
  }
  HeightRow(grid, height, grid.rows - 1);
}

}  // namespace HWY_NAMESPACE
}  // namespace onesea::world
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace onesea::world {
HWY_EXPORT(PotentialRows);
HWY_EXPORT(HeightRows);
HWY_EXPORT(BothRows);

void AdvancePotential(const GridPass& grid, const PotentialPass& pass) {
  HWY_DYNAMIC_DISPATCH(PotentialRows)(grid, pass);
}
void AdvanceHeight(const GridPass& grid, const HeightPass& pass) {
  HWY_DYNAMIC_DISPATCH(HeightRows)(grid, pass);
}
void AdvanceBoth(const GridPass& grid, const PotentialPass& potential, const HeightPass& height) {
  HWY_DYNAMIC_DISPATCH(BothRows)(grid, potential, height);
}

}  // namespace onesea::world
#endif  // HWY_ONCE
