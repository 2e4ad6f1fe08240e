// onesea spectrum: figures, tables, JSON, errors and the picture file.

#include "client/app/spectrum_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace onesea::app {
namespace {

using testing::HasSubstr;
using testing::Not;

const char kStorm[] = "deploy/sessions/41010/41010w2019part.txt.gz";

struct With {
  std::string path, time = {}, place = {};
  bool json = false;
  std::string png_path = {};

  operator SpectrumOptions() const { return {path, time, place, json, png_path}; }
};

std::string Show(const SpectrumOptions& options) {
  std::ostringstream out;
  const absl::Status status = RunSpectrum(options, out);
  EXPECT_TRUE(status.ok()) << status;
  return out.str();
}

absl::Status Fail(const SpectrumOptions& options) {
  std::ostringstream out;
  const absl::Status status = RunSpectrum(options, out);
  EXPECT_EQ(out.str(), "");
  return status;
}

double JsonNumber(const std::string& json, const std::string& key) {
  const std::size_t at = json.find("\"" + key + "\":");
  EXPECT_NE(at, std::string::npos) << key << " in " << json;
  return at == std::string::npos ? 0.0 : std::atof(json.c_str() + at + key.size() + 3);
}

// Figures from tests/data/spectra/expected_values.csv.
TEST(SpectrumCommand, OneRecordAsJson) {
  const std::string json = Show(With{.path = kStorm, .time = "2019-02-10T05:40", .json = true});
  EXPECT_THAT(json, HasSubstr(R"({"time":"2019-02-10T05:40","place":"41010",)"));
  EXPECT_NEAR(JsonNumber(json, "hs_m"), 4.7097, 0.005 * 4.7097);
  EXPECT_NEAR(JsonNumber(json, "tp_s"), 10.0, 1e-6);
  EXPECT_NEAR(JsonNumber(json, "tm02_s"), 7.719, 0.015 * 7.719);
  EXPECT_NEAR(JsonNumber(json, "mean_direction_deg"), 42.8, 2.0);
  EXPECT_NEAR(JsonNumber(json, "spread_deg"), 33.8, 2.0);
}

TEST(SpectrumCommand, OneRecordForPeople) {
  const std::string text = Show(With{.path = kStorm, .time = "2019-02-10 05:40Z"});
  EXPECT_THAT(text, HasSubstr("41010   2019-02-10 05:40 UTC   (NDBC historical, directional)"));
  EXPECT_THAT(text, HasSubstr("Hs        4.71 m"));
  EXPECT_THAT(text, HasSubstr("from        43 °  (NE)"));
}

TEST(SpectrumCommand, AllRecordsAreATable) {
  const std::string text = Show(With{.path = kStorm});
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 99);
  EXPECT_THAT(text, HasSubstr("2019-02-10T05:40  41010    4.71   10.00      7.70        43"));
}

TEST(SpectrumCommand, AllRecordsAsJsonAreAnArray) {
  const std::string json = Show(With{.path = kStorm, .json = true});
  EXPECT_EQ(json.front(), '[');
  EXPECT_EQ(json.substr(json.size() - 3), "}]\n");
  std::size_t count = 0;
  for (std::size_t at = json.find("\"hs_m\""); at != std::string::npos;
       at = json.find("\"hs_m\"", at + 1)) {
    ++count;
  }
  EXPECT_EQ(count, 99U);
}

TEST(SpectrumCommand, OneDimensionalFilesHaveNoDirection) {
  const std::string path = "tests/data/spectra/44004w2000.txt";
  const std::string json = Show(With{.path = path, .time = "2000-01-01T01:00", .json = true});
  EXPECT_THAT(json, HasSubstr(R"("mean_direction_deg":null,"spread_deg":null)"));
  EXPECT_THAT(Show(With{.path = path, .time = "2000-01-01T01:00"}), HasSubstr("no directions"));
}

TEST(SpectrumCommand, FileWithoutTimesIsOneRecord) {
  const std::string json = Show(With{.path = "tests/data/spectra/f31har01.bnd", .json = true});
  EXPECT_THAT(json, HasSubstr(R"({"time":null,)"));
}

TEST(SpectrumCommand, PlacesAreChosenByName) {
  const std::string path = "tests/data/spectra/swanhot.spec";
  const std::string all = Show(With{.path = path, .time = "2024-06-24T18:00"});
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 1 + 208);
  const std::string one = Show(With{.path = path, .place = "165,-47", .json = true});
  EXPECT_NEAR(JsonNumber(one, "hs_m"), 2.9789, 0.005 * 2.9789);
  EXPECT_THAT(one, Not(HasSubstr("[")));
  EXPECT_EQ(Fail(With{.path = path, .place = "nowhere"}).code(), absl::StatusCode::kNotFound);
}

TEST(SpectrumCommand, ErrorsSayWhatToDo) {
  EXPECT_THAT(std::string(Fail(With{.path = kStorm, .time = "2019-02-10T05:41"}).message()),
              HasSubstr("nearest: 2019-02-10T03:40"));
  EXPECT_EQ(Fail(With{.path = kStorm, .time = "now"}).code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(Fail(With{.path = "no/such/file"}).code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(Fail(With{.path = "LICENSE"}).code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(Fail(With{.path = kStorm, .png_path = "x.png"}).message()),
              HasSubstr("time: must be given"));
  EXPECT_EQ(
      Fail(With{.path = kStorm, .time = "2019-02-10T05:40", .png_path = "no/such/folder/x.png"})
          .code(),
      absl::StatusCode::kUnavailable);
}

TEST(SpectrumCommand, DrawsAPng) {
  const std::string path = testing::TempDir() + "/onesea_spectrum_test.png";
  Show(With{.path = kStorm, .time = "2019-02-10T05:40", .png_path = path});
  std::ifstream stream(path, std::ios::binary);
  std::string head(24, '\0');
  stream.read(head.data(), 24);
  EXPECT_EQ(head.substr(0, 8), "\x89PNG\r\n\x1a\n");
  // The size, big-endian, in the first chunk: 1200 x 1080.
  EXPECT_EQ(head.substr(16, 8), std::string("\0\0\x04\xb0\0\0\x04\x38", 8));
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace onesea::app
