#include "common/sea/interaction_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/base/check.h"
#include "hwy/cache_control.h"

namespace onesea::sea {
namespace {

// Catmull-Rom weights of the samples at -1, 0, 1, 2, and their derivatives, at t in [0, 1).
struct Weights {
  explicit Weights(double t)
      : value{0.5 * t * (t * (2.0 - t) - 1.0), 0.5 * (t * t * (3.0 * t - 5.0) + 2.0),
              0.5 * t * (t * (4.0 - 3.0 * t) + 1.0), 0.5 * t * t * (t - 1.0)},
        slope{0.5 * (t * (4.0 - 3.0 * t) - 1.0), 0.5 * t * (9.0 * t - 10.0),
              0.5 * (t * (8.0 - 9.0 * t) + 1.0), 0.5 * t * (3.0 * t - 2.0)} {}
  double value[4];
  double slope[4];
};

struct Spot {
  int column = 0, row = 0;  // of the cell to the south-west, relative to the field's
  double x = 0.0, y = 0.0;  // beyond it, in cells, [0, 1)
};

double Read(const CellRect& cells, std::span<const float> values, int column, int row) {
  if (column < 0 || row < 0 || column >= cells.columns || row >= cells.rows) {
    return 0.0;
  }
  return values[static_cast<std::size_t>(row) * cells.columns + column];
}

// The 4 x 4 values around a spot, row by row.
struct Neighbours {
  Neighbours(const CellRect& cells, std::span<const float> values, const Spot& spot) : at{} {
    Add(cells, values, spot);
  }
  void Add(const CellRect& cells, std::span<const float> values, const Spot& spot) {
    const int west = spot.column - 1, south = spot.row - 1;
    if (west >= 0 && south >= 0 && west + 4 <= cells.columns && south + 4 <= cells.rows) {
      const float* row = values.data() + static_cast<std::size_t>(south) * cells.columns + west;
      for (int j = 0; j < 4; ++j, row += cells.columns) {
        for (int i = 0; i < 4; ++i) at[j][i] += double{row[i]};
      }
      return;
    }
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) at[j][i] += Read(cells, values, west + i, south + j);
    }
  }
  double at[4][4];
};

double Along(const double (&weight)[4], const double (&value)[4]) {
  return ((weight[0] * value[0] + weight[1] * value[1]) + weight[2] * value[2]) +
         weight[3] * value[3];
}

// South to north first: four columns side by side are one vector.
void Across(const double (&weight)[4], const Neighbours& cells, double (&columns)[4]) {
  for (int i = 0; i < 4; ++i) {
    columns[i] =
        ((weight[0] * cells.at[0][i] + weight[1] * cells.at[1][i]) + weight[2] * cells.at[2][i]) +
        weight[3] * cells.at[3][i];
  }
}

double Value(const Neighbours& cells, const Weights& x, const Weights& y) {
  double columns[4];
  Across(y.value, cells, columns);
  return Along(x.value, columns);
}

// Per cell.
Vec2d Slope(const Neighbours& cells, const Weights& x, const Weights& y) {
  double columns[4], slopes[4];
  Across(y.value, cells, columns);
  Across(y.slope, cells, slopes);
  return {Along(x.slope, columns), Along(x.value, slopes)};
}

double Bilinear(const CellRect& cells, std::span<const float> values, const Spot& spot) {
  double at[2][2];
  const bool inside = spot.column >= 0 && spot.row >= 0 && spot.column + 1 < cells.columns &&
                      spot.row + 1 < cells.rows;
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      at[j][i] =
          inside ? values[static_cast<std::size_t>(spot.row + j) * cells.columns + spot.column + i]
                 : Read(cells, values, spot.column + i, spot.row + j);
    }
  }
  const double south = at[0][0] + spot.x * (at[0][1] - at[0][0]);
  const double north = at[1][0] + spot.x * (at[1][1] - at[1][0]);
  return south + spot.y * (north - south);
}

// False beyond the field's reach; written so that NaN is.
bool Locate(const CellRect& cells, Vec2d place, Spot& spot) {
  const double u = place.x / cells.cell_m - static_cast<double>(cells.west);
  const double v = place.y / cells.cell_m - static_cast<double>(cells.south);
  if (!(u > -2.0 && v > -2.0 && u < cells.columns + 1 && v < cells.rows + 1)) {
    return false;
  }
  const double column = std::floor(u), row = std::floor(v);
  spot = {static_cast<int>(column), static_cast<int>(row), u - column, v - row};
  return true;
}

void Prefetch(const CellRect& cells, std::span<const float> height_m, std::span<const float> more_m,
              const InteractionFlow* flow, const Spot& spot) {
  const int column = std::clamp(spot.column, 0, cells.columns - 1);
  const auto at = [&](int row) {
    return static_cast<std::size_t>(std::clamp(row, 0, cells.rows - 1)) * cells.columns + column;
  };
  for (int row = spot.row - 1; row < spot.row + 3; ++row) {
    hwy::Prefetch(height_m.data() + at(row));
    if (!more_m.empty()) hwy::Prefetch(more_m.data() + at(row));
  }
  if (flow == nullptr) return;
  for (int row = spot.row; row < spot.row + 2; ++row) {
    hwy::Prefetch(flow->x.data() + at(row));
    hwy::Prefetch(flow->y.data() + at(row));
  }
}

}  // namespace

InteractionSample SampleInteraction(const InteractionField& field, Vec2d place) {
  InteractionSample sample;
  Spot spot;
  if (!Locate(field.cells, place, spot)) return sample;
  const Weights x(spot.x), y(spot.y);
  const Neighbours heights(field.cells, field.height_m, spot);
  sample.height_m = Value(heights, x, y);
  sample.slope = (1.0 / field.cells.cell_m) * Slope(heights, x, y);
  if (field.flow != nullptr) {
    sample.velocity = {Value(Neighbours(field.cells, field.flow->x, spot), x, y),
                       Value(Neighbours(field.cells, field.flow->y, spot), x, y),
                       Value(Neighbours(field.cells, field.flow->z, spot), x, y)};
  }
  if (field.foam != nullptr) sample.foam = Bilinear(field.cells, *field.foam, spot);
  return sample;
}

void InteractionHeights(const InteractionSnapshot& snapshot, std::span<const Vec2d> places,
                        std::span<double> height_m) {
  ONESEA_CHECK(places.size() == height_m.size());
  std::fill(height_m.begin(), height_m.end(), 0.0);
  for (const auto& field : snapshot.fields) {
    for (std::size_t n = 0; n < places.size(); ++n) {
      Spot spot;
      if (!Locate(field->cells, places[n], spot)) continue;
      height_m[n] +=
          Value(Neighbours(field->cells, field->height_m, spot), Weights(spot.x), Weights(spot.y));
    }
  }
}

void AddFelt(const CellRect& cells, std::span<const float> height_m, std::span<const float> more_m,
             const InteractionFlow* flow, std::span<const Vec2d> places,
             std::span<InteractionFelt> sum) {
  ONESEA_CHECK(height_m.size() == cells.cells() && places.size() == sum.size());
  ONESEA_CHECK(more_m.empty() || more_m.size() == cells.cells());
  // Most places are far off; this is one cell more than Locate()'s reach.
  const Vec2d low = cells.PlaceOf(cells.west - 3, cells.south - 3);
  const Vec2d high = cells.PlaceOf(cells.east() + 2, cells.north() + 2);
  constexpr std::size_t kBlock = 64;
  std::array<std::size_t, kBlock> index;
  std::array<Spot, kBlock> spots;
  for (std::size_t first = 0; first < places.size(); first += kBlock) {
    // The cells are all over the memory: ask for those of a block before any is read.
    std::size_t count = 0;
    for (std::size_t n = first; n < std::min(first + kBlock, places.size()); ++n) {
      const Vec2d place = places[n];
      if (!(place.x > low.x && place.x < high.x && place.y > low.y && place.y < high.y)) continue;
      if (!Locate(cells, place, spots[count])) continue;
      Prefetch(cells, height_m, more_m, flow, spots[count]);
      index[count++] = n;
    }
    for (std::size_t n = 0; n < count; ++n) {
      const Spot& spot = spots[n];
      InteractionFelt& felt = sum[index[n]];
      Neighbours heights(cells, height_m, spot);
      if (!more_m.empty()) heights.Add(cells, more_m, spot);
      felt.height_m += Value(heights, Weights(spot.x), Weights(spot.y));
      if (flow == nullptr) continue;
      felt.velocity_m_per_s = felt.velocity_m_per_s +
                              Vec2d{Bilinear(cells, flow->x, spot), Bilinear(cells, flow->y, spot)};
    }
  }
}

InteractionSample SampleInteraction(const InteractionSnapshot& snapshot, Vec2d place) {
  InteractionSample sum;
  for (const auto& field : snapshot.fields) {
    const InteractionSample sample = SampleInteraction(*field, place);
    sum.height_m += sample.height_m;
    sum.slope = sum.slope + sample.slope;
    sum.velocity = sum.velocity + sample.velocity;
    sum.foam += sample.foam;
  }
  sum.foam = std::min(sum.foam, 1.0);
  return sum;
}

Vec3d Tilted(Vec3d normal, Vec2d slope) {
  const double up = std::max(normal.z, 1e-3);
  const double x = normal.x / up - slope.x, y = normal.y / up - slope.y;
  const double scale = 1.0 / std::sqrt(x * x + y * y + 1.0);
  return {scale * x, scale * y, scale};
}

}  // namespace onesea::sea
