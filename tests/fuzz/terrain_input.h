#pragma once

#include "absl/strings/string_view.h"

namespace onesea::fuzz {

/// Parses `text` as terrain in metres and in degrees, and checks that what comes back is valid.
/// Aborts where it is not.
void ParseTerrainAndCheck(absl::string_view text);

}  // namespace onesea::fuzz
