// NDBC's files and their traps.

#include <fstream>
#include <map>
#include <sstream>

#include "absl/strings/str_replace.h"
#include "common/ingest/ndbc_files.h"
#include "common/ingest/ndbc_spectrum.h"
#include "gmock/gmock.h"
#include "tests/ingest/spectrum_test_util.h"

namespace onesea::ingest {
namespace {

using testing::ElementsAre;
using testing::FloatEq;
using testing::HasSubstr;

const sea::BuoySpectrum& Buoy(const SpectrumRecord& record) {
  return std::get<sea::BuoySpectrum>(record.system);
}

// Three bands of one hour in the historical form; any file may be left out.
std::vector<NamedBytes> HistoryFiles(const std::string& header, const std::string& time) {
  const std::string head = header + "  .0925  .1000  .1100\n" + time;
  return {{"x/41010w2019.txt", head + "  1.00  2.00  3.00\n"},
          {"x/41010d2019.txt", head + "   270     0    90\n"},
          {"x/41010i2019.txt", head + "   260    10   999\n"},
          {"x/41010j2019.txt", head + "    50   100    80\n"},
          {"x/41010k2019.txt", head + "    25    90    40\n"}};
}

const char kHeader[] = "#YY  MM DD hh mm";
const char kTime[] = "2019 02 10 05 40";

TEST(NdbcHistory, HundredthsBecomeFractionsAndFromBecomesTo) {
  const auto records = ParseSpectrum(HistoryFiles(kHeader, kTime));
  ASSERT_TRUE(records.ok()) << records.status();
  ASSERT_EQ(records->size(), 1U);
  const SpectrumRecord& record = records->front();
  EXPECT_EQ(record.time_utc, "2019-02-10T05:40");
  EXPECT_EQ(record.place, "41010");
  EXPECT_EQ(record.format, "NDBC historical, directional");
  const sea::BuoySpectrum& buoy = Buoy(record);
  EXPECT_THAT(buoy.r1, ElementsAre(FloatEq(0.5F), FloatEq(1.0F), FloatEq(0.8F)));
  EXPECT_NEAR(buoy.mean_wave_to_rad[0], 0.0, 1e-6);
  EXPECT_NEAR(buoy.mean_wave_to_rad[1], 1.5 * sea::kPi, 1e-6);
  EXPECT_NEAR(FromDeg(buoy.principal_wave_to_rad[0]), 260.0, 1e-4);
  EXPECT_FLOAT_EQ(buoy.r2[0], 0.25F);
  // alpha2 is missing in the last band: cos^2s with s = 4 has r2 = 12/30, about the mean direction.
  EXPECT_FLOAT_EQ(buoy.principal_wave_to_rad[2], buoy.mean_wave_to_rad[2]);
  EXPECT_FLOAT_EQ(buoy.r2[2], 0.4F);
}

TEST(NdbcHistory, AnyOfTheFiveFilesNamesTheSet) {
  std::vector<NamedBytes> files = HistoryFiles(kHeader, kTime);
  const auto by_density = ParseSpectrum(files);
  std::swap(files[0], files[3]);
  const auto by_r1 = ParseSpectrum(files);
  ASSERT_TRUE(by_density.ok() && by_r1.ok()) << by_r1.status();
  EXPECT_EQ(by_density->front().system, by_r1->front().system);
  files.erase(files.begin() + 3);  // the density
  const absl::Status status = ParseSpectrum(files).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(std::string(status.message()), HasSubstr("x/41010w2019.txt"));
}

TEST(NdbcHistory, HeadersOfAllTimesAreRead) {
  const std::pair<const char*, const char*> forms[] = {{"YY MM DD hh", "96 02 10 05"},
                                                       {"YYYY MM DD hh", "1996 02 10 05"},
                                                       {"YYYY MM DD hh mm", "1996 02 10 05 00"},
                                                       {"#YY  MM DD hh mm", "1996 02 10 05 00"}};
  for (const auto& [header, time] : forms) {
    const auto records = ParseSpectrum(HistoryFiles(header, time));
    ASSERT_TRUE(records.ok()) << header << ": " << records.status();
    EXPECT_EQ(records->front().time_utc, "1996-02-10T05:00") << header;
  }
}

// 999 taken for a density would give a sea of 77 m.
TEST(NdbcHistory, MissingDensitiesAreNoEnergy) {
  const std::string text =
      "YY MM DD hh  .10  .11  .12\n"
      "96 01 01 00  999.00  999.00  999.00\n"
      "96 01 01 01  1.00  999.00  2.00\n"
      "96 01 01 02  0.00  0.00  0.00\n";
  const auto records = ParseText("46042w1996.txt", text);
  ASSERT_TRUE(records.ok()) << records.status();
  ASSERT_EQ(records->size(), 1U);
  EXPECT_EQ(records->front().time_utc, "1996-01-01T01:00");
  EXPECT_THAT(Buoy(records->front()).density_m2_per_hz, ElementsAre(1.0F, 2.0F));
  EXPECT_NEAR(Buoy(records->front()).hs_m, 4.0 * std::sqrt(0.01 * 3.0), 1e-6);
  EXPECT_EQ(records->front().format, "NDBC historical, 1-D");
}

TEST(NdbcHistory, OnlyMissingRowsAreNoRecord) {
  const auto records = ParseText("46042w1996.txt", "YY MM DD hh .1 .2\n96 01 01 00 999.0 999.0\n");
  EXPECT_THAT(std::string(records.status().message()), HasSubstr("no record with waves"));
}

TEST(NdbcHistory, MissingDirectionIsAllRound) {
  std::vector<NamedBytes> files = HistoryFiles(kHeader, kTime);
  files[1].bytes = absl::StrReplaceAll(files[1].bytes, {{"   270", "   999"}});
  files[3].bytes = absl::StrReplaceAll(files[3].bytes, {{"   100", "   999"}});
  const auto records = ParseSpectrum(files);
  ASSERT_TRUE(records.ok()) << records.status();
  EXPECT_THAT(Buoy(records->front()).r1, ElementsAre(0.0F, 0.0F, FloatEq(0.8F)));
  EXPECT_THAT(Buoy(records->front()).r2, ElementsAre(0.0F, 0.0F, FloatEq(0.4F)));
}

struct BadCell {
  std::size_t file;
  const char* from;
  const char* to;
  const char* message;
};

TEST(NdbcHistory, OutOfRangeNamesFileLineFieldAndLimit) {
  const BadCell cells[] = {
      {0, "  2.00", " -2.00", "x/41010w2019.txt:2: density: '-2' is not >= 0"},
      {0, "  2.00", " 20000", "the limit is 40 m"},
      {0, "  2.00", "   nan", "x/41010w2019.txt:2: value: 'nan' is not a number"},
      {1, "   270", "   361", "x/41010d2019.txt:2: alpha1: '361' is not in [0, 360]"},
      {3, "    50", "   101", "x/41010j2019.txt:2: r1: '101' is not in [0, 100]"},
      {4, "    25", "    -1", "x/41010k2019.txt:2: r2: '-1' is not in [0, 100]"},
      {0, "2019 02", "2019 13", "x/41010w2019.txt:2: time: "},
      {0, ".1000", ".0900", "x/41010w2019.txt:1: frequency: 0.09 Hz is not above"},
      {0, "  3.00", "", "2 values for 3 frequencies"},
      {0, "  3.00", " 3.0 4.0", "the header names fewer frequencies"}};
  for (const BadCell& cell : cells) {
    std::vector<NamedBytes> files = HistoryFiles(kHeader, kTime);
    files[cell.file].bytes = absl::StrReplaceAll(files[cell.file].bytes, {{cell.from, cell.to}});
    const absl::Status status = ParseSpectrum(files).status();
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << cell.message;
    EXPECT_THAT(std::string(status.message()), HasSubstr(cell.message));
  }
}

TEST(NdbcBandWidths, AreNdbcsOwn) {
  const std::vector<float> bands = {0.0325F, 0.0375F, 0.0925F, 0.1F, 0.11F, 0.35F, 0.365F, 0.385F};
  EXPECT_THAT(NdbcBandWidths(bands),
              ElementsAre(0.005, 0.005, 0.005, 0.01, 0.01, 0.01, 0.02, 0.02));
  // The 38 bands of earlier systems are a hundredth of a hertz wide all through.
  for (const double width : NdbcBandWidths(std::vector<float>{0.03F, 0.04F, 0.05F, 0.06F})) {
    EXPECT_NEAR(width, 0.01, 1e-6);
  }
}

TEST(NdbcRealtime, LabelsAreRoundedAndNewestComesFirst) {
  const std::string text =
      "#YY  MM DD hh mm Sep_Freq  < spec_1 (freq_1) spec_2 (freq_2) ... >\n"
      "2020 06 08 03 50 0.225 1.000 (0.033) 2.000 (0.038) 3.000 (0.093) 4.000 (0.100)\n"
      "2020 06 08 02 50 1.500 (0.033) 2.000 (0.038) 3.000 (0.093) 4.000 (0.100)\n";
  const auto records = ParseText("41010.data_spec", text);
  ASSERT_TRUE(records.ok()) << records.status();
  ASSERT_EQ(records->size(), 2U);
  EXPECT_EQ((*records)[0].time_utc, "2020-06-08T02:50");  // no Sep_Freq in this line
  EXPECT_FLOAT_EQ(Buoy((*records)[0]).density_m2_per_hz[0], 1.5F);
  EXPECT_EQ((*records)[1].time_utc, "2020-06-08T03:50");
  EXPECT_THAT(Buoy((*records)[1]).frequency_hz,
              ElementsAre(FloatEq(0.0325F), FloatEq(0.0375F), FloatEq(0.0925F), FloatEq(0.1F)));
}

std::vector<NamedBytes> RealtimeFiles() {
  std::vector<NamedBytes> files;
  for (const NdbcQuantity quantity : kNdbcQuantities) {
    const std::string path = NdbcSibling(kSpectra + "41010.data_spec", quantity);
    files.push_back({path, Text(path)});
  }
  return files;
}

TEST(NdbcRealtime, FractionsAreNotHundredths) {
  const auto records = ParseSpectrum(RealtimeFiles());
  ASSERT_TRUE(records.ok()) << records.status();
  EXPECT_EQ(records->size(), 149U);
  float largest = 0.0F;
  for (const SpectrumRecord& record : *records) {
    for (const float r1 : Buoy(record).r1) largest = std::max(largest, r1);
  }
  EXPECT_GT(largest, 0.9F);
  EXPECT_LE(largest, 1.0F);
}

// An hour that only some of the files have is read for what it is: 1-D.
TEST(NdbcRealtime, HoursNeedNotBeInAllFiles) {
  std::vector<NamedBytes> files = RealtimeFiles();
  const std::size_t header_end = files[3].bytes.find('\n') + 1;
  const std::size_t newest_end = files[3].bytes.find('\n', header_end) + 1;
  files[3].bytes.erase(header_end, newest_end - header_end);
  const auto records = ParseSpectrum(files);
  ASSERT_TRUE(records.ok()) << records.status();
  EXPECT_EQ(records->size(), 149U);
  EXPECT_EQ(records->back().format, "NDBC real-time, 1-D");
  EXPECT_TRUE(Buoy(records->back()).r1.empty());
  EXPECT_EQ((*records)[147].format, "NDBC real-time, directional");
}

// The summary is stamped ten minutes earlier and gives heights in tenths, from more bands than it
// publishes; compared at the same stamp there would be not one match.
TEST(NdbcRealtime, AgreesWithTheSummaryOfTenMinutesBefore) {
  std::map<std::string, double> height_m;
  std::istringstream summary(Text(kSpectra + "41010.spec"));
  for (std::string line; std::getline(summary, line);) {
    int year = 0, month = 0, day = 0, hour = 0, minute = 0;
    double value = 0.0;
    if (std::sscanf(line.c_str(), "%d %d %d %d %d %lf", &year, &month, &day, &hour, &minute,
                    &value) == 6) {
      char time[32];
      std::snprintf(time, sizeof time, "%04d-%02d-%02dT%02d:%02d", year, month, day, hour,
                    minute + 10);
      height_m[time] = value;
    }
  }
  const auto records = ParseSpectrum(RealtimeFiles());
  ASSERT_TRUE(records.ok()) << records.status();
  int matches = 0;
  for (const SpectrumRecord& record : *records) {
    if (!height_m.contains(record.time_utc)) continue;
    ++matches;
    EXPECT_NEAR(Buoy(record).hs_m, height_m[record.time_utc], 0.12) << record.time_utc;
  }
  EXPECT_GT(matches, 140);
}

TEST(NdbcRealtime, SummaryIsRefusedWithAdvice) {
  const auto records = ReadSpectrumFile(kSpectra + "41010.spec");
  EXPECT_THAT(std::string(records.status().message()), HasSubstr(".data_spec"));
}

TEST(NdbcRealtime, LineThatLacksItsEndIsRefused) {
  const std::string text =
      "#YY  MM DD hh mm Sep_Freq  < spec_1 (freq_1) ... >\n"
      "2020 06 08 03 50 9.999 1.000 (0.033) 2.000 (0.038) 3.000 (0.043)\n"
      "2020 06 08 02 50 9.999 1.000 (0.033) 2.000 (0.038)\n";
  EXPECT_THAT(std::string(ParseText("a.data_spec", text).status().message()),
              HasSubstr("a.data_spec:3: value: 2 bands, the first line has 3"));
}

TEST(NdbcFiles, NamesAreToldApart) {
  const auto history = ParseNdbcName("a/b/41010k2019part.txt.gz");
  ASSERT_TRUE(history.has_value());
  EXPECT_EQ(history->quantity, NdbcQuantity::kR2);
  EXPECT_EQ(history->station, "41010");
  EXPECT_EQ(NdbcSibling("a/b/41010k2019part.txt.gz", NdbcQuantity::kDensity),
            "a/b/41010w2019part.txt.gz");
  EXPECT_EQ(NdbcSibling("41010.swdir2.gz", NdbcQuantity::kR1), "41010.swr1.gz");
  EXPECT_FALSE(ParseNdbcName("mhkit_jan2018_1d.txt").has_value());
  EXPECT_FALSE(ParseNdbcName("41010.spec").has_value());
  EXPECT_FALSE(ParseNdbcName("").has_value());
}

}  // namespace
}  // namespace onesea::ingest
