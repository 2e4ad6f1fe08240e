#pragma once

#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "common/wire/session_spec.h"

/// Session and sea files: the text form of onesea.v1.SessionSpec and onesea.v1.SeaState, with
/// shorthands expanded (Beaufort, WMO code, `file { path time }` read through common/ingest
/// relative to the file's folder).
namespace onesea::wire {

/// NotFound, or InvalidArgument with file, line, field, value and limit.
absl::StatusOr<SessionSpec> ReadSessionFile(const std::string& path);
absl::StatusOr<sea::SeaState> ReadSeaFile(const std::string& path);

/// The same from text; `folder` is where relative paths begin, empty: files are refused.
absl::StatusOr<SessionSpec> ParseSessionText(std::string_view text, const std::string& folder);
absl::StatusOr<sea::SeaState> ParseSeaText(std::string_view text, const std::string& folder);

}  // namespace onesea::wire
