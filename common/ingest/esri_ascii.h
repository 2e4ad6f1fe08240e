#pragma once

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "common/ingest/raw_grid.h"

namespace onesea::ingest {

/// True if the first word is a key of the header.
bool LooksLikeEsriAscii(absl::string_view text);

/// See terrain_file.h.
absl::StatusOr<RawGrid> ParseEsriAscii(absl::string_view name, absl::string_view text);

}  // namespace onesea::ingest
