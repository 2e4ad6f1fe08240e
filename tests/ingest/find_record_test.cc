// Which record a person means, and what is said if there is none.

#include <filesystem>
#include <fstream>

#include "gmock/gmock.h"
#include "tests/ingest/spectrum_test_util.h"

namespace onesea::ingest {
namespace {

using testing::HasSubstr;

TEST(FindRecord, FindsTheStorm) {
  const auto records = ReadSpectrumFile(kStorm);
  ASSERT_TRUE(records.ok()) << records.status();
  EXPECT_EQ(records->size(), 99U);
  for (const char* time : {"2019-02-10T05:40", "2019-02-10 05:40", "2019-02-10T05:40:00Z"}) {
    const auto record = FindRecord(*records, time);
    ASSERT_TRUE(record.ok()) << record.status();
    EXPECT_NEAR(StatisticsOf(**record).hs_m, 4.7097, 0.02);
    EXPECT_EQ((*record)->format, "NDBC historical, directional");
  }
}

TEST(FindRecord, ListsTheNearestTimes) {
  const auto records = ReadSpectrumFile(kStorm);
  ASSERT_TRUE(records.ok()) << records.status();
  const absl::Status status = FindRecord(*records, "2019-02-10T05:45").status();
  EXPECT_EQ(status.code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(std::string(status.message()),
              HasSubstr("no record at 2019-02-10T05:45; nearest: 2019-02-10T03:40, "
                        "2019-02-10T04:40, 2019-02-10T05:40, 2019-02-10T06:40, 2019-02-10T07:40 "
                        "(99 times from 2019-02-06T00:40 to "));
  EXPECT_THAT(std::string(FindRecord(*records, "").status().message()),
              HasSubstr("time: must be given; there are 99 times from "));
  EXPECT_EQ(FindRecord(*records, "yesterday").status().code(), absl::StatusCode::kInvalidArgument);
}

TEST(FindRecord, NothingInNothing) {
  EXPECT_EQ(FindRecord({}, "2019-02-10T05:45").status().code(), absl::StatusCode::kNotFound);
}

TEST(ReadSpectrumFile, FindsSiblingsPackedOrNot) {
  const auto plain = ReadSpectrumFile(kSpectra + "41010.swr2");
  ASSERT_TRUE(plain.ok()) << plain.status();
  EXPECT_EQ(plain->front().format, "NDBC real-time, directional");
  const std::string folder = testing::TempDir() + "/onesea_siblings/";
  std::filesystem::create_directories(folder);
  const auto copy = std::filesystem::copy_options::overwrite_existing;
  const std::string packed = "deploy/sessions/41010/41010";
  std::filesystem::copy_file(packed + "w2019part.txt.gz", folder + "41010w2019part.txt.gz", copy);
  EXPECT_EQ(ReadSpectrumFile(folder + "41010w2019part.txt.gz")->front().format,
            "NDBC historical, 1-D");
  for (const char letter : {'d', 'i', 'j', 'k'}) {
    const std::string name = std::string(1, letter) + "2019part.txt";
    std::ofstream(folder + "41010" + name) << Text(packed + name + ".gz");
  }
  EXPECT_EQ(ReadSpectrumFile(folder + "41010w2019part.txt.gz")->front().format,
            "NDBC historical, directional");
  std::filesystem::remove_all(folder);
}

TEST(ReadSpectrumFile, UnknownFilesAreRefusedWithAReason) {
  EXPECT_EQ(ReadSpectrumFile("no/such/file").status().code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(std::string(ReadSpectrumFile("LICENSE").status().message()),
              HasSubstr("is none of: NDBC"));
  EXPECT_THAT(std::string(ParseText("w.nc", "CDF\x01...").status().message()),
              HasSubstr("netCDF is not read"));
  EXPECT_THAT(std::string(ParseText("empty", " \n\n").status().message()), HasSubstr("is empty"));
  EXPECT_FALSE(ParseSpectrum({}).ok());
}

}  // namespace
}  // namespace onesea::ingest
