#include "common/ingest/terrain_file.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "absl/strings/str_cat.h"
#include "common/base/limits.h"
#include "common/base/range_check.h"
#include "common/base/real_math.h"
#include "common/ingest/esri_ascii.h"
#include "common/ingest/file_bytes.h"
#include "common/ingest/raw_grid.h"
#include "common/ingest/text_lines.h"
#include "common/ingest/xyz_points.h"
#include "common/sea/constants.h"

namespace onesea::ingest {
namespace {

// WGS 84.
constexpr double kEquatorRadiusM = 6'378'137.0;
constexpr double kEccentricitySquared = 6.694379990141317e-3;
constexpr double kLatitudeMaxDeg = 85.0;

struct MetresPerUnit {
  double x = 1.0;
  double y = 1.0;
};

// Of a degree, along the parallel and the meridian through the origin.
MetresPerUnit PerDegree(double latitude_deg) {
  const double radians_per_degree = sea::kPi / 180.0;
  const real::SinCosPair latitude = real::SinCos(latitude_deg * radians_per_degree);
  const double w = 1.0 - kEccentricitySquared * latitude.sin * latitude.sin;
  const double across_m = kEquatorRadiusM / std::sqrt(w);
  return {across_m * latitude.cos * radians_per_degree,
          across_m * (1.0 - kEccentricitySquared) / w * radians_per_degree};
}

absl::Status CheckOptions(const TerrainOptions& options) {
  const double x_max = options.degrees ? 360.0 : 1.0e9;
  const double y_max = options.degrees ? kLatitudeMaxDeg : 1.0e9;
  if (absl::Status s = CheckInRange("terrain.origin.x", options.origin.x, -x_max, x_max); !s.ok()) {
    return s;
  }
  if (absl::Status s = CheckInRange("terrain.origin.y", options.origin.y, -y_max, y_max); !s.ok()) {
    return s;
  }
  return CheckInRange("terrain.missing_elevation_m", options.missing_elevation_m, -kDepthMaxM,
                      kDepthMaxM);
}

// Samples with the step `cell` along both axes; `width` and `height` in the same unit are the
// extent of the given ones.
absl::Status Resample(absl::string_view name, double dx_m, double dy_m, sea::Terrain& terrain) {
  const double cell_m = std::min(dx_m, dy_m);
  const double columns = std::floor((terrain.columns - 1) * dx_m / cell_m + 1e-6) + 1;
  const double rows = std::floor((terrain.rows - 1) * dy_m / cell_m + 1e-6) + 1;
  if (!(columns <= kTerrainSideMax && rows <= kTerrainSideMax)) {
    return FileError(name, 0, "cellsize",
                     absl::StrCat("square cells of ", cell_m, " m would be ", columns, " x ", rows,
                                  "; the limit is ", kTerrainSideMax));
  }
  sea::Terrain square = terrain;
  square.cell_m = cell_m;
  square.columns = static_cast<int>(columns);
  square.rows = static_cast<int>(rows);
  square.elevation_m.clear();
  // In the given grid's cells.
  terrain.west_m = terrain.south_m = 0.0;
  terrain.cell_m = 1.0;
  for (int j = 0; j < square.rows; ++j) {
    for (int i = 0; i < square.columns; ++i) {
      square.elevation_m.push_back(
          static_cast<float>(terrain.ElevationAt({i * cell_m / dx_m, j * cell_m / dy_m})));
    }
  }
  terrain = std::move(square);
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<sea::Terrain> ParseTerrain(absl::string_view name, absl::string_view bytes,
                                          const TerrainOptions& options) {
  if (absl::Status s = CheckOptions(options); !s.ok()) return s;
  std::string unpacked;
  if (IsGzip(bytes)) {
    absl::StatusOr<std::string> inflated = InflateGzip(name, bytes);
    if (!inflated.ok()) return inflated.status();
    unpacked = *std::move(inflated);
    bytes = unpacked;
  }
  absl::StatusOr<RawGrid> grid =
      LooksLikeEsriAscii(bytes) ? ParseEsriAscii(name, bytes) : ParseXyz(name, bytes);
  if (!grid.ok()) return grid.status();
  const MetresPerUnit unit = options.degrees ? PerDegree(options.origin.y) : MetresPerUnit{};
  sea::Terrain terrain;
  terrain.west_m = (grid->x0 - options.origin.x) * unit.x;
  terrain.south_m = (grid->y0 - options.origin.y) * unit.y;
  terrain.columns = grid->columns;
  terrain.rows = grid->rows;
  terrain.elevation_m = std::move(grid->value);
  for (float& sample : terrain.elevation_m) {
    if (std::isnan(sample)) {
      sample = static_cast<float>(options.missing_elevation_m);
    } else if (options.depth_positive) {
      sample = 0.0f - sample;
    }
  }
  const double dx_m = grid->dx * unit.x, dy_m = grid->dy * unit.y;
  for (const double cell_m : {dx_m, dy_m}) {
    if (absl::Status s = CheckInRange("terrain.cell_m", cell_m, kTerrainCellMinM, kTerrainCellMaxM);
        !s.ok()) {
      return FileError(name, 0, "cellsize", s.message());
    }
  }
  // Square to a millionth of the whole side: no sample is off by more than that.
  terrain.cell_m = dx_m;
  const int side = std::max(terrain.columns, terrain.rows);
  if (std::abs(dx_m - dy_m) * side > 1e-3 * std::min(dx_m, dy_m)) {
    if (absl::Status s = Resample(name, dx_m, dy_m, terrain); !s.ok()) return s;
  }
  if (absl::Status s = sea::ValidateTerrain(terrain); !s.ok()) {
    return FileError(name, 0, "terrain", s.message());
  }
  return terrain;
}

absl::StatusOr<sea::Terrain> ReadTerrainFile(const std::string& path,
                                             const TerrainOptions& options) {
  const absl::StatusOr<std::string> bytes = ReadFileBytes(path);
  if (!bytes.ok()) return bytes.status();
  return ParseTerrain(path, *bytes, options);
}

}  // namespace onesea::ingest
