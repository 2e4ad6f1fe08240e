#include "common/ingest/xyz_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "absl/strings/str_cat.h"
#include "common/base/limits.h"
#include "common/ingest/text_lines.h"

namespace onesea::ingest {
namespace {

struct Points {
  std::vector<double> x, y;
  std::vector<float> z;
  std::vector<int> line;
};

struct Axis {
  double first = 0.0;
  double step = 0.0;
  int count = 0;

  int Index(double at) const { return static_cast<int>(std::lround((at - first) / step)); }
  bool Holds(double at) const {
    const double cell = (at - first) / step;
    return std::abs(cell - std::round(cell)) <= 0.1;
  }
};

absl::StatusOr<Points> ReadPoints(TextLines& lines) {
  Points points;
  std::string plain;
  while (lines.NextNotBlank()) {
    plain = std::string(lines.line().substr(0, lines.line().find('#')));
    std::replace_if(
        plain.begin(), plain.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
    absl::string_view rest = plain;
    double number[3];
    absl::string_view field = TakeField(rest);
    if (field.empty()) continue;
    for (int n = 0; n < 3; ++n) {
      static constexpr const char* kNames[] = {"x", "y", "z"};
      const std::optional<double> value = ParseReal(field);
      if (!value.has_value()) return lines.Bad(kNames[n], field, "a number");
      number[n] = *value;
      field = TakeField(rest);
    }
    if (!field.empty()) return lines.Bad("point", lines.line(), "x y z alone");
    if (!(std::abs(number[2]) <= kDepthMaxM)) {
      return lines.Error("z", absl::StrCat(number[2], " is beyond ±", kDepthMaxM, " m"));
    }
    points.x.push_back(number[0]);
    points.y.push_back(number[1]);
    points.z.push_back(static_cast<float>(number[2]));
    points.line.push_back(lines.number());
  }
  return points;
}

// Numbers that lie closer than a quarter of the widest gap are one line of the grid.
absl::StatusOr<Axis> FindAxis(TextLines& lines, absl::string_view field,
                              std::vector<double> numbers) {
  std::sort(numbers.begin(), numbers.end());
  double widest = 0.0;
  for (std::size_t n = 1; n < numbers.size(); ++n) {
    widest = std::max(widest, numbers[n] - numbers[n - 1]);
  }
  int count = 1;
  for (std::size_t n = 1; n < numbers.size(); ++n) {
    if (numbers[n] - numbers[n - 1] > 0.25 * widest && ++count > kTerrainSideMax) break;
  }
  const double extent = numbers.empty() ? 0.0 : numbers.back() - numbers.front();
  if (count < 2 || count > kTerrainSideMax || !std::isfinite(extent)) {
    return FileError(lines.name(), 0, field,
                     absl::StrCat(count > kTerrainSideMax ? "more than " : "", count,
                                  " lines of a grid; from 2 to ", kTerrainSideMax, " are wanted"));
  }
  return Axis{.first = numbers.front(), .step = extent / (count - 1), .count = count};
}

}  // namespace

absl::StatusOr<RawGrid> ParseXyz(absl::string_view name, absl::string_view text) {
  TextLines lines(name, text);
  const absl::StatusOr<Points> points = ReadPoints(lines);
  if (!points.ok()) return points.status();
  const absl::StatusOr<Axis> x = FindAxis(lines, "x", points->x);
  if (!x.ok()) return x.status();
  const absl::StatusOr<Axis> y = FindAxis(lines, "y", points->y);
  if (!y.ok()) return y.status();
  RawGrid grid = {.x0 = x->first,
                  .y0 = y->first,
                  .dx = x->step,
                  .dy = y->step,
                  .columns = x->count,
                  .rows = y->count,
                  .value = {}};
  const std::size_t cells = static_cast<std::size_t>(grid.columns) * grid.rows;
  // Scattered points would make a huge grid of holes.
  if (points->z.size() < cells / 4) {
    return FileError(name, 0, "points",
                     absl::StrCat(points->z.size(), " points don't fill a quarter of the ",
                                  grid.columns, " x ", grid.rows, " grid they span"));
  }
  grid.value.assign(cells, std::numeric_limits<float>::quiet_NaN());
  for (std::size_t n = 0; n < points->z.size(); ++n) {
    if (!x->Holds(points->x[n]) || !y->Holds(points->y[n])) {
      return FileError(name, points->line[n], "point", "not on a regular grid");
    }
    float& sample = grid.value[static_cast<std::size_t>(y->Index(points->y[n])) * grid.columns +
                               x->Index(points->x[n])];
    if (!std::isnan(sample)) return FileError(name, points->line[n], "point", "given twice");
    sample = points->z[n];
  }
  return grid;
}

}  // namespace onesea::ingest
