#include "common/sea/terrain.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "common/base/hash.h"
#include "common/base/limits.h"
#include "common/base/range_check.h"
#include "common/sea/grid_place.h"

namespace onesea::sea {
double Terrain::ElevationAt(Vec2d place) const {
  const GridPlace x = LocateOnGrid((place.x - west_m) / cell_m, columns);
  const GridPlace y = LocateOnGrid((place.y - south_m) / cell_m, rows);
  const float* south_west = &elevation_m[static_cast<std::size_t>(y.cell) * columns + x.cell];
  const double south = south_west[0] + x.fraction * (south_west[1] - south_west[0]);
  const double north =
      south_west[columns] + x.fraction * (south_west[columns + 1] - south_west[columns]);
  return south + y.fraction * (north - south);
}

absl::Status ValidateTerrain(const Terrain& terrain) {
  for (const auto& [name, value] : {std::pair("terrain.west_m", terrain.west_m),
                                    std::pair("terrain.south_m", terrain.south_m)}) {
    if (absl::Status s = CheckInRange(name, value, -kQueryCoordinateMaxM, kQueryCoordinateMaxM);
        !s.ok()) {
      return s;
    }
  }
  if (absl::Status s =
          CheckInRange("terrain.cell_m", terrain.cell_m, kTerrainCellMinM, kTerrainCellMaxM);
      !s.ok()) {
    return s;
  }
  for (const auto& [name, value] :
       {std::pair("terrain.columns", terrain.columns), std::pair("terrain.rows", terrain.rows)}) {
    if (absl::Status s = CheckInRange(name, value, 2, kTerrainSideMax); !s.ok()) return s;
  }
  const std::size_t samples = static_cast<std::size_t>(terrain.columns) * terrain.rows;
  if (terrain.elevation_m.size() != samples) {
    return absl::InvalidArgumentError(absl::StrCat("terrain.elevation_m has ",
                                                   terrain.elevation_m.size(),
                                                   " values; columns x rows is ", samples));
  }
  for (std::size_t n = 0; n < samples; ++n) {
    if (!(std::abs(terrain.elevation_m[n]) <= kDepthMaxM)) {
      return absl::InvalidArgumentError(absl::StrCat("terrain.elevation_m[", n, "] is ",
                                                     terrain.elevation_m[n], "; the limit is ±",
                                                     kDepthMaxM));
    }
  }
  return absl::OkStatus();
}

std::uint64_t TerrainHash(const Terrain& terrain) {
  Hash64 hash;
  hash.Add(terrain.west_m);
  hash.Add(terrain.south_m);
  hash.Add(terrain.cell_m);
  hash.Add(terrain.columns);
  hash.Add(terrain.rows);
  for (const float elevation : terrain.elevation_m) hash.Add(elevation);
  return hash.value();
}

}  // namespace onesea::sea
