#pragma once

#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "common/sea/sea_state.h"
#include "onesea/v1/recipe.pb.h"

/// The shorthands of session and sea files: a spectrum file, Beaufort force, WMO sea-state code.
namespace onesea::wire {

/// Reads the spectrum file beside a session file. InvalidArgument if `folder` is empty (an RPC) or
/// the path leaves it.
absl::Status SystemFromFile(const v1::SpectrumFile& file, std::string_view prefix,
                            const std::string& folder, sea::WaveSystem& out);

/// Adds the system that `beaufort` or `wmo_sea_state` stands for. InvalidArgument if both are
/// given, or one beside explicit systems, or out of range. The waves travel with `wind`.
absl::Status ExpandShorthand(const v1::SeaState& proto, std::string_view prefix,
                             sea::SeaState& sea);

}  // namespace onesea::wire
