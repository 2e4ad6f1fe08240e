#pragma once

#include <optional>
#include <string>
#include <vector>

#include "absl/strings/string_view.h"
#include "common/ingest/ndbc_table.h"

/// How NDBC names the five files of one station, with or without a final ".gz":
///   41010.data_spec .swdir .swdir2 .swr1 .swr2     real time
///   41010w2019.txt, and d, i, j, k in place of w   historical
namespace onesea::ingest {

struct NdbcName {
  NdbcQuantity quantity = NdbcQuantity::kDensity;
  std::string station;
  bool is_history = false;
};

/// Nothing if it is no such name. Folders in front are passed over.
std::optional<NdbcName> ParseNdbcName(absl::string_view path);

/// The path of the file of the same set that holds `quantity`; `path` must be an NDBC name.
std::string NdbcSibling(absl::string_view path, NdbcQuantity quantity);

inline constexpr NdbcQuantity kNdbcQuantities[] = {
    NdbcQuantity::kDensity, NdbcQuantity::kMeanDirection, NdbcQuantity::kPrincipalDirection,
    NdbcQuantity::kR1, NdbcQuantity::kR2};

}  // namespace onesea::ingest
