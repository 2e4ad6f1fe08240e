// Foam of one region: moves with the water, fades, grows where the surface is steep.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/world/interaction_foam.cc"
#include "hwy/foreach_target.h"
//
#include "hwy/highway.h"

#ifndef ONESEA_WORLD_FOAM_ROW
#define ONESEA_WORLD_FOAM_ROW
namespace onesea::world {

inline constexpr int kFoamLanes = 16;
inline constexpr float kNoFoam = 1.0f / 512.0f;  // half of what 8 bits can tell

struct FoamRow {
  int row, columns, rows;  // whole vectors of columns
  const float* shares;     // of all rows
  const float *velocity_x, *velocity_y;
  const float* height_m;           // readable from -1 to `columns`
  const float *south_m, *north_m;  // the rows beside it
  float* out;
};
struct FoamRates {
  float per_two_cells, cells_per_m_per_s, keep, growth, steep;
};

}  // namespace onesea::world
#endif

HWY_BEFORE_NAMESPACE();
namespace onesea::world {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Each cell by itself, nothing fused: the same bits on every SIMD target.
void AdvanceRowOf(const FoamRow& row, const FoamRates& rates) {
  const hn::CappedTag<float, kFoamLanes> d;
  const hn::RebindToSigned<decltype(d)> di;
  const auto columns = hn::Set(di, row.columns);
  for (int column = 0; column < row.columns; column += static_cast<int>(hn::Lanes(d))) {
    const auto read = [&](const float* from) HWY_ATTR { return hn::LoadU(d, from + column); };
    // Where the water that is here now was.
    const auto was = [&](auto here, const float* speed, int count) HWY_ATTR {
      const auto at = hn::Sub(here, hn::Mul(hn::Set(d, rates.cells_per_m_per_s), read(speed)));
      return hn::Min(hn::Max(at, hn::Zero(d)), hn::Set(d, static_cast<float>(count - 1)));
    };
    const auto from_x = was(hn::ConvertTo(d, hn::Iota(di, column)), row.velocity_x, row.columns);
    const auto from_y = was(hn::Set(d, static_cast<float>(row.row)), row.velocity_y, row.rows);
    const auto x = hn::Min(hn::ConvertTo(di, from_x), hn::Set(di, row.columns - 2));
    const auto y = hn::Min(hn::ConvertTo(di, from_y), hn::Set(di, row.rows - 2));
    const auto wx = hn::Sub(from_x, hn::ConvertTo(d, x));
    const auto wy = hn::Sub(from_y, hn::ConvertTo(d, y));
    const auto along = [&](auto west) HWY_ATTR {
      const auto a = hn::GatherIndex(d, row.shares, west);
      return hn::Add(a, hn::Mul(wx, hn::Sub(hn::GatherIndex(d, row.shares + 1, west), a)));
    };
    const auto low = hn::Add(hn::Mul(y, columns), x);
    const auto on_low = along(low), on_high = along(hn::Add(low, columns));
    const auto carried = hn::Add(on_low, hn::Mul(wy, hn::Sub(on_high, on_low)));

    const auto per_two = hn::Set(d, rates.per_two_cells);
    const auto slope_x = hn::Mul(per_two, hn::Sub(read(row.height_m + 1), read(row.height_m - 1)));
    const auto slope_y = hn::Mul(per_two, hn::Sub(read(row.north_m), read(row.south_m)));
    const auto slope = hn::Sqrt(hn::Add(hn::Mul(slope_x, slope_x), hn::Mul(slope_y, slope_y)));
    const auto excess = hn::Max(hn::Sub(slope, hn::Set(d, rates.steep)), hn::Zero(d));
    const auto share = hn::Add(hn::Mul(hn::Set(d, rates.keep), carried),
                               hn::Mul(hn::Set(d, rates.growth), excess));
    const auto some = hn::Ge(share, hn::Set(d, kNoFoam));
    hn::StoreU(hn::IfThenElseZero(some, hn::Min(share, hn::Set(d, 1.0f))), d, row.out + column);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace onesea::world
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "common/base/check.h"
#include "common/base/real_math.h"
#include "server/world/interaction_foam.h"

namespace onesea::world {

HWY_EXPORT(AdvanceRowOf);

InteractionFoam::InteractionFoam(const sea::CellRect& cells, const FoamOptions& options)
    : cells_(cells),
      options_(options),
      shares_(cells.cells()),
      next_(cells.cells()),
      heights_m_(cells.columns + 2) {
  ONESEA_CHECK(cells.columns % kFoamLanes == 0) << cells.columns << " columns";
}

void InteractionFoam::Advance(double span_s, std::span<const float> height_m,
                              const sea::InteractionFlow& flow) {
  // Per row: nothing becomes of a row that has no foam within reach and no steep water.
  std::vector<bool> foam(cells_.rows), high(cells_.rows);
  // A slope is at most √2 of the highest beside it per cell.
  const auto limit_m = static_cast<float>(options_.steep * cells_.cell_m / std::sqrt(2.0));
  any_ = false;
  for (int row = 0; row < cells_.rows; ++row) {
    const std::size_t at = static_cast<std::size_t>(row) * cells_.columns;
    int is_high = 0, is_white = 0;
    for (int n = 0; n < cells_.columns; ++n) {
      is_high |= static_cast<int>(!(std::abs(height_m[at + n]) < limit_m));
      is_white |= static_cast<int>(shares_[at + n] > 0.0f);
    }
    foam[row] = is_white != 0;
    high[row] = is_high != 0;
    any_ = any_ || foam[row] || high[row];
  }
  if (!any_) return;
  changed_ = true;
  // Bits of positive floats are in their order, and integers need none of their own.
  std::int32_t fastest = 0;
  for (const float speed : flow.y) {
    fastest = std::max(fastest, std::bit_cast<std::int32_t>(std::abs(speed)));
  }
  const double cells = std::bit_cast<float>(fastest) * span_s / cells_.cell_m;
  const int reach = cells < cells_.rows ? static_cast<int>(cells) + 2 : cells_.rows;
  for (int row = 0; row < cells_.rows; ++row) {
    const auto within = [&](const std::vector<bool>& rows, int distance) {
      for (int n = std::max(row - distance, 0); n <= std::min(row + distance, cells_.rows - 1);
           ++n) {
        if (rows[n]) return true;
      }
      return false;
    };
    if (within(high, 1) || within(foam, reach)) {
      AdvanceRow(row, span_s, height_m, flow);
    } else {
      std::fill_n(next_.begin() + static_cast<std::ptrdiff_t>(row) * cells_.columns, cells_.columns,
                  0.0f);
    }
  }
  shares_.swap(next_);
}

void InteractionFoam::AdvanceRow(int row, double span_s, std::span<const float> height_m,
                                 const sea::InteractionFlow& flow) {
  const FoamRates rates{.per_two_cells = static_cast<float>(0.5 / cells_.cell_m),
                        .cells_per_m_per_s = static_cast<float>(span_s / cells_.cell_m),
                        .keep = static_cast<float>(real::Exp(-span_s / options_.life_s)),
                        .growth = static_cast<float>(options_.growth_per_s * span_s),
                        .steep = static_cast<float>(options_.steep)};
  const auto first = [&](int of) { return static_cast<std::size_t>(of) * cells_.columns; };
  const std::size_t at = first(row);
  // With neighbours for the cells at both ends.
  std::copy_n(height_m.begin() + at, cells_.columns, heights_m_.begin() + 1);
  heights_m_.front() = heights_m_[1];
  heights_m_.back() = heights_m_[cells_.columns];
  HWY_DYNAMIC_DISPATCH(AdvanceRowOf)
  ({.row = row,
    .columns = cells_.columns,
    .rows = cells_.rows,
    .shares = shares_.data(),
    .velocity_x = flow.x.data() + at,
    .velocity_y = flow.y.data() + at,
    .height_m = heights_m_.data() + 1,
    .south_m = height_m.data() + first(std::max(row - 1, 0)),
    .north_m = height_m.data() + first(std::min(row + 1, cells_.rows - 1)),
    .out = next_.data() + at},
   rates);
}

}  // namespace onesea::world
#endif  // HWY_ONCE
