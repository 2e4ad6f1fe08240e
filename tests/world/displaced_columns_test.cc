#include "server/world/displaced_columns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "server/world/hull_shapes.h"

namespace onesea::world {
namespace {

constexpr sea::CellRect kCells{.west = -32, .south = -32, .columns = 64, .rows = 64, .cell_m = 0.5};

std::vector<float> Columns(const TriangleMesh& mesh, const Pose& pose,
                           const HeightPatch& surface = {}) {
  std::vector<float> head(kCells.cells());
  AddDisplacedColumns(mesh, {}, pose, surface, kCells, head);
  return head;
}

double Volume(const std::vector<float>& head) {
  return std::accumulate(head.begin(), head.end(), 0.0) * kCells.cell_m * kCells.cell_m;
}

TEST(DisplacedColumns, BoxGivesItsVolumeWhereverItLies) {
  const TriangleMesh box = BoxMesh({4.0, 2.0, 1.0});
  for (double x = 0.0; x < 1.0; x += 0.13) {
    for (double yaw = 0.0; yaw < 1.6; yaw += 0.4) {
      const Pose pose{{x, 0.3 * x, 0.1}, AboutAxis({0, 0, 1}, yaw)};
      EXPECT_NEAR(Volume(Columns(box, pose)), 4.0 * 2.0 * 0.4, 1e-5) << x << " " << yaw;
    }
  }
}

TEST(DisplacedColumns, DraftStandsInTheMiddleOfTheBox) {
  const std::vector<float> head = Columns(BoxMesh({8.0, 6.0, 1.0}), {{0, 0, 0.2}, {}});
  for (int i = 28; i <= 36; ++i) EXPECT_NEAR(head[32 * 64 + i], 0.3, 0.003) << i;
  EXPECT_EQ(head[32 * 64 + 50], 0.0f);
}

TEST(DisplacedColumns, SphereCap) {
  // A cap of height h holds pi h² (3R - h) / 3.
  const TriangleMesh sphere = SphereMesh(2.0, 48);
  for (const double h : {0.5, 2.0, 3.5}) {
    const double expected = std::numbers::pi * h * h * (6.0 - h) / 3.0;
    EXPECT_NEAR(Volume(Columns(sphere, {{0.1, 0, 2.0 - h}, {}})), expected, 0.01 * expected) << h;
  }
}

TEST(DisplacedColumns, FullyUnderAndFullyAbove) {
  const TriangleMesh box = BoxMesh({2.0, 2.0, 1.0});
  EXPECT_NEAR(Volume(Columns(box, {{0, 0, -5}, AboutAxis({1, 0, 0}, 0.7)})), 4.0, 1e-5);
  EXPECT_EQ(Volume(Columns(box, {{0, 0, 5}, {}})), 0.0);
}

TEST(DisplacedColumns, FollowsATiltedSurface) {
  HeightPatch tilted{.west_m = -4, .south_m = -4, .cell_m = 4, .columns = 3, .rows = 3};
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) tilted.height_m.push_back(static_cast<float>(0.1 * 4 * (i - 1)));
  }
  const std::vector<float> head = Columns(BoxMesh({4.0, 2.0, 2.0}), {{0, 0, 0}, {}}, tilted);
  EXPECT_NEAR(Volume(head), 4.0 * 2.0 * 1.0, 1e-5);  // the tilt takes as much as it gives
  EXPECT_NEAR(head[32 * 64 + 33], 1.0 + 0.05, 0.01);
}

TEST(DisplacedColumns, LeavesOutWhatLiesOutside) {
  EXPECT_EQ(Volume(Columns(BoxMesh({2, 2, 1}), {{500, 0, 0}, {}})), 0.0);
}

// A box of length L and draught T makes waves of wavenumber k along it as
//   ∫∫ cos kx exp(-kz) dx dz = L sin(kL/2)/(kL/2) (1 - exp(-kT))/k
TEST(DisplacedColumns, ShapesAtRestAreSeenThroughTheWater) {
  const double length_m = 3.0, draught_m = 1.0;
  const std::vector<LumpedColumn> columns =
      ColumnsAtRest(BoxMesh({length_m, 8.0, 2.0}, 8), {}, 1.0 - draught_m, 0.5);
  double volume_m3 = 0.0;
  for (const LumpedColumn& column : columns) volume_m3 += column.volume_m3;
  EXPECT_NEAR(volume_m3, length_m * 8.0 * draught_m, 1e-9);
  for (const double k : {0.5, 1.0, 1.5, 3.0}) {
    double waves = 0.0;
    for (const LumpedColumn& column : columns) waves += column.volume_m3 * std::cos(k * column.x_m);
    const double flat = std::sin(k * length_m / 2) / (k * length_m / 2);
    const double faded = (1.0 - std::exp(-k * draught_m)) / (k * draught_m);
    EXPECT_NEAR(waves / volume_m3, flat * faded, 0.14 * std::abs(flat)) << k;
    if (k < 1.0 || k > 2.0) continue;  // hardly faded, or beyond the first zero of the box
    EXPECT_LT(waves / volume_m3, 0.5 * (flat + flat * faded)) << k;
  }
}

}  // namespace
}  // namespace onesea::world
