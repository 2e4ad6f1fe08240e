#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"

/// One of NDBC's spectral files, as numbers. The real-time and the historical form hold the same
/// table:
///
///   real time    2020 06 08 03 50 [0.225] 0.000 (0.033) 0.000 (0.038) ...      newest line first
///   historical   #YY MM DD hh mm  .0325  .0375 ...  /  2019 02 06 00 40  0.00  0.00 ...
namespace onesea::ingest {

/// What the numbers of a file are. Letters are those of historical file names.
enum class NdbcQuantity : char {
  kDensity = 'w',             ///< m²/Hz
  kMeanDirection = 'd',       ///< alpha1, degrees from
  kPrincipalDirection = 'i',  ///< alpha2, degrees from
  kR1 = 'j',
  kR2 = 'k'
};

/// What NDBC writes where it has no value.
inline constexpr float kNdbcMissing = 999.0F;

struct NdbcRow {
  std::string time_utc;
  int line = 0;                     ///< of the file, for errors
  std::vector<float> frequency_hz;  ///< (n) ascending, > 0; true band centres, not rounded labels
  std::vector<float> value;         ///< (n) as written, kNdbcMissing included
};

struct NdbcTable {
  std::string name;           ///< of the file
  std::vector<NdbcRow> rows;  ///< ascending time, each time once
};

/// True for the first line of a real-time file: "#YY MM DD hh mm Sep_Freq < spec_1 (freq_1) ...".
bool IsNdbcRealtimeHeader(absl::string_view line);
/// True for the first line of a historical file: "YY MM DD hh", "YYYY ..." or "#YY ...", mm or not,
/// frequencies.
bool IsNdbcHistoryHeader(absl::string_view line);

/// InvalidArgument with name, line and field.
absl::StatusOr<NdbcTable> ParseNdbcRealtime(absl::string_view name, absl::string_view text);
absl::StatusOr<NdbcTable> ParseNdbcHistory(absl::string_view name, absl::string_view text);

}  // namespace onesea::ingest
