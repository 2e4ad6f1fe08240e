#include "server/world/region_layout.h"

#include <gtest/gtest.h>

#include <limits>

#include "common/base/limits.h"

namespace onesea::world {
namespace {

RegionAsk Ask(std::uint64_t id, double x_m, double y_m, int side = 128) {
  return {.id = id, .columns = side, .rows = side, .centre_m = {x_m, y_m}};
}

TEST(RegionLayout, RegionsMoveInWholeTilesAndNotForEveryStep) {
  std::vector<PlacedAsk> placed;
  int moves = 0;
  for (double x = 0.0; x < 200.0; x += 0.1) {
    const auto before = placed;
    placed = SnapAsks(std::vector{Ask(1, x, -x / 3.0)}, before);
    const sea::CellRect& cells = placed[0].cells;
    ASSERT_EQ(cells.west % kRegionSideStep, 0);
    ASSERT_EQ(cells.south % kRegionSideStep, 0);
    const double off = x / 0.5 - (static_cast<double>(cells.west) + 64.0);
    ASSERT_LE(std::abs(off), kStayCells);
    if (!before.empty() && !(before[0].cells == cells)) ++moves;
  }
  EXPECT_GE(moves, 12);  // 400 cells of 32 each way and 133 across
  EXPECT_LE(moves, 20);
  // To and fro over the boundary of a tile: no move.
  const auto still = SnapAsks(std::vector{Ask(1, 8.1, 0)}, {});
  EXPECT_EQ(SnapAsks(std::vector{Ask(1, 7.9, 0)}, still)[0].cells, still[0].cells);
}

TEST(RegionLayout, OverlapsMergeWhereThatIsCheap) {
  const auto layout = [](std::vector<RegionAsk> asks) { return LayOut(SnapAsks(asks, {})); };
  EXPECT_EQ(layout({Ask(1, 0, 0), Ask(2, 16, 0)}).size(), 1u);   // 1.0 of what they cover
  EXPECT_EQ(layout({Ask(1, 0, 0), Ask(2, 48, 48)}).size(), 2u);  // 3.06 / 1.94
  EXPECT_EQ(layout({Ask(1, 0, 0), Ask(2, 200, 0)}).size(), 2u);  // apart
  EXPECT_EQ(layout({Ask(1, 0, 0), Ask(2, 80, 0), Ask(3, 40, 0)}).size(), 1u);  // 3 joins both
  RegionAsk other = Ask(2, 16, 0);
  other.kind = SolverKind::kWaveEquation;
  EXPECT_EQ(layout({Ask(1, 0, 0), other}).size(), 2u);
  other = Ask(2, 16, 0);
  other.cell_m = 0.25;
  EXPECT_EQ(layout({Ask(1, 0, 0), other}).size(), 2u);
  // A row of boats longer than the greatest region.
  std::vector<RegionAsk> row;
  for (std::uint64_t n = 0; n < 20; ++n) row.push_back(Ask(n, 48.0 * static_cast<double>(n), 0));
  for (const Region& region : layout(row)) EXPECT_LE(region.cells.columns, kRegionSideMax);
  std::vector<RegionAsk> many;
  for (std::uint64_t n = 0; n < 40; ++n) many.push_back(Ask(n, 200.0 * static_cast<double>(n), 0));
  EXPECT_EQ(layout(many).size(), static_cast<std::size_t>(kRegionsMax));
}

TEST(RegionLayout, RefusesNonsenseByName) {
  const auto refused = [](auto change, const char* field) {
    RegionAsk ask = Ask(1, 0, 0);
    change(ask);
    return std::string(ValidateRegionAsk(ask).message()).find(field) != std::string::npos;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(ValidateRegionAsk(Ask(1, 0, 0)).ok());
  EXPECT_TRUE(refused([](RegionAsk& a) { a.kind = SolverKind{9}; }, "region.kind"));
  EXPECT_TRUE(refused([&](RegionAsk& a) { a.cell_m = nan; }, "region.cell_m"));
  EXPECT_TRUE(refused([](RegionAsk& a) { a.columns = 5000; }, "region.columns"));
  EXPECT_TRUE(refused([&](RegionAsk& a) { a.centre_m.y = nan; }, "region.centre.y"));
}

}  // namespace
}  // namespace onesea::world
