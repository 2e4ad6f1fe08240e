// WAVEWATCH III and SWAN: senses, units, blocks and their traps.

#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "common/ingest/grid_axes.h"
#include "gmock/gmock.h"
#include "tests/ingest/spectrum_test_util.h"

namespace onesea::ingest {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kTurn = 2.0 * sea::kPi;

const sea::GridSpectrum& Grid(const SpectrumRecord& record) {
  return std::get<sea::GridSpectrum>(record.system);
}

// Two frequencies, four directions (north, west, south, east as compass "to"), one point; energy
// 2 m²/Hz/rad travels to the west at 0.2 Hz alone.
const char kWw3[] =
    "'WAVEWATCH III SPECTRA'     2     4     1 'a grid with blanks'\n"
    " 0.100E+00 0.200E+00\n"
    "  0.000E+00  0.471E+01  0.314E+01\n"
    "  0.157E+01\n"
    "20220912 060000\n"
    "'buoy 1    ' -40.98-171.12      46.6   1.45 225.6   0.18  94.1\n"
    "  0.000E+00  0.000E+00  0.000E+00  2.000D+00  0.123-104  0.000E+00\n"
    "  0.000E+00  0.000E+00\n";

TEST(Ww3, DirectionsAreToAndFrequencyRunsFastest) {
  const auto records = ParseText("p.spec", kWw3);
  ASSERT_TRUE(records.ok()) << records.status();
  ASSERT_EQ(records->size(), 1U);
  const SpectrumRecord& record = records->front();
  EXPECT_EQ(record.time_utc, "2022-09-12T06:00");
  EXPECT_EQ(record.place, "buoy 1");
  EXPECT_DOUBLE_EQ(record.latitude_deg.value(), -40.98);
  EXPECT_DOUBLE_EQ(record.longitude_deg.value(), -171.12);  // its column touches the one before
  EXPECT_DOUBLE_EQ(record.depth_m.value(), 46.6);
  const sea::SpectrumStatistics s = StatisticsOf(record);
  EXPECT_NEAR(s.mean_wave_to_rad, sea::kPi, 3e-3);  // west, counter-clockwise from east
  EXPECT_NEAR(NauticalFromWaveTo(s.mean_wave_to_rad), 90.0, 0.1);
  EXPECT_NEAR(s.tp_s, 5.0, 1e-6);
  // Density per radian: m0 = 2 · (π/2) · 0.05.
  EXPECT_NEAR(s.hs_m, 4.0 * std::sqrt(2.0 * 0.5 * sea::kPi * 0.05), 1e-4);
}

// Directions have three digits in the file, but the model's bins are 10 degrees wide exactly.
TEST(Ww3, DirectionsAreUnrounded) {
  const auto records = ReadSpectrumFile(kSpectra + "ww3station.spec");
  ASSERT_TRUE(records.ok()) << records.status();
  EXPECT_EQ(records->size(), 4U);
  EXPECT_EQ(records->front().place, "44097");
  const std::vector<float>& angle = Grid(records->front()).wave_to_rad;
  ASSERT_EQ(angle.size(), 36U);
  for (std::size_t j = 1; j < angle.size(); ++j) {
    EXPECT_NEAR(angle[j] - angle[j - 1], kTurn / 36.0, 1e-6);
  }
  EXPECT_NEAR(std::fmod(angle[0], kTurn / 36.0), kTurn / 72.0, 1e-3);  // 5, 15, 25 ... degrees
}

TEST(Ww3, SeveralPointsShareOneTime) {
  std::string two = absl::StrReplaceAll(kWw3, {{"     1 'a", "     2 'a"}});
  const std::string point = two.substr(two.find("'buoy"));
  two += absl::StrReplaceAll(point, {{"buoy 1", "buoy 2"}});
  const auto records = ParseText("p.spec", two);
  ASSERT_TRUE(records.ok()) << records.status();
  ASSERT_EQ(records->size(), 2U);
  EXPECT_THAT(std::string(FindRecord(*records, "").status().message()),
              HasSubstr("place: must be given; there are 2 of them, beginning with 'buoy 1'"));
  EXPECT_EQ(FindRecord(*records, "", "buoy 2").value(), &(*records)[1]);
  EXPECT_FALSE(FindRecord(*records, "", "buoy 3").ok());
}

TEST(Ww3, BadFieldsAreNamed) {
  const std::pair<std::pair<const char*, const char*>, const char*> edits[] = {
      {{"     2     4", "   999     4"}, "p.spec:1: frequencies: '999' is not in [2, 128]"},
      {{"     2     4", "     2     1"}, "p.spec:1: directions: '1' is not in [2, 180]"},
      {{" 0.200E+00", " 0.050E+00"}, "p.spec:2: frequency: 0.05 Hz is not above"},
      {{"0.471E+01", "0.000E+00"}, "two directions are equal"},
      {{"0.471E+01", "0.471E+03"}, "p.spec:3: direction: is not in radians"},
      {{"20220912 ", "20220931 "}, "p.spec:5: time: "},
      {{"-40.98-171.12", "-40.98 west"}, "p.spec:6: point: "},
      {{"2.000D+00", "-2.00D+00"}, "p.spec:7: density: -2 is not in [0, 1e+06]"},
      {{"2.000D+00", "2.000D+05"}, "the limit is 40 m"},
      {{"2.000D+00", "*********"}, "p.spec:7: density: '*********' is not a number"}};
  for (const auto& [edit, message] : edits) {
    const auto records = ParseText("p.spec", absl::StrReplaceAll(kWw3, {edit}));
    EXPECT_THAT(std::string(records.status().message()), HasSubstr(message));
  }
}

// Two times, three places (one NODATA, one ZERO at the second time), Cartesian directions that
// cover a sector.
const char kSwanHead[] =
    "SWAN   1       Swan standard spectral file\n"
    "$ a comment\n"
    "TIME           time-dependent data\n     1   coding\n"
    "LOCATIONS\n     3\n  0.0 0.0\n  100.0 0.0\n  200.5 -3.25\n"
    "RFREQ\n     2\n  0.1\n  0.2\n"
    "CDIR\n     3\n  -30.0\n  0.0\n  30.0\n"
    "QUANT\n     1\nVaDens\nm2/Hz/degr\n  -99\n";
const char kSwanBlocks[] =
    "20240624.180000\n"
    "FACTOR\n  0.5E-02\n  0 0 0\n  0 -99 10\n"
    "NODATA\n"
    "FACTOR\n  0.1E-02\n  0 7 0\n  0 0 0\n"
    "20240624.190000\n"
    "ZERO\n"
    "FACTOR\n  0.1E-02\n  0 7 0\n  0 0 0\n"
    "NODATA\n";

TEST(Swan, BlocksFactorsAndExceptions) {
  const auto records = ParseText("s.spec", absl::StrCat(kSwanHead, kSwanBlocks));
  ASSERT_TRUE(records.ok()) << records.status();
  ASSERT_EQ(records->size(), 3U);
  EXPECT_EQ((*records)[0].time_utc, "2024-06-24T18:00");
  EXPECT_EQ((*records)[1].place, "200.5,-3.25");
  EXPECT_EQ((*records)[2].time_utc, "2024-06-24T19:00");
  EXPECT_EQ((*records)[2].place, "100,0");
  EXPECT_EQ((*records)[0].format, "SWAN 2-D, relative frequencies");
  EXPECT_FALSE((*records)[0].latitude_deg.has_value());  // metres, not degrees
  const sea::SpectrumStatistics s = StatisticsOf((*records)[0]);
  // 10 · 0.005 per degree in a cell of 30 degrees; half a triangle over 0.1 Hz.
  EXPECT_NEAR(s.hs_m, 4.0 * std::sqrt(10 * 0.005 * 30.0 * 0.05), 1e-5);
  EXPECT_NEAR(s.mean_wave_to_rad, 30.0 * kRadPerDeg, 1e-6);  // Cartesian, towards
}

TEST(Swan, SectorIsClosedByEmptyColumns) {
  const auto records = ParseText("s.spec", absl::StrCat(kSwanHead, kSwanBlocks));
  ASSERT_TRUE(records.ok()) << records.status();
  const sea::GridSpectrum& grid = Grid(records->front());
  ASSERT_EQ(grid.wave_to_rad.size(), 5U);
  const double expected_deg[] = {0.0, 30.0, 60.0, 300.0, 330.0};
  for (std::size_t j = 0; j < 5; ++j) {
    EXPECT_NEAR(grid.wave_to_rad[j] / kRadPerDeg, expected_deg[j], 1e-4);
  }
}

TEST(Swan, EnergyDensityBecomesVariance) {
  const std::string variance = absl::StrCat(kSwanHead, kSwanBlocks);
  const std::string energy = absl::StrReplaceAll(
      variance, {{"VaDens\nm2/Hz/degr", "EnDens\nJ/m2/Hz/degr"}, {"0.5E-02", "50.27625"}});
  const auto a = ParseText("a", variance), b = ParseText("b", energy);
  ASSERT_TRUE(a.ok() && b.ok()) << b.status();
  EXPECT_NEAR(StatisticsOf(a->front()).hs_m, StatisticsOf(b->front()).hs_m, 1e-5);
}

TEST(Swan, NauticalFromAndCartesianToAreOneSea) {
  const std::string cartesian = absl::StrCat(kSwanHead, kSwanBlocks);
  const std::string nautical = absl::StrReplaceAll(
      cartesian, {{"CDIR", "NDIR"}, {"  -30.0\n  0.0\n  30.0", "  300.0\n  270.0\n  240.0"}});
  const auto a = ParseText("a", cartesian), b = ParseText("b", nautical);
  ASSERT_TRUE(a.ok() && b.ok()) << b.status();
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(StatisticsOf((*a)[i]).mean_wave_to_rad, StatisticsOf((*b)[i]).mean_wave_to_rad,
                1e-6);
  }
}

TEST(Swan, PlacesWithoutDataGiveNoRecord) {
  const auto records = ReadSpectrumFile(kSpectra + "swanhot.spec");
  ASSERT_TRUE(records.ok()) << records.status();
  EXPECT_EQ(records->size(), 240U - 32U);
  EXPECT_DOUBLE_EQ(records->front().longitude_deg.value(), 165.0);
  EXPECT_DOUBLE_EQ(records->front().latitude_deg.value(), -48.0);
}

// Stationary, 0 directions: a line holds density, direction and spread.
TEST(Swan, OneDimensionalWithDirectionIsABuoy) {
  const auto records = ReadSpectrumFile(kSpectra + "f31har01.bnd");
  ASSERT_TRUE(records.ok()) << records.status();
  ASSERT_EQ(records->size(), 1U);
  EXPECT_EQ(records->front().time_utc, "");
  EXPECT_EQ(FindRecord(*records, "").value(), &records->front());
  const auto& buoy = std::get<sea::BuoySpectrum>(records->front().system);
  ASSERT_EQ(buoy.frequency_hz.size(), 100U);
  EXPECT_NEAR(buoy.mean_wave_to_rad[5], 9.8 * kRadPerDeg, 1e-6);
  const double spread_rad = 31.5 * kRadPerDeg;
  EXPECT_NEAR(buoy.r1[5], 1.0 - 0.5 * spread_rad * spread_rad, 1e-6);
  EXPECT_NEAR(StatisticsOf(records->front()).spread_rad, spread_rad, 1e-4);
}

TEST(Swan, BadFieldsAreNamed) {
  const std::string text = absl::StrCat(kSwanHead, kSwanBlocks);
  const std::pair<std::pair<const char*, const char*>, const char*> edits[] = {
      {{"     1   coding", "     2   coding"}, "s.spec:4: time coding: 2; only 1"},
      {{"     3\n  0.0 0.0", "999999\n  0.0 0.0"}, "s.spec:6: locations: '999999' is not in"},
      {{"  100.0 0.0", "  100.0 zero"}, "s.spec:8: location: "},
      {{"  0.2\n", "  0.1\n"}, "s.spec:13: frequency: 0.1 Hz is not above"},
      {{"  30.0\n", "  3000.0\n"}, "s.spec:18: direction: is not in [-720, 720]"},
      {{"  30.0\n", "  330.0\n"}, "s.spec:18: direction: two directions are equal"},
      {{"VaDens", "AcDens"}, "action is not read"},
      {{"QUANT", "QUANTUM"}, "s.spec:19: keyword: 'QUANTUM'"},
      {{"20240624.180000", "20240631.180000"}, "s.spec:24: time: "},
      {{"FACTOR\n  0.5E-02", "LOCATION\n  0.5E-02"},
       "s.spec:25: keyword: 'LOCATION' is not FACTOR"},
      {{"0.5E-02", "-1"}, "s.spec:26: FACTOR: -1 is not in [0, 1e+06]"},
      {{"0 -99 10", "0 -98 10"}, "s.spec:28: density: "},
      {{"0 -99 10", "0 -99 1e6"}, "the limit is 40 m"},
      {{"0.1E-02\n  0 7 0\n  0 0 0\nNODATA\n", ""}, "the file ends here; it is cut short"}};
  for (const auto& [edit, message] : edits) {
    const auto records = ParseText("s.spec", absl::StrReplaceAll(text, {edit}));
    EXPECT_THAT(std::string(records.status().message()), HasSubstr(message)) << edit.second;
  }
}

TEST(SortDirections, EvenCircleNeedsNoClosing) {
  const std::vector<double> to_rad = {0.1 + 3 * kTurn / 4, 0.1, 0.1 + kTurn / 4, 0.1 + kTurn / 2};
  const auto axis = SortDirections(to_rad, 1e-4);
  ASSERT_TRUE(axis.ok());
  EXPECT_THAT(axis->source_column, ElementsAre(1, 2, 3, 0));
}

// The bin at due east is printed as 6.28: 3 mrad below a full turn.
TEST(SortDirections, RoundedDirectionNextToTheSeamStaysOneBin) {
  std::vector<double> to_rad;
  for (int j = 0; j < 36; ++j) to_rad.push_back(std::round(j * kTurn / 36 * 100) / 100);
  to_rad[0] = 6.28;
  const auto axis = SortDirections(to_rad, 5.1e-3);
  ASSERT_TRUE(axis.ok());
  ASSERT_EQ(axis->wave_to_rad.size(), 36U);
  for (std::size_t j = 1; j < 36; ++j) {
    EXPECT_NEAR(axis->wave_to_rad[j] - axis->wave_to_rad[j - 1], kTurn / 36, 1e-6);
  }
}

}  // namespace
}  // namespace onesea::ingest
