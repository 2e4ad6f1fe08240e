#pragma once

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "common/ingest/raw_grid.h"

namespace onesea::ingest {

/// See terrain_file.h. Points may be off their place on the grid by a tenth of its spacing.
absl::StatusOr<RawGrid> ParseXyz(absl::string_view name, absl::string_view text);

}  // namespace onesea::ingest
