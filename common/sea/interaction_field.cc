#include "common/sea/interaction_field.h"

#include <algorithm>
#include <cmath>

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
  int column, row;  // of the cell to the south-west, relative to the field's
  double x, y;      // beyond it, in cells, [0, 1)
};

double Read(const InteractionField& field, std::span<const float> values, int column, int row) {
  if (column < 0 || row < 0 || column >= field.cells.columns || row >= field.cells.rows) {
    return 0.0;
  }
  return values[static_cast<std::size_t>(row) * field.cells.columns + column];
}

struct Smooth {
  double value = 0.0, along_x = 0.0, along_y = 0.0;  // along: per cell
};

Smooth Interpolate(const InteractionField& field, std::span<const float> values, const Spot& spot,
                   const Weights& x, const Weights& y) {
  Smooth sum;
  for (int j = 0; j < 4; ++j) {
    double value = 0.0, slope = 0.0;
    for (int i = 0; i < 4; ++i) {
      const double read = Read(field, values, spot.column + i - 1, spot.row + j - 1);
      value += x.value[i] * read;
      slope += x.slope[i] * read;
    }
    sum.value += y.value[j] * value;
    sum.along_x += y.value[j] * slope;
    sum.along_y += y.slope[j] * value;
  }
  return sum;
}

double Bilinear(const InteractionField& field, std::span<const float> values, const Spot& spot) {
  const auto along = [&](int row) {
    const double west = Read(field, values, spot.column, row);
    return west + spot.x * (Read(field, values, spot.column + 1, row) - west);
  };
  const double south = along(spot.row);
  return south + spot.y * (along(spot.row + 1) - south);
}

}  // namespace

InteractionSample SampleInteraction(const InteractionField& field, Vec2d place) {
  InteractionSample sample;
  const double u = place.x / field.cells.cell_m - static_cast<double>(field.cells.west);
  const double v = place.y / field.cells.cell_m - static_cast<double>(field.cells.south);
  // Written so that NaN is outside.
  if (!(u > -2.0 && v > -2.0 && u < field.cells.columns + 1 && v < field.cells.rows + 1)) {
    return sample;
  }
  const double column = std::floor(u), row = std::floor(v);
  const Spot spot{static_cast<int>(column), static_cast<int>(row), u - column, v - row};
  const Weights x(spot.x), y(spot.y);
  const Smooth height = Interpolate(field, field.height_m, spot, x, y);
  sample.height_m = height.value;
  sample.slope = {height.along_x / field.cells.cell_m, height.along_y / field.cells.cell_m};
  if (!field.velocity_x.empty()) {
    sample.velocity = {Interpolate(field, field.velocity_x, spot, x, y).value,
                       Interpolate(field, field.velocity_y, spot, x, y).value,
                       Interpolate(field, field.velocity_z, spot, x, y).value};
  }
  if (!field.foam.empty()) sample.foam = Bilinear(field, field.foam, spot);
  return sample;
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

}  // namespace onesea::sea
