#include "common/sea/cell_rect.h"

#include <algorithm>

#include "common/base/check.h"

namespace onesea::sea {
namespace {

CellRect Between(std::int64_t west, std::int64_t south, std::int64_t east, std::int64_t north,
                 double cell_m) {
  if (east <= west || north <= south) return {.west = west, .south = south, .cell_m = cell_m};
  return {.west = west,
          .south = south,
          .columns = static_cast<int>(east - west),
          .rows = static_cast<int>(north - south),
          .cell_m = cell_m};
}

}  // namespace

CellRect Intersection(const CellRect& a, const CellRect& b) {
  ONESEA_CHECK(a.cell_m == b.cell_m);
  return Between(std::max(a.west, b.west), std::max(a.south, b.south), std::min(a.east(), b.east()),
                 std::min(a.north(), b.north()), a.cell_m);
}

CellRect BoundingRect(const CellRect& a, const CellRect& b) {
  ONESEA_CHECK(a.cell_m == b.cell_m && a.cells() > 0 && b.cells() > 0);
  return Between(std::min(a.west, b.west), std::min(a.south, b.south), std::max(a.east(), b.east()),
                 std::max(a.north(), b.north()), a.cell_m);
}

}  // namespace onesea::sea
