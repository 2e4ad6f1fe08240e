#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"

/// Bytes of a file, plain or gzip, within kReadFileBytesMax both before and after
/// decompression.
namespace onesea::ingest {

/// The raw bytes. NotFound; InvalidArgument if it is no regular file or too large; Unavailable if
/// it can't be read.
absl::StatusOr<std::string> ReadFileBytes(const std::string& path);

bool IsGzip(absl::string_view bytes);

/// All members of a gzip file, one after the other. InvalidArgument naming `name` if it is damaged,
/// cut or too large.
absl::StatusOr<std::string> InflateGzip(absl::string_view name, absl::string_view bytes);

}  // namespace onesea::ingest
