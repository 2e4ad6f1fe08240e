#include "tests/fuzz/spectrum_input.h"

#include <algorithm>
#include <variant>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/ingest/spectrum_file.h"
#include "common/ingest/utc_time.h"
#include "common/sea/statistics.h"

namespace onesea::fuzz {
namespace {

constexpr absl::string_view kMark = "\n%% ";

bool Ascends(const std::vector<float>& values) {
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (!(values[i] > values[i - 1])) return false;
  }
  return true;
}

bool AllWithin(const std::vector<float>& values, float min, float max) {
  for (const float value : values) {
    if (!(value >= min && value <= max)) return false;
  }
  return true;
}

void CheckFrequencies(const std::vector<float>& frequency_hz) {
  ONESEA_CHECK(frequency_hz.size() >= 2 && frequency_hz.size() <= kSpectrumFrequenciesMax);
  ONESEA_CHECK(Ascends(frequency_hz) && frequency_hz.front() > 0.0F);
}

void Check(const sea::BuoySpectrum& buoy) {
  const std::size_t n = buoy.frequency_hz.size();
  CheckFrequencies(buoy.frequency_hz);
  ONESEA_CHECK(buoy.density_m2_per_hz.size() == n);
  ONESEA_CHECK(AllWithin(buoy.density_m2_per_hz, 0.0F, 1e6F));
  const std::size_t directional = buoy.mean_wave_to_rad.size();
  ONESEA_CHECK(directional == 0 || directional == n);
  ONESEA_CHECK(buoy.principal_wave_to_rad.size() == directional);
  ONESEA_CHECK(buoy.r1.size() == directional && buoy.r2.size() == directional);
  ONESEA_CHECK(AllWithin(buoy.r1, 0.0F, 1.0F) && AllWithin(buoy.r2, 0.0F, 1.0F));
  ONESEA_CHECK(AllWithin(buoy.mean_wave_to_rad, 0.0F, 6.2832F));
  ONESEA_CHECK(AllWithin(buoy.principal_wave_to_rad, 0.0F, 6.2832F));
}

void Check(const sea::GridSpectrum& grid) {
  CheckFrequencies(grid.frequency_hz);
  ONESEA_CHECK(grid.wave_to_rad.size() >= 2 && grid.wave_to_rad.size() <= kSpectrumDirectionsMax);
  ONESEA_CHECK(Ascends(grid.wave_to_rad) && AllWithin(grid.wave_to_rad, 0.0F, 6.2832F));
  ONESEA_CHECK(grid.density_m2_per_hz_rad.size() ==
               grid.frequency_hz.size() * grid.wave_to_rad.size());
  ONESEA_CHECK(AllWithin(grid.density_m2_per_hz_rad, 0.0F, 1e6F));
}

template <typename Spectrum>
void CheckAll(const Spectrum& spectrum) {
  Check(spectrum);
  const double hs_m = sea::ComputeStatistics(spectrum).hs_m;
  ONESEA_CHECK(hs_m >= 0.0 && hs_m <= kHsMaxM) << hs_m;
}

}  // namespace

std::vector<ingest::NamedBytes> SplitFiles(absl::string_view input) {
  std::vector<ingest::NamedBytes> files;
  const std::size_t first = std::min(input.find(kMark), input.size());
  files.push_back({"41010w2019.txt", std::string(input.substr(0, first))});
  input.remove_prefix(first);
  while (!input.empty()) {
    input.remove_prefix(kMark.size());
    const std::size_t name_end = std::min(input.find('\n'), input.size());
    const std::string name(input.substr(0, name_end));
    input.remove_prefix(std::min(name_end + 1, input.size()));
    const std::size_t end = std::min(input.find(kMark), input.size());
    files.push_back({name, std::string(input.substr(0, end))});
    input.remove_prefix(end);
  }
  return files;
}

std::string JoinFiles(const std::vector<ingest::NamedBytes>& files) {
  std::string joined = files.front().bytes;
  for (std::size_t i = 1; i < files.size(); ++i) {
    absl::StrAppend(&joined, kMark, files[i].name, "\n", files[i].bytes);
  }
  return joined;
}

void ParseAndCheck(const std::vector<ingest::NamedBytes>& files) {
  const auto records = ingest::ParseSpectrum(files);
  if (!records.ok()) {
    ONESEA_CHECK(!records.status().message().empty());
    return;
  }
  ONESEA_CHECK(!records->empty());
  for (const ingest::SpectrumRecord& record : *records) {
    ONESEA_CHECK(record.time_utc.empty() || ingest::ParseUtc(record.time_utc).has_value());
    if (const auto* buoy = std::get_if<sea::BuoySpectrum>(&record.system)) {
      CheckAll(*buoy);
    } else {
      CheckAll(std::get<sea::GridSpectrum>(record.system));
    }
  }
}

}  // namespace onesea::fuzz
