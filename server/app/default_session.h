#pragma once

#include <string>

#include "absl/status/statusor.h"

namespace onesea::server {

/// The path of the session that runs when none is named: deploy/sessions/storm-41010.textproto
/// below the present folder, above the program (a build tree), or share/onesea/sessions beside the
/// program's folder (an install tree). NotFound with the places that were tried.
absl::StatusOr<std::string> FindDefaultSession();

}  // namespace onesea::server
