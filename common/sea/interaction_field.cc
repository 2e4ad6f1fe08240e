#include "common/sea/interaction_field.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"

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
  Neighbours(const CellRect& cells, std::span<const float> values, const Spot& spot) {
    const int west = spot.column - 1, south = spot.row - 1;
    const bool inside =
        west >= 0 && south >= 0 && west + 4 <= cells.columns && south + 4 <= cells.rows;
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) {
        at[j][i] = inside ? values[static_cast<std::size_t>(south + j) * cells.columns + west + i]
                          : Read(cells, values, west + i, south + j);
      }
    }
  }
  void Add(const Neighbours& other) {
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) at[j][i] += other.at[j][i];
    }
  }
  double at[4][4];
};

double Along(const double (&weight)[4], const double (&value)[4]) {
  return ((weight[0] * value[0] + weight[1] * value[1]) + weight[2] * value[2]) +
         weight[3] * value[3];
}

double Value(const Neighbours& cells, const Weights& x, const Weights& y) {
  double rows[4];
  for (int j = 0; j < 4; ++j) rows[j] = Along(x.value, cells.at[j]);
  return Along(y.value, rows);
}

// Per cell.
Vec2d Slope(const Neighbours& cells, const Weights& x, const Weights& y) {
  double rows[4], slopes[4];
  for (int j = 0; j < 4; ++j) {
    rows[j] = Along(x.value, cells.at[j]);
    slopes[j] = Along(x.slope, cells.at[j]);
  }
  return {Along(y.value, slopes), Along(y.slope, rows)};
}

double Bilinear(const CellRect& cells, std::span<const float> values, const Spot& spot) {
  const auto along = [&](int row) {
    const double west = Read(cells, values, spot.column, row);
    return west + spot.x * (Read(cells, values, spot.column + 1, row) - west);
  };
  const double south = along(spot.row);
  return south + spot.y * (along(spot.row + 1) - south);
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

}  // namespace

InteractionSample SampleInteraction(const InteractionField& field, Vec2d place) {
  InteractionSample sample;
  Spot spot;
  if (!Locate(field.cells, place, spot)) return sample;
  const Weights x(spot.x), y(spot.y);
  const Neighbours heights(field.cells, field.height_m, spot);
  sample.height_m = Value(heights, x, y);
  sample.slope = (1.0 / field.cells.cell_m) * Slope(heights, x, y);
  if (!field.velocity_x.empty()) {
    sample.velocity = {Value(Neighbours(field.cells, field.velocity_x, spot), x, y),
                       Value(Neighbours(field.cells, field.velocity_y, spot), x, y),
                       Value(Neighbours(field.cells, field.velocity_z, spot), x, y)};
  }
  if (!field.foam.empty()) sample.foam = Bilinear(field.cells, field.foam, spot);
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
             std::span<const float> velocity_x, std::span<const float> velocity_y,
             std::span<const Vec2d> places, std::span<InteractionFelt> sum) {
  ONESEA_CHECK(height_m.size() == cells.cells() && places.size() == sum.size());
  ONESEA_CHECK(more_m.empty() || more_m.size() == cells.cells());
  ONESEA_CHECK(velocity_x.size() == velocity_y.size());
  for (std::size_t n = 0; n < places.size(); ++n) {
    Spot spot;
    if (!Locate(cells, places[n], spot)) continue;
    Neighbours heights(cells, height_m, spot);
    if (!more_m.empty()) heights.Add(Neighbours(cells, more_m, spot));
    sum[n].height_m += Value(heights, Weights(spot.x), Weights(spot.y));
    if (velocity_x.empty()) continue;
    sum[n].velocity_m_per_s = sum[n].velocity_m_per_s + Vec2d{Bilinear(cells, velocity_x, spot),
                                                              Bilinear(cells, velocity_y, spot)};
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
