#include "common/ingest/spectrum_file.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/strip.h"
#include "common/base/check.h"
#include "common/ingest/file_bytes.h"
#include "common/ingest/ndbc_files.h"
#include "common/ingest/ndbc_spectrum.h"
#include "common/ingest/ndbc_table.h"
#include "common/ingest/swan_spectrum.h"
#include "common/ingest/text_lines.h"
#include "common/ingest/ww3_spectrum.h"

namespace onesea::ingest {
namespace {

using Records = std::vector<SpectrumRecord>;

std::string WithoutGz(absl::string_view name) {
  return std::string(absl::StripSuffix(name, ".gz"));
}

NdbcTable& TableOf(NdbcTables& tables, NdbcQuantity quantity) {
  switch (quantity) {
    case NdbcQuantity::kMeanDirection:
      return tables.mean_direction;
    case NdbcQuantity::kPrincipalDirection:
      return tables.principal_direction;
    case NdbcQuantity::kR1:
      return tables.r1;
    case NdbcQuantity::kR2:
      return tables.r2;
    case NdbcQuantity::kDensity:
      break;
  }
  return tables.density;
}

absl::StatusOr<Records> ParseNdbc(std::span<const NamedBytes> files, bool is_history) {
  NdbcTables tables;
  tables.is_history = is_history;
  const std::string& named = files.front().name;
  const std::optional<NdbcName> set = ParseNdbcName(named);
  bool has_density = false;
  for (const NdbcQuantity quantity : kNdbcQuantities) {
    // A name that tells nothing stands for one file of densities.
    const std::string wanted = set ? NdbcSibling(named, quantity) : named;
    if (!set && quantity != NdbcQuantity::kDensity) continue;
    const auto file = std::find_if(files.begin(), files.end(), [&](const NamedBytes& f) {
      return WithoutGz(f.name) == WithoutGz(wanted);
    });
    if (file == files.end()) continue;
    auto table = is_history ? ParseNdbcHistory(file->name, file->bytes)
                            : ParseNdbcRealtime(file->name, file->bytes);
    if (!table.ok()) return table.status();
    TableOf(tables, quantity) = *std::move(table);
    has_density |= quantity == NdbcQuantity::kDensity;
  }
  if (!has_density) {
    return absl::NotFoundError(absl::StrCat(named, ": the density file ",
                                            NdbcSibling(named, NdbcQuantity::kDensity),
                                            " that belongs to it is missing"));
  }
  return JoinNdbcTables(tables, set ? set->station : "");
}

absl::Status UnknownFormat(absl::string_view name, absl::string_view text) {
  if (absl::StartsWith(text, "CDF") || absl::StartsWith(text, "\x89HDF")) {
    return FileError(name, 0, "format", "netCDF is not read; take the ASCII form");
  }
  return FileError(name, 0, "format",
                   "is none of: NDBC real time or historical, WAVEWATCH III point spectra, SWAN "
                   "spectral file");
}

absl::StatusOr<Records> ParseByFirstLine(std::span<const NamedBytes> files) {
  const std::string& name = files.front().name;
  const std::string& text = files.front().bytes;
  TextLines lines(name, text);
  if (!lines.NextNotBlank()) return FileError(name, 0, "file", "is empty");
  const absl::string_view first = lines.line();
  if (IsSwanHeader(first)) return ParseSwanSpectra(name, text);
  if (IsWw3Header(first)) return ParseWw3Spectra(name, text);
  if (IsNdbcRealtimeHeader(first)) return ParseNdbc(files, false);
  if (IsNdbcHistoryHeader(first)) return ParseNdbc(files, true);
  if (absl::StrContains(first, "WVHT")) {
    return FileError(name, 1, "format",
                     "is NDBC's summary, which holds no spectra; take the .data_spec file");
  }
  return UnknownFormat(name, text);
}

// The readers check what they can place in a line; this is the contract with everything after.
absl::Status Validate(absl::string_view name, SpectrumRecord& record) {
  sea::SeaState sea;
  sea.systems.push_back(std::move(record.system));
  absl::Status status = sea::ValidateSeaState(sea, "");
  record.system = std::move(sea.systems.front());
  if (status.ok()) return status;
  return FileError(name, 0, absl::StrCat("record ", record.time_utc), status.message());
}

absl::StatusOr<NamedBytes> ReadWithOrWithoutGz(const std::string& path) {
  const std::string plain = WithoutGz(path);
  const std::string other = plain == path ? absl::StrCat(path, ".gz") : plain;
  for (const std::string& candidate : {path, other}) {
    absl::StatusOr<std::string> bytes = ReadFileBytes(candidate);
    if (bytes.ok()) return NamedBytes{candidate, *std::move(bytes)};
    if (!absl::IsNotFound(bytes.status())) return bytes.status();
  }
  return absl::NotFoundError(absl::StrCat(path, ": no such file"));
}

}  // namespace

absl::StatusOr<Records> ReadSpectrumFile(const std::string& path) {
  std::vector<NamedBytes> files(1);
  files[0].name = path;
  ONESEA_ASSIGN_OR_RETURN(files[0].bytes, ReadFileBytes(path));
  const std::optional<NdbcName> name = ParseNdbcName(path);
  for (const NdbcQuantity quantity : kNdbcQuantities) {
    if (!name || quantity == name->quantity) continue;
    auto sibling = ReadWithOrWithoutGz(NdbcSibling(path, quantity));
    if (sibling.ok()) {
      files.push_back(*std::move(sibling));
    } else if (!absl::IsNotFound(sibling.status())) {
      return sibling.status();
    }
  }
  return ParseSpectrum(files);
}

absl::StatusOr<Records> ParseSpectrum(std::span<const NamedBytes> files) {
  if (files.empty()) return absl::InvalidArgumentError("no file is given");
  std::vector<NamedBytes> texts(files.begin(), files.end());
  for (NamedBytes& file : texts) {
    if (!IsGzip(file.bytes)) continue;
    ONESEA_ASSIGN_OR_RETURN(file.bytes, InflateGzip(file.name, file.bytes));
  }
  ONESEA_ASSIGN_OR_RETURN(Records records, ParseByFirstLine(texts));
  if (records.empty()) return FileError(files[0].name, 0, "file", "holds no record with waves");
  for (SpectrumRecord& record : records) {
    ONESEA_RETURN_IF_ERROR(Validate(files[0].name, record));
  }
  std::stable_sort(
      records.begin(), records.end(),
      [](const SpectrumRecord& a, const SpectrumRecord& b) { return a.time_utc < b.time_utc; });
  return records;
}

}  // namespace onesea::ingest
