// Ropes in the picture: how they hang, where they are seen, what hides them.
#include <cmath>
#include <vector>

#include "client/render/hanging_line.h"
#include "client/render/hull_painter.h"
#include "tests/render/gl_fixture.h"
#include "tests/render/test_sea.h"

namespace onesea::render {
namespace {

double LengthOf(const std::vector<Vec3d>& line) {
  double length = 0.0;
  for (std::size_t n = 1; n < line.size(); ++n) length += Norm(line[n] - line[n - 1]);
  return length;
}

std::vector<Vec3d> Line(Vec3d from, Vec3d to, double length_m, std::size_t points = 2001) {
  std::vector<Vec3d> line(points);
  HangingLine(from, to, length_m, line);
  return line;
}

// A chain of 2 a sinh(h / 2a) between two pegs of one height sags by a (cosh(h / 2a) - 1).
TEST(HangingLine, SagsAsACatenaryDoes) {
  const double h = 10.0;
  for (const double a : {1.5, 5.0, 40.0}) {
    const double length = 2.0 * a * std::sinh(h / (2.0 * a));
    const std::vector<Vec3d> line = Line({3, 4, 7}, {3 + 0.6 * h, 4 + 0.8 * h, 7}, length);
    const double sag = a * (std::cosh(h / (2.0 * a)) - 1.0);
    EXPECT_NEAR(line[1000].z, 7.0 - sag, 1e-6 * sag + 1e-9) << a;
    EXPECT_NEAR(line[1000].x, 3.0 + 0.3 * h, 1e-9);
    EXPECT_NEAR(LengthOf(line), length, 1e-5 * length);
  }
}

TEST(HangingLine, HasItsLengthAndItsEndsHoweverItHangs) {
  const Vec3d from{-2, 1, 3};
  for (const Vec3d way : {Vec3d{8, 0, 0}, Vec3d{1, 1, -6}, Vec3d{0, 0, 5}, Vec3d{1e-4, 0, -5},
                          Vec3d{0, 0, 0}, Vec3d{300, -200, 40}}) {
    for (const double more : {1.0001, 1.05, 2.0, 30.0}) {
      const double length = more * std::max(Norm(way), 1.0);
      const std::vector<Vec3d> line = Line(from, from + way, length);
      EXPECT_EQ(line.front(), from);
      EXPECT_NEAR(Norm(line.back() - (from + way)), 0.0, 1e-9);
      EXPECT_NEAR(LengthOf(line), length, 2e-3 * length) << way.x << " " << way.z << " " << more;
      for (std::size_t n = 1; n < line.size(); ++n) {
        ASSERT_LT(Norm(line[n] - line[n - 1]), 1.1 * length / 2000.0) << n;  // evenly spread
      }
    }
  }
}

TEST(HangingLine, IsStraightWhereItIsTaut) {
  for (const double length : {9.0, 10.0, -1.0}) {
    const std::vector<Vec3d> line = Line({0, 0, 0}, {6, 0, 8}, length, 5);
    EXPECT_NEAR(Norm(line[1] - Vec3d{1.5, 0, 2}), 0.0, 1e-6);
    EXPECT_NEAR(Norm(line[2] - Vec3d{3, 0, 4}), 0.0, 1e-6);
  }
}

constexpr int kWidth = 320, kHeight = 180;
constexpr double kFov = 0.785, kEyeM = 3.0;

class RopesTest : public GlTest {
 protected:
  RopesTest() : sea_(1e-4, 3.0, 2.6, 64) {
    sea_.FillFrame(12.0, frame_);
    frame_.camera = {{0, 0, kEyeM}, 0.0, 0.0, 0.0, kFov};
    frame_.weather.cloud_cover = 0.0;
    frame_.sun = {2.6, 0.7};
    frame_.quality.bloom = false;
  }

  // How much ropes change each pixel, all three channels together; top row first.
  std::vector<int> Change() {
    std::vector<RopeLine> ropes;
    std::swap(ropes, frame_.ropes);
    const Picture without = Draw(frame_, kWidth, kHeight);
    std::swap(ropes, frame_.ropes);
    const Picture with = Draw(frame_, kWidth, kHeight);
    std::vector<int> change;
    for (std::size_t n = 0; n < with.rgb.size(); n += 3) {
      int sum = 0;
      for (std::size_t c = 0; c < 3; ++c) sum += std::abs(with.rgb[n + c] - without.rgb[n + c]);
      change.push_back(sum);
    }
    return change;
  }
  static int Total(const std::vector<int>& change) {
    int total = 0;
    for (const int one : change) total += one;
    return total;
  }
  static int At(const std::vector<int>& change, int x, int y) {
    return change[static_cast<std::size_t>(y * kWidth + x)];
  }
  // The most changed row of a column; -1: none that changed by more than `most`.
  static int RowOf(const std::vector<int>& change, int x, int most = 20) {
    int row = -1;
    for (int y = 0; y < kHeight; ++y) {
      if (At(change, x, y) > most) most = At(change, x, row = y);
    }
    return row;
  }
  static double RowOfHeight(double z_m, double distance_m) {
    const double scale = 0.5 * kHeight / std::tan(0.5 * kFov) / distance_m;
    return 0.5 * kHeight - 0.5 - scale * (z_m - kEyeM);
  }

  TestSea sea_;
  RenderFrame frame_;
};

// Twenty metres ahead, from left to right: taut at 4 m above the water, slack a metre lower in the
// middle.
TEST_F(RopesTest, IsSeenWhereItHangs) {
  for (const int samples : {1, 4}) {
    frame_.quality.samples = samples;
    frame_.ropes = {{{20, 6, 4}, {20, -6, 4}, 5.0}};
    const std::vector<int> taut = Change();
    EXPECT_NEAR(RowOf(taut, kWidth / 2), RowOfHeight(4.0, 20.0), 1.0);
    EXPECT_NEAR(RowOf(taut, kWidth / 2 - 50), RowOfHeight(4.0, 20.0), 1.0);
    EXPECT_EQ(RowOf(taut, 8), -1);  // beyond its end
    frame_.ropes[0].length_m = 12.22;
    double lowest_m = 9.0;
    for (const Vec3d& place : Line(frame_.ropes[0].from_m, frame_.ropes[0].to_m, 12.22)) {
      lowest_m = std::min(lowest_m, place.z);
    }
    EXPECT_NEAR(lowest_m, 3.0, 0.02);
    EXPECT_NEAR(RowOf(Change(), kWidth / 2), RowOfHeight(lowest_m, 20.0), 1.0);
  }
}

// Twice as far it is half as high in the picture: as much light as it should, however thin.
TEST_F(RopesTest, FadesWithDistanceInsteadOfBreakingUp) {
  int before = 0;
  for (const double distance_m : {25.0, 50.0, 100.0}) {
    // Against the sky, as wide as the picture.
    frame_.camera.pitch_rad = 0.3;
    const double z = kEyeM + distance_m * std::tan(0.3);
    frame_.ropes = {{{distance_m, distance_m, z}, {distance_m, -distance_m, z}, 1.0, 0.04}};
    const std::vector<int> change = Change();
    for (int x = 4; x < kWidth - 4; ++x)
      EXPECT_GE(RowOf(change, x, 3), 0) << distance_m << " " << x;
    const int total = Total(change);
    if (before != 0) {
      EXPECT_NEAR(static_cast<double>(before) / total, 2.0, 0.5) << distance_m;
    }
    before = total;
  }
}

TEST_F(RopesTest, SeaAndHullsHideIt) {
  frame_.ropes = {{{20, 6, -0.5}, {20, -6, -0.5}, 1.0}};
  EXPECT_EQ(Total(Change()), 0);
  HullPainter painter;
  painter.Box({-1, -1, -3}, {1, 1, 3}, {{1, 1, 1}, 0.0f, 0.0f});
  const auto box = std::make_shared<const HullMesh>(painter.Finish());
  for (const int samples : {1, 4}) {
    frame_.quality.samples = samples;
    frame_.hulls = {{box, {20, 0, 1}, {1, 0, 0, 0}, {1, 1, 1}}};
    // Behind the box, beside it, and before it.
    frame_.ropes = {{{23, 6, 3}, {23, -6, 3}, 1.0}};
    const std::vector<int> behind = Change();
    EXPECT_EQ(RowOf(behind, kWidth / 2), -1);
    EXPECT_GE(RowOf(behind, kWidth / 2 - 30), 0);
    EXPECT_GE(RowOf(behind, kWidth / 2 + 30), 0);
    frame_.ropes = {{{17, 6, 3}, {17, -6, 3}, 1.0}};
    EXPECT_GE(RowOf(Change(), kWidth / 2), 0);
    // Made fast to its front: hidden behind it, seen to its end before it.
    frame_.ropes = {{{19, 0, 3}, {15, 0, 3.5}, 1.0}};
    EXPECT_GT(Total(Change()), 100);
    // A hull that is somewhere else hides nothing.
    frame_.hulls[0].position_m = {20, -9, 1};
    frame_.ropes = {{{23, 6, 3}, {23, -3, 3}, 1.0}};
    EXPECT_GE(RowOf(Change(), kWidth / 2), 0);
    frame_.hulls.clear();
    EXPECT_GE(RowOf(Change(), kWidth / 2), 0);
  }
}

// From under the water, at the camera, behind it, of no length, a thousand and more: no harm.
TEST_F(RopesTest, StandsAnything) {
  frame_.ropes = {{{-20, 1, 3}, {20, -1, 3}, 45.0}, {{0, 0, kEyeM}, {0, 0, kEyeM}, 5.0},
                  {{0, 0, kEyeM}, {30, 0, 3}, 1.0}, {{-5, 0, 3}, {-9, 0, 3}, 9.0},
                  {{12, 0, 3}, {12, 0, 3}, 1e-3},   {{1e7, -1e7, 0}, {-1e7, 1e7, 0}, 1e4},
                  {{15, 0, 9}, {15, 1e-9, -9}, 1e4}};
  EXPECT_GT(Total(Change()), 0);
  frame_.ropes.insert(frame_.ropes.end(), kRenderRopesMax + 5, {{20, 3, 4}, {20, -3, 4}, 7.0});
  Change();
  frame_.camera.position_m.z = -2.0;
  frame_.ropes = {{{6, 3, -1}, {6, -3, -1}, 6.5}};
  EXPECT_GT(Total(Change()), 100);
}

}  // namespace
}  // namespace onesea::render
