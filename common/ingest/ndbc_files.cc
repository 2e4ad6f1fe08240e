#include "common/ingest/ndbc_files.h"

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/strip.h"
#include "common/base/check.h"

namespace onesea::ingest {
namespace {

constexpr std::size_t kStationLength = 5;

absl::string_view BaseName(absl::string_view path) {
  return path.substr(path.find_last_of('/') + 1);
}

absl::string_view Extension(NdbcQuantity quantity) {
  switch (quantity) {
    case NdbcQuantity::kDensity:
      return ".data_spec";
    case NdbcQuantity::kMeanDirection:
      return ".swdir";
    case NdbcQuantity::kPrincipalDirection:
      return ".swdir2";
    case NdbcQuantity::kR1:
      return ".swr1";
    case NdbcQuantity::kR2:
      return ".swr2";
  }
  ONESEA_CHECK(false) << "no such quantity";
  return {};
}

// Five letters or digits, the quantity's letter, a year of four digits.
bool IsHistoryName(absl::string_view base) {
  if (base.size() < kStationLength + 5) return false;
  for (const char c : base.substr(0, kStationLength)) {
    if (!absl::ascii_isalnum(static_cast<unsigned char>(c))) return false;
  }
  for (const char c : base.substr(kStationLength + 1, 4)) {
    if (!absl::ascii_isdigit(static_cast<unsigned char>(c))) return false;
  }
  return absl::StrContains("wdijk", base.substr(kStationLength, 1));
}

}  // namespace

std::optional<NdbcName> ParseNdbcName(absl::string_view path) {
  absl::string_view base = BaseName(path);
  if (IsHistoryName(base)) {
    return NdbcName{static_cast<NdbcQuantity>(base[kStationLength]),
                    std::string(base.substr(0, kStationLength)), true};
  }
  base = absl::StripSuffix(base, ".gz");
  for (const NdbcQuantity quantity : kNdbcQuantities) {
    if (absl::ConsumeSuffix(&base, Extension(quantity))) {
      return NdbcName{quantity, std::string(base), false};
    }
  }
  return std::nullopt;
}

std::string NdbcSibling(absl::string_view path, NdbcQuantity quantity) {
  const std::optional<NdbcName> name = ParseNdbcName(path);
  ONESEA_CHECK(name.has_value()) << path;
  const absl::string_view base = BaseName(path);
  std::string sibling(path.substr(0, path.size() - base.size()));
  if (name->is_history) {
    return absl::StrCat(sibling, name->station, std::string(1, static_cast<char>(quantity)),
                        base.substr(kStationLength + 1));
  }
  const absl::string_view end = absl::EndsWith(base, ".gz") ? ".gz" : "";
  return absl::StrCat(sibling, name->station, Extension(quantity), end);
}

}  // namespace onesea::ingest
