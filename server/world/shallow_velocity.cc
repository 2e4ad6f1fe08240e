#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/world/shallow_velocity.cc"
#include "hwy/foreach_target.h"
//
#include <cstddef>

#include "hwy/highway.h"
#include "server/world/shallow_water_kernel.h"
#include "server/world/tile_transpose-inl.h"

HWY_BEFORE_NAMESPACE();
namespace onesea::world {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;

// Water that flows through the face between two cells [m²/s].
HWY_INLINE V Flow(V level_a, V bottom_a, V level_b, V bottom_b, V velocity) {
  const D d;
  const V depth = hn::Sub(hn::Max(level_a, level_b), hn::Max(bottom_a, bottom_b));
  return hn::Mul(hn::Max(depth, hn::Zero(d)), velocity);
}

// One row of cells; `south` and `north` are the rows beside it, or the row itself at the rim, where
// the velocities through the outer face are zeros.
struct Row {
  const float *level, *south_level, *north_level;
  const float *bottom, *south_bottom, *north_bottom;
  const float *u, *v, *south_v;  // u[-1] is 0
  float *x, *y, *z;
};

// `flow` has room for a row, and a zero in front.
HWY_INLINE void VelocityOfRow(const Row& row, std::size_t columns, float per_cell, float* flow) {
  const D d;
  const V half = hn::Set(d, 0.5f);
  for (std::size_t i = 0; i < columns; i += hn::Lanes(d)) {
    hn::Store(Flow(hn::LoadU(d, row.level + i), hn::LoadU(d, row.bottom + i),
                   hn::LoadU(d, row.level + i + 1), hn::LoadU(d, row.bottom + i + 1),
                   hn::LoadU(d, row.u + i)),
              d, flow + i);
  }
  for (std::size_t i = 0; i < columns; i += hn::Lanes(d)) {
    const auto at = [&](const float* array) HWY_ATTR { return hn::LoadU(d, array + i); };
    const V level = at(row.level), bottom = at(row.bottom);
    const V u = at(row.u), west_u = at(row.u - 1), v = at(row.v), south_v = at(row.south_v);
    const V west = at(flow - 1), east = at(flow);
    const V south = Flow(at(row.south_level), at(row.south_bottom), level, bottom, south_v);
    const V north = Flow(level, bottom, at(row.north_level), at(row.north_bottom), v);
    const V rise =
        hn::Mul(hn::Set(d, per_cell), hn::Add(hn::Sub(west, east), hn::Sub(south, north)));
    const auto wet = hn::Gt(hn::Sub(level, bottom), hn::Set(d, kDryDepthM));
    hn::StoreU(hn::IfThenElseZero(wet, hn::Mul(half, hn::Add(u, west_u))), d, row.x + i);
    hn::StoreU(hn::IfThenElseZero(wet, hn::Mul(half, hn::Add(v, south_v))), d, row.y + i);
    hn::StoreU(hn::IfThenElseZero(wet, rise), d, row.z + i);
  }
}

void Velocities(const ShallowFields& f, float per_cell, float* x, float* y, float* z) {
  const std::size_t columns = f.columns, rows = f.rows, u_pitch = columns + kRowPadding;
  float* flow = f.flux.get() + kRowPadding;
  flow[-1] = 0.0f;
  float* u = f.level_across.get() + kRowPadding;  // (kStripLines x u_pitch)
  for (std::size_t strip = 0; strip < rows; strip += kStripLines) {
    tile::Transpose(f.u.get() + strip * columns, kStripLines, columns, kStripLines, u, u_pitch);
    for (std::size_t r = 0; r < kStripLines; ++r) {
      u[r * u_pitch - 1] = 0.0f;
      const std::size_t j = strip + r;
      const std::size_t here = j * f.pitch;
      const std::size_t south = j > 0 ? here - f.pitch : here;
      const std::size_t north = j + 1 < rows ? here + f.pitch : here;
      const float *level = f.level.get(), *bottom = f.bottom.get(), *v = f.v.get();
      const Row row = {.level = level + here,
                       .south_level = level + south,
                       .north_level = level + north,
                       .bottom = bottom + here,
                       .south_bottom = bottom + south,
                       .north_bottom = bottom + north,
                       .u = u + r * u_pitch,
                       .v = v + here,
                       .south_v = j > 0 ? v + south : f.zeros.get(),
                       .x = x + j * columns,
                       .y = y + j * columns,
                       .z = z + j * columns};
      VelocityOfRow(row, columns, per_cell, flow);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace onesea::world
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace onesea::world {
HWY_EXPORT(Velocities);

void ShallowWaterVelocities(const ShallowFields& fields, float per_cell, float* x, float* y,
                            float* z) {
  HWY_DYNAMIC_DISPATCH(Velocities)(fields, per_cell, x, y, z);
}

}  // namespace onesea::world
#endif  // HWY_ONCE
