#include "common/ingest/grid_axes.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_format.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/ingest/direction.h"

namespace onesea::ingest {
namespace {

constexpr double kTurn = 2.0 * sea::kPi;

void SnapToEvenDivision(double rounding_rad, std::vector<double>& sorted_rad) {
  const std::size_t n = sorted_rad.size();
  const double step = kTurn / static_cast<double>(n);
  double offset = 0.0;
  for (std::size_t i = 0; i < n; ++i) offset += sorted_rad[i] - static_cast<double>(i) * step;
  offset /= static_cast<double>(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (!(std::abs(sorted_rad[i] - static_cast<double>(i) * step - offset) <= rounding_rad)) return;
  }
  for (std::size_t i = 0; i < n; ++i) {
    sorted_rad[i] = WrapToTurn(offset + static_cast<double>(i) * step);
  }
}

struct Column {
  double wave_to_rad = 0.0;
  int source = -1;
};

// The widest empty arc is a gap in the data if it is wider than one and a half of the others.
void CloseSector(std::vector<Column>& columns) {
  const std::size_t n = columns.size();
  std::size_t widest = 0;
  std::vector<double> arc_rad(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double next = i + 1 < n ? columns[i + 1].wave_to_rad : columns[0].wave_to_rad + kTurn;
    arc_rad[i] = next - columns[i].wave_to_rad;
    if (arc_rad[i] > arc_rad[widest]) widest = i;
  }
  const double step = n > 1 ? (kTurn - arc_rad[widest]) / static_cast<double>(n - 1) : kTurn;
  const double gap = arc_rad[widest];
  if (!(gap > 1.5 * step)) return;
  const double begin = columns[widest].wave_to_rad;
  const bool has_room_for_two = gap > 2.5 * step;
  columns.push_back({WrapToTurn(begin + (has_room_for_two ? step : 0.5 * gap)), -1});
  if (has_room_for_two) columns.push_back({WrapToTurn(begin + gap - step), -1});
}

bool Precedes(const Column& a, const Column& b) { return a.wave_to_rad < b.wave_to_rad; }

}  // namespace

absl::StatusOr<DirectionAxis> SortDirections(std::span<const double> wave_to_rad,
                                             double rounding_rad) {
  const std::size_t n = wave_to_rad.size();
  if (n < 2) return absl::InvalidArgumentError("at least 2 directions are needed");
  std::vector<Column> columns(n);
  for (std::size_t i = 0; i < n; ++i) {
    columns[i] = {WrapToTurn(wave_to_rad[i]), static_cast<int>(i)};
  }
  std::stable_sort(columns.begin(), columns.end(), Precedes);
  std::vector<double> sorted(n);
  for (std::size_t i = 0; i < n; ++i) sorted[i] = columns[i].wave_to_rad;
  SnapToEvenDivision(rounding_rad, sorted);
  for (std::size_t i = 0; i < n; ++i) columns[i].wave_to_rad = sorted[i];
  std::stable_sort(columns.begin(), columns.end(), Precedes);
  CloseSector(columns);
  std::stable_sort(columns.begin(), columns.end(), Precedes);
  if (columns.size() > static_cast<std::size_t>(kSpectrumDirectionsMax)) {
    return absl::InvalidArgumentError(
        absl::StrFormat("%d directions; the limit is %d", columns.size(), kSpectrumDirectionsMax));
  }
  DirectionAxis axis;
  axis.file_columns = static_cast<int>(n);
  for (const Column& column : columns) {
    const float direction = static_cast<float>(column.wave_to_rad);
    if (!axis.wave_to_rad.empty() && !(direction > axis.wave_to_rad.back())) {
      return absl::InvalidArgumentError(absl::StrFormat(
          "two directions are equal (%.2f degrees from)", NauticalFromWaveTo(direction)));
    }
    axis.wave_to_rad.push_back(direction);
    axis.source_column.push_back(column.source);
  }
  return axis;
}

void AppendGridRow(const DirectionAxis& axis, std::span<const float> density_m2_per_hz_rad,
                   sea::GridSpectrum& grid) {
  ONESEA_CHECK(density_m2_per_hz_rad.size() == static_cast<std::size_t>(axis.file_columns));
  for (const int source : axis.source_column) {
    grid.density_m2_per_hz_rad.push_back(
        source < 0 ? 0.0F : density_m2_per_hz_rad[static_cast<std::size_t>(source)]);
  }
}

}  // namespace onesea::ingest
