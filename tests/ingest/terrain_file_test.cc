#include "common/ingest/terrain_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"

namespace onesea::ingest {
namespace {

using ::testing::HasSubstr;

sea::Terrain Parsed(absl::string_view text, const TerrainOptions& options = {}) {
  const auto terrain = ParseTerrain("t", text, options);
  EXPECT_TRUE(terrain.ok()) << terrain.status();
  return terrain.value_or(sea::Terrain{});
}

std::string Refusal(absl::string_view text, const TerrainOptions& options = {}) {
  return std::string(ParseTerrain("t", text, options).status().message());
}

constexpr char kSmall[] =
    "ncols 3\nnrows 2\nxllcorner 100\nyllcorner 200\ncellsize 10\nNODATA_value -9999\n"
    "1 2 3\n4 -9999 -6.5\n";

TEST(EsriAscii, RowsComeNorthFirstAndCornersAreHalfACellOut) {
  const sea::Terrain t = Parsed(kSmall, {.origin = {100, 200}});
  EXPECT_EQ(t.columns, 3);
  EXPECT_EQ(t.rows, 2);
  EXPECT_EQ(t.cell_m, 10.0);
  EXPECT_EQ(t.west_m, 5.0);
  EXPECT_EQ(t.south_m, 5.0);
  EXPECT_EQ(t.elevation_m, (std::vector<float>{4, 10, -6.5, 1, 2, 3}));
}

TEST(EsriAscii, CentresAndOrderOfKeysDontMatter) {
  const sea::Terrain t = Parsed(
      "NROWS 2\r\nNCOLS 2\r\nCellSize 5\r\nYLLCENTER -5\r\nXLLCENTER 7\r\n1\r\n2 3\r\n 4\r\n");
  EXPECT_EQ(t.west_m, 7.0);
  EXPECT_EQ(t.south_m, -5.0);
  EXPECT_EQ(t.elevation_m, (std::vector<float>{3, 4, 1, 2}));
}

TEST(EsriAscii, DepthsTurnIntoElevations) {
  const sea::Terrain t = Parsed(kSmall, {.depth_positive = true, .missing_elevation_m = 3.0});
  EXPECT_EQ(t.elevation_m, (std::vector<float>{-4, 3, 6.5, -1, -2, -3}));
}

TEST(EsriAscii, CellsThatAreNotSquareAreSampledAgain) {
  std::string text = "ncols 5\nnrows 4\nxllcenter 0\nyllcenter 0\ndx 10\ndy 25\n";
  for (int j = 3; j >= 0; --j) {
    for (int i = 0; i < 5; ++i) absl::StrAppend(&text, 0.1 * i * 10 - 0.02 * j * 25, " ");
  }
  const sea::Terrain t = Parsed(text);
  EXPECT_EQ(t.cell_m, 10.0);
  EXPECT_EQ(t.columns, 5);
  EXPECT_EQ(t.rows, 8);  // 75 m hold seven cells of 10 m
  for (const Vec2d place : {Vec2d{0, 0}, Vec2d{33, 47}, Vec2d{40, 70}}) {
    EXPECT_NEAR(t.ElevationAt(place), 0.1 * place.x - 0.02 * place.y, 1e-5);  // bilinear: exact
  }
}

TEST(EsriAscii, ReadsAPieceOfTheDutchCoast) {
  const auto t = ReadTerrainFile("tests/data/terrain/haringvliet.asc", {.origin = {5000, 10000}});
  ASSERT_TRUE(t.ok()) << t.status();
  EXPECT_EQ(t->columns, 40);
  EXPECT_EQ(t->rows, 30);
  EXPECT_EQ(t->west_m, 0.0);
  // From the original: 88 depths a line from the south-west, line 68, number 21; -99 is missing.
  EXPECT_FLOAT_EQ(t->elevation_m[0], -18.8f);
  int missing = 0;
  for (const float e : t->elevation_m) missing += e == 10.0f;
  EXPECT_EQ(missing, 425);
}

TEST(EsriAscii, RefusalsNameTheLineAndTheField) {
  std::string text = kSmall;
  EXPECT_THAT(Refusal(text.substr(0, text.size() - 6)), HasSubstr("samples"));
  EXPECT_THAT(Refusal(text + "7"), HasSubstr("more than ncols x nrows = 6"));
  EXPECT_THAT(Refusal(text + "\n\n7"), HasSubstr("more than"));
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = kSmall;
    changed.replace(changed.find(from), from.size(), to);
    return Refusal(changed);
  };
  EXPECT_THAT(with("2 3", "x 3"), HasSubstr("t:7: sample: 'x' is not a number"));
  EXPECT_THAT(with("2 3", "nan 3"), HasSubstr("t:7: sample"));
  EXPECT_THAT(with("2 3", "20000 3"), HasSubstr("beyond ±12000"));
  EXPECT_THAT(with("ncols 3", "ncols 1"), HasSubstr("ncols: 1 is not a number from 2 to 4096"));
  EXPECT_THAT(with("ncols 3", "ncols 3.5"), HasSubstr("ncols"));
  EXPECT_THAT(with("ncols 3", "ncols 3 3"), HasSubstr("one number"));
  EXPECT_THAT(with("ncols 3", "nrows 3"), HasSubstr("given twice"));
  EXPECT_THAT(with("ncols 3\n", ""), HasSubstr("ncols: missing"));
  EXPECT_THAT(with("cellsize 10", "cellsize 0"), HasSubstr("cellsize: not positive"));
  EXPECT_THAT(with("cellsize 10", "cellsize 1e9"), HasSubstr("cellsize"));
  EXPECT_THAT(with("xllcorner 100", "xllcenter 1e300"), HasSubstr("west_m"));
  EXPECT_THAT(with("nrows 2", "nrows 4096"), HasSubstr("samples"));
  EXPECT_THAT(Refusal("ncols 3"), HasSubstr("the first row"));
}

std::string Shuffled(std::vector<std::string> lines) {
  std::shuffle(lines.begin(), lines.end(), std::mt19937(1));
  std::string text = "# x y z\n";
  for (const std::string& line : lines) absl::StrAppend(&text, line, "\n");
  return text;
}

TEST(Xyz, AnyOrderOfARegularGridWillDo) {
  std::vector<std::string> lines;
  for (int j = 0; j < 7; ++j) {
    for (int i = 0; i < 9; ++i) {
      if (i == 4 && j == 3) continue;
      lines.push_back(absl::StrFormat("%.2f, %.2f; %d", 50 + 2.5 * i, -20 + 2.5 * j, i - 10 * j));
    }
  }
  const sea::Terrain t = Parsed(Shuffled(lines), {.origin = {50, 0}, .missing_elevation_m = 99});
  EXPECT_EQ(t.columns, 9);
  EXPECT_EQ(t.rows, 7);
  EXPECT_NEAR(t.cell_m, 2.5, 1e-9);
  EXPECT_EQ(t.west_m, 0.0);
  EXPECT_EQ(t.south_m, -20.0);
  for (int j = 0; j < 7; ++j) {
    for (int i = 0; i < 9; ++i) {
      EXPECT_EQ(t.elevation_m[j * 9 + i], i == 4 && j == 3 ? 99 : i - 10 * j);
    }
  }
}

// Oracle: WGS 84 at 42° north has 111,073 m in a degree of latitude, 82,854 m in one of
// longitude.
TEST(Xyz, DegreesBecomeMetresAroundTheOrigin) {
  std::vector<std::string> lines;
  for (int j = 0; j < 40; ++j) {
    for (int i = 0; i < 30; ++i) {
      lines.push_back(absl::StrFormat("%.7f %.7f %.2f", 139.41 + 0.0002469 * i,
                                      42.0 + 0.0002469 * (j - 20), 0.25 * i - 0.5 * j));
    }
  }
  const sea::Terrain t = Parsed(Shuffled(lines), {.origin = {139.41, 42.0}, .degrees = true});
  EXPECT_NEAR(t.west_m, 0.0, 0.02);
  EXPECT_NEAR(t.south_m, -20 * 0.0002469 * 111073, 0.5);
  EXPECT_NEAR(t.cell_m, 0.0002469 * 82854, 0.01);
  // 10 samples east and 4 north of the origin.
  EXPECT_NEAR(t.ElevationAt({10 * 0.0002469 * 82854, 4 * 0.0002469 * 111073}), 2.5 - 12.0, 0.02);
}

TEST(Xyz, RefusalsSayWhatIsWrong) {
  EXPECT_THAT(Refusal(""), HasSubstr("lines of a grid"));
  EXPECT_THAT(Refusal("1 2 3\n"), HasSubstr("lines of a grid"));
  EXPECT_THAT(Refusal("0 0 1\n1 0\n"), HasSubstr("t:2: z"));
  EXPECT_THAT(Refusal("0 0 1\n1 0 1 1\n"), HasSubstr("x y z alone"));
  EXPECT_THAT(Refusal("0 0 1\n1 0 inf\n"), HasSubstr("t:2: z"));
  EXPECT_THAT(Refusal("0 0 1\n1 0 1\n0 1 1\n0 0 2\n"), HasSubstr("t:4: point: given twice"));
  EXPECT_THAT(Refusal("0 0 1\n1 0 1\n2.4 0 1\n0 1 1\n1 1 1\n2.4 1 1\n"),
              HasSubstr("not on a regular grid"));
  std::string diagonal;
  for (int n = 0; n < 100; ++n) absl::StrAppend(&diagonal, n, " ", n, " 1\n");
  EXPECT_THAT(Refusal(diagonal), HasSubstr("a quarter of the 100 x 100 grid"));
  EXPECT_THAT(Refusal("-1e308 0 1\n1e308 0 1\n0 1 1\n"), HasSubstr("x:"));
}

TEST(TerrainFile, RefusesImpossibleOptions) {
  EXPECT_THAT(Refusal(kSmall, {.origin = {0, 89}, .degrees = true}), HasSubstr("terrain.origin.y"));
  EXPECT_THAT(Refusal(kSmall, {.missing_elevation_m = NAN}), HasSubstr("missing_elevation_m"));
  EXPECT_EQ(ReadTerrainFile("tests/data/terrain/absent.asc", {}).status().code(),
            absl::StatusCode::kNotFound);
}

}  // namespace
}  // namespace onesea::ingest
