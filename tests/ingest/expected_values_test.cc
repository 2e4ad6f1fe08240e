// Every spectrum of tests/data/spectra/expected_values.csv, whose figures an independent program
// computed from the same files.

#include <fstream>
#include <map>
#include <optional>

#include "absl/strings/numbers.h"
#include "tests/ingest/spectrum_test_util.h"

namespace onesea::ingest {
namespace {

// Fields may be quoted, since places hold a comma.
std::vector<std::string> SplitCsv(const std::string& line) {
  std::vector<std::string> fields(1);
  bool is_quoted = false;
  for (const char c : line) {
    if (c == '"') {
      is_quoted = !is_quoted;
    } else if (c == ',' && !is_quoted) {
      fields.emplace_back();
    } else {
      fields.back().push_back(c);
    }
  }
  return fields;
}

using Row = std::map<std::string, std::string>;

std::vector<Row> ExpectedRows() {
  std::ifstream stream(kSpectra + "expected_values.csv");
  std::string line;
  std::getline(stream, line);
  const std::vector<std::string> header = SplitCsv(line);
  std::vector<Row> rows;
  while (std::getline(stream, line)) {
    const std::vector<std::string> fields = SplitCsv(line);
    Row row;
    for (std::size_t i = 0; i < header.size(); ++i) row[header[i]] = fields.at(i);
    rows.push_back(row);
  }
  return rows;
}

std::optional<double> Number(const Row& row, const std::string& name) {
  double value = 0.0;
  if (!absl::SimpleAtod(row.at(name), &value)) return std::nullopt;
  return value;
}

// Heights to 0.5 %, directions to 2 degrees. Periods: the reference sums NDBC's bands where ours
// are trapezoids of centres that are half a millihertz truer, which is worth up to 1.5 %.
void ExpectSame(const sea::SpectrumStatistics& s, const Row& row) {
  const auto near = [&](const std::string& name, double value, double relative) {
    const double expected = Number(row, name).value();
    EXPECT_NEAR(value, expected, relative * expected) << name;
  };
  near("hs_m", s.hs_m, 0.005);
  near("tp_s", s.tp_s, 0.012);
  near("tp_parabola_s", s.tp_parabola_s, 0.015);
  near("tm01_s", s.tm01_s, 0.015);
  near("tm02_s", s.tm02_s, 0.015);
  near("te_s", s.te_s, 0.015);
  const std::optional<double> mean_from_deg = Number(row, "mean_from_deg");
  ASSERT_EQ(s.has_direction, mean_from_deg.has_value());
  if (!mean_from_deg) return;
  EXPECT_LT(AngleBetweenDeg(NauticalFromWaveTo(s.mean_wave_to_rad), *mean_from_deg), 2.0);
  EXPECT_NEAR(s.spread_rad / kRadPerDeg, Number(row, "spread_deg").value(), 2.0);
  EXPECT_LT(
      AngleBetweenDeg(NauticalFromWaveTo(s.peak_wave_to_rad), Number(row, "peak_from_deg").value()),
      2.0);
}

TEST(ExpectedValues, HoldForEveryRecord) {
  const std::vector<Row> rows = ExpectedRows();
  ASSERT_EQ(rows.size(), 31U);
  std::string path;
  std::vector<SpectrumRecord> records;
  for (const Row& row : rows) {
    SCOPED_TRACE(row.at("file") + " " + row.at("time_utc") + " " + row.at("place"));
    if (row.at("file") != path) {
      path = row.at("file");
      auto read = ReadSpectrumFile(path);
      ASSERT_TRUE(read.ok()) << read.status();
      records = *std::move(read);
    }
    const auto record = FindRecord(records, row.at("time_utc"), row.at("place"));
    ASSERT_TRUE(record.ok()) << record.status();
    ExpectSame(StatisticsOf(**record), row);
  }
}

// SWAN's own table of the same run: Hs there includes the tail above the last frequency.
TEST(ExpectedValues, SwanStatesTheSameSeaItself) {
  const auto records = ReadSpectrumFile(kSpectra + "swanfile.spec");
  ASSERT_TRUE(records.ok()) << records.status();
  const double hs_m[] = {1.71903, 2.76712, 2.92970, 2.67841, 4.26364};
  const double mean_from_deg[] = {250.226, 264.233, 255.912, 266.949, 254.099};
  const double peak_from_deg[] = {249.091, 252.339, 251.593, 249.865, 251.603};
  const double tp_s[] = {12.9023, 14.5011, 15.1047, 13.1753, 12.9766};
  ASSERT_EQ(records->size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    const sea::SpectrumStatistics s = StatisticsOf((*records)[i]);
    EXPECT_NEAR(s.hs_m, hs_m[i], 0.005 * hs_m[i]);
    EXPECT_NEAR(s.tp_parabola_s, tp_s[i], 0.001 * tp_s[i]);
    EXPECT_LT(AngleBetweenDeg(NauticalFromWaveTo(s.mean_wave_to_rad), mean_from_deg[i]), 0.5);
    EXPECT_LT(AngleBetweenDeg(NauticalFromWaveTo(s.peak_wave_to_rad), peak_from_deg[i]), 0.5);
  }
}

}  // namespace
}  // namespace onesea::ingest
