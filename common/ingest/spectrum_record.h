#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/sea/sea_state.h"

namespace onesea::ingest {

/// The spectrum of one place at one time, as a file states it.
struct SpectrumRecord {
  std::string time_utc;  ///< "2019-02-10T05:40"; empty if the file states none
  std::string place;     ///< station, name or coordinates; empty if the file states none
  std::string format;    ///< for people: "NDBC historical, directional", "SWAN 2-D", ...
  std::optional<double> latitude_deg, longitude_deg;
  std::optional<double> depth_m;
  sea::WaveSystem system;  ///< a BuoySpectrum or a GridSpectrum
};

/// A file that was read before: `name` is for errors and to tell NDBC's five files apart.
struct NamedBytes {
  std::string name;
  std::string bytes;  ///< plain or gzip
};

}  // namespace onesea::ingest
