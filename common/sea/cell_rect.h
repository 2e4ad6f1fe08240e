#pragma once

#include <cstddef>
#include <cstdint>

#include "common/base/hash.h"
#include "common/base/vec.h"

/// Where the cells of the interaction layer lie.
namespace onesea::sea {

/// A rectangle of the world lattice of side `cell_m`. Cell (i, j) is a sample at
/// (i cell_m, j cell_m): integers, so every region, process and tile agrees where a cell is.
/// Fields over a rectangle are row-major: element [(j - south) * columns + (i - west)].
struct CellRect {
  std::int64_t west = 0;   ///< i of the first column
  std::int64_t south = 0;  ///< j of the first row
  int columns = 0;
  int rows = 0;
  double cell_m = 0.5;
  friend bool operator==(const CellRect&, const CellRect&) = default;

  std::size_t cells() const { return static_cast<std::size_t>(columns) * rows; }
  std::int64_t east() const { return west + columns; }  ///< one past the last column
  std::int64_t north() const { return south + rows; }   ///< one past the last row
  Vec2d PlaceOf(std::int64_t i, std::int64_t j) const {
    return {static_cast<double>(i) * cell_m, static_cast<double>(j) * cell_m};
  }
  std::size_t IndexOf(std::int64_t i, std::int64_t j) const {
    return static_cast<std::size_t>((j - south) * columns + (i - west));
  }
  /// Of the element `index` of a field.
  Vec2d PlaceOfIndex(std::size_t index) const {
    const auto n = static_cast<std::int64_t>(index);
    return PlaceOf(west + n % columns, south + n / columns);
  }
  bool Contains(std::int64_t i, std::int64_t j) const {
    return i >= west && i < east() && j >= south && j < north();
  }
  void AddTo(Hash64& hash) const {
    for (const std::int64_t value : {west, south, std::int64_t{columns}, std::int64_t{rows}}) {
      hash.Add(value);
    }
    hash.Add(cell_m);
  }
};

/// The cells of both; zero columns and rows if they do not touch. Pre: the same cell_m.
CellRect Intersection(const CellRect& a, const CellRect& b);
/// The smallest rectangle around both. Pre: the same cell_m, neither empty.
CellRect BoundingRect(const CellRect& a, const CellRect& b);

}  // namespace onesea::sea
