#include "server/world/interaction_foam.h"

#include <algorithm>
#include <cmath>

#include "common/base/real_math.h"

namespace onesea::world {
namespace {

constexpr float kNoFoam = 1.0f / 512.0f;  // half of what 8 bits can tell

}  // namespace

InteractionFoam::InteractionFoam(const sea::CellRect& cells, const FoamOptions& options)
    : cells_(cells), options_(options), shares_(cells.cells()), next_(cells.cells()) {}

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
  float fastest = 0.0f;
  for (const float speed : flow.y) fastest = std::max(fastest, std::abs(speed));
  const double cells = fastest * span_s / cells_.cell_m;
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
  const int columns = cells_.columns, rows = cells_.rows;
  const auto per_two_cells = static_cast<float>(0.5 / cells_.cell_m);
  const auto cells_per_m_per_s = static_cast<float>(span_s / cells_.cell_m);
  const auto keep = static_cast<float>(real::Exp(-span_s / options_.life_s));
  const auto growth = static_cast<float>(options_.growth_per_s * span_s);
  const auto steep = static_cast<float>(options_.steep);
  const auto at = [&](int x, int y) { return static_cast<std::size_t>(y) * columns + x; };
  const int south = std::max(row - 1, 0), north = std::min(row + 1, rows - 1);
  for (int column = 0; column < columns; ++column) {
    const int west = std::max(column - 1, 0), east = std::min(column + 1, columns - 1);
    const std::size_t here = at(column, row);
    // Where the water that is here now was.
    const float from_x = std::clamp(static_cast<float>(column) - cells_per_m_per_s * flow.x[here],
                                    0.0f, static_cast<float>(columns - 1));
    const float from_y = std::clamp(static_cast<float>(row) - cells_per_m_per_s * flow.y[here],
                                    0.0f, static_cast<float>(rows - 1));
    const int x = std::min(static_cast<int>(from_x), columns - 2);
    const int y = std::min(static_cast<int>(from_y), rows - 2);
    const float wx = from_x - static_cast<float>(x), wy = from_y - static_cast<float>(y);
    const float* low = &shares_[at(x, y)];
    const float* high = low + columns;
    const float on_low = low[0] + wx * (low[1] - low[0]);
    const float on_high = high[0] + wx * (high[1] - high[0]);
    float share = keep * (on_low + wy * (on_high - on_low));
    const float slope_x = per_two_cells * (height_m[at(east, row)] - height_m[at(west, row)]);
    const float slope_y =
        per_two_cells * (height_m[at(column, north)] - height_m[at(column, south)]);
    const float square = slope_x * slope_x + slope_y * slope_y;
    if (square > steep * steep) share += growth * (std::sqrt(square) - steep);
    next_[here] = share < kNoFoam ? 0.0f : std::min(share, 1.0f);
  }
}

}  // namespace onesea::world
