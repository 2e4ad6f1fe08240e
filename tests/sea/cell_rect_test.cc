#include "common/sea/cell_rect.h"

#include <gtest/gtest.h>

namespace onesea::sea {
namespace {

TEST(CellRect, IntersectionIsWhatBothContain) {
  const CellRect a{.west = -3, .south = -2, .columns = 7, .rows = 5};
  const CellRect b{.west = 1, .south = -9, .columns = 20, .rows = 9};
  const CellRect both = Intersection(a, b);
  std::size_t count = 0;
  for (std::int64_t j = -12; j < 12; ++j) {
    for (std::int64_t i = -12; i < 30; ++i) {
      const bool expected = a.Contains(i, j) && b.Contains(i, j);
      EXPECT_EQ(both.Contains(i, j), expected) << i << " " << j;
      count += expected ? 1 : 0;
    }
  }
  EXPECT_EQ(both.cells(), count);
}

TEST(CellRect, IntersectionOfStrangersIsEmpty) {
  const CellRect a{.west = 0, .south = 0, .columns = 4, .rows = 4};
  EXPECT_EQ(Intersection(a, {.west = 4, .south = 0, .columns = 4, .rows = 4}).cells(), 0u);
}

TEST(CellRect, BoundingRectHoldsBoth) {
  const CellRect a{.west = 0, .south = 0, .columns = 4, .rows = 4};
  const CellRect b{.west = 10, .south = -6, .columns = 2, .rows = 3};
  EXPECT_EQ(BoundingRect(a, b), (CellRect{.west = 0, .south = -6, .columns = 12, .rows = 10}));
}

TEST(CellRect, CellsHavePlacesInTheWorld) {
  const CellRect rect{.west = -4, .south = 8, .columns = 2, .rows = 2, .cell_m = 0.25};
  EXPECT_EQ(rect.PlaceOf(-4, 9), (Vec2d{-1.0, 2.25}));
}

}  // namespace
}  // namespace onesea::sea
