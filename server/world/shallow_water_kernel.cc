#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/world/shallow_water_kernel.cc"
#include "hwy/foreach_target.h"
//
#include <cstddef>

#include "hwy/highway.h"
#include "server/world/shallow_sweep-inl.h"
#include "server/world/shallow_water_kernel.h"
#include "server/world/tile_transpose-inl.h"

HWY_BEFORE_NAMESPACE();
namespace onesea::world {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Time in which a cell that is half solid follows its rest height [s].
constexpr float kHoldS = 0.1f;

template <bool kForced>
void SweepX(const Numbers& n, ShallowFields& f, const ShallowForcing& forcing) {
  const std::size_t columns = f.columns;
  for (std::size_t row = 0; row < static_cast<std::size_t>(f.rows); row += kStripLines) {
    float* level = f.level.get() + row * f.pitch;
    tile::Transpose(level, f.pitch, kStripLines, columns, f.level_across.get(), kStripLines);
    if constexpr (kForced) {
      tile::Transpose(forcing.pressure_head_m + row * columns, columns, kStripLines, columns,
                      f.pressure_across.get(), kStripLines);
      tile::Transpose(forcing.solid + row * columns, columns, kStripLines, columns,
                      f.solid_across.get(), kStripLines);
    }
    const Line line = {.level = f.level_across.get(),
                       .bottom = f.bottom_across.get() + row * columns,
                       .velocity = f.u.get() + row * columns,
                       .pressure = f.pressure_across.get(),
                       .solid = f.solid_across.get(),
                       .pressure_stride = kStripLines,
                       .height = nullptr,
                       .height_stride = 0,
                       .stride = kStripLines,
                       .cells = f.columns,
                       .keep_along = f.keep_x.get(),
                       .keep_across = f.keep_y.get() + row};
    SweepStrip<kForced>(n, line, f);
    tile::Transpose(f.level_across.get(), kStripLines, columns, kStripLines, level, f.pitch);
  }
}

template <bool kForced>
void SweepY(const Numbers& n, ShallowFields& f, const ShallowForcing& forcing) {
  for (std::size_t column = 0; column < static_cast<std::size_t>(f.columns);
       column += kStripLines) {
    const Line line = {.level = f.level.get() + column,
                       .bottom = f.bottom.get() + column,
                       .velocity = f.v.get() + column,
                       .pressure = kForced ? forcing.pressure_head_m + column : nullptr,
                       .solid = kForced ? forcing.solid + column : nullptr,
                       .pressure_stride = static_cast<std::size_t>(f.columns),
                       .height = f.height.get() + column,
                       .height_stride = static_cast<std::size_t>(f.columns),
                       .stride = f.pitch,
                       .cells = f.rows,
                       .keep_along = f.keep_y.get(),
                       .keep_across = f.keep_x.get() + column};
    SweepStrip<kForced>(n, line, f);
  }
}

// Sources, and what holds solid cells: in a step the share 1 - exp(-x), x = dt s / ((1 - s) T), of
// the way to the rest height, with exp(x) = 1 + x + x²/2: all of it for s = 1.
void ApplyForcing(ShallowFields& f, const ShallowForcing& forcing) {
  const D d;
  const V step = hn::Set(d, f.step_s), one = hn::Set(d, 1.0f), hold = hn::Set(d, kHoldS);
  const V least = hn::Set(d, 1e-30f);
  for (std::size_t row = 0; row < static_cast<std::size_t>(f.rows); ++row) {
    const std::size_t start = row * f.columns;
    for (std::size_t c = 0; c < static_cast<std::size_t>(f.columns); c += hn::Lanes(d)) {
      float* at = f.level.get() + row * f.pitch + c;
      V level = hn::Load(d, at);
      if (forcing.source_m != nullptr) {
        level = hn::Add(level, hn::LoadU(d, forcing.source_m + start + c));
      }
      if (forcing.rest_height_m != nullptr) {
        const V solid = hn::LoadU(d, forcing.solid + start + c);
        const V pull = hn::Mul(step, solid), slack = hn::Mul(hold, hn::Sub(one, solid));
        const V part = hn::Mul(pull, hn::Add(slack, hn::Mul(hn::Set(d, 0.5f), pull)));
        const V share = hn::Div(part, hn::Max(hn::Add(part, hn::Mul(slack, slack)), least));
        const V rest = hn::LoadU(d, forcing.rest_height_m + start + c);
        level = hn::Add(level, hn::Mul(share, hn::Sub(rest, level)));
      }
      hn::Store(hn::Max(level, hn::Load(d, f.bottom.get() + row * f.pitch + c)), d, at);
    }
  }
}

void Step(ShallowFields& f, const ShallowForcing& forcing) {
  const bool held = forcing.rest_height_m != nullptr;
  const Numbers n(f, held);
  if (held || forcing.source_m != nullptr) ApplyForcing(f, forcing);
  if (forcing.pressure_head_m != nullptr || forcing.solid != nullptr) {
    ShallowForcing whole = forcing;
    if (whole.pressure_head_m == nullptr) whole.pressure_head_m = f.zeros.get();
    if (whole.solid == nullptr) whole.solid = f.zeros.get();
    SweepX<true>(n, f, whole);
    SweepY<true>(n, f, whole);
  } else {
    SweepX<false>(n, f, forcing);
    SweepY<false>(n, f, forcing);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace onesea::world
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace onesea::world {
HWY_EXPORT(Step);

void StepShallowWater(ShallowFields& fields, const ShallowForcing& forcing) {
  HWY_DYNAMIC_DISPATCH(Step)(fields, forcing);
}

}  // namespace onesea::world
#endif  // HWY_ONCE
