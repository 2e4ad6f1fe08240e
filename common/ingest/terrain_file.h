#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "common/base/vec.h"
#include "common/sea/terrain.h"

/// Bathymetry and land from files: ESRI ASCII grids and lists of points.
///
///   ESRI ASCII   header ncols, nrows, xllcorner or xllcenter, yllcorner or yllcenter, cellsize (or
///                dx and dy), NODATA_value (optional), in any order and case; then nrows x ncols
///                numbers, the northern row first
///   XYZ          x y z a line, blanks, tabs, commas or semicolons between, # starts a comment;
///                any order, on a regular grid that needn't be full
///
/// Either may be packed with gzip.
namespace onesea::ingest {

struct TerrainOptions {
  /// The session's origin in the file's coordinates: metres, or degrees (longitude, latitude).
  Vec2d origin = {};
  /// Coordinates are degrees. Metres are those of WGS 84's ellipsoid along the meridian and the
  /// parallel through the origin: within 0.1 % for 10 km around it at latitudes below 60°.
  bool degrees = false;
  /// z is the depth below the mean level, positive down.
  bool depth_positive = false;
  /// What samples become that the file leaves out: land.
  double missing_elevation_m = 10.0;
};

/// `name` is used in errors only. InvalidArgument "name:line: field: problem", or naming the limit.
/// Grids whose cells are not square are sampled again, bilinearly, with the shorter side.
absl::StatusOr<sea::Terrain> ParseTerrain(absl::string_view name, absl::string_view bytes,
                                          const TerrainOptions& options);

/// Also NotFound and Unavailable, see ReadFileBytes().
absl::StatusOr<sea::Terrain> ReadTerrainFile(const std::string& path,
                                             const TerrainOptions& options);

}  // namespace onesea::ingest
