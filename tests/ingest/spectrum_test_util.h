#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "common/ingest/direction.h"
#include "common/ingest/file_bytes.h"
#include "common/ingest/spectrum_file.h"
#include "common/sea/statistics.h"

namespace onesea::ingest {

inline const std::string kSpectra = "tests/data/spectra/";
inline const std::string kStorm = "deploy/sessions/41010/41010w2019part.txt.gz";

inline sea::SpectrumStatistics StatisticsOf(const SpectrumRecord& record) {
  if (const auto* buoy = std::get_if<sea::BuoySpectrum>(&record.system)) {
    return sea::ComputeStatistics(*buoy);
  }
  return sea::ComputeStatistics(std::get<sea::GridSpectrum>(record.system));
}

inline double AngleBetweenDeg(double a_deg, double b_deg) {
  return std::abs(std::remainder(a_deg - b_deg, 360.0));
}

/// The bytes of a file that must be there, unpacked.
inline std::string Text(const std::string& path) {
  auto bytes = ReadFileBytes(path);
  EXPECT_TRUE(bytes.ok()) << bytes.status();
  if (!bytes.ok() || !IsGzip(*bytes)) return bytes.value_or("");
  auto text = InflateGzip(path, *bytes);
  EXPECT_TRUE(text.ok()) << text.status();
  return text.value_or("");
}

inline absl::StatusOr<std::vector<SpectrumRecord>> ParseText(std::string name, std::string text) {
  const NamedBytes file{std::move(name), std::move(text)};
  return ParseSpectrum(std::span(&file, 1));
}

/// The directions of a buoy's bands, as their file has them.
inline double FromDeg(float wave_to_rad) { return NauticalFromWaveTo(wave_to_rad); }

}  // namespace onesea::ingest
