#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "common/sea/sea_state.h"
#include "onesea/v1/recipe.pb.h"

/// The shorthands of session and sea files: a spectrum file, Beaufort force, WMO sea-state code.
namespace onesea::wire {

/// Reads the record of a spectrum file beside a session file into `out`. InvalidArgument if
/// `folder` is empty (an RPC); what common/ingest says otherwise.
absl::Status SystemFromFile(const v1::SpectrumFile& file, std::string_view prefix,
                            const std::string& folder, sea::WaveSystem& out);

/// The sea that `beaufort` or `wmo_sea_state` stands for; nothing if neither is given.
/// InvalidArgument if both are, or one beside explicit systems, or out of range. The waves travel
/// with `wind`.
absl::StatusOr<std::optional<sea::SeaState>> SeaFromShorthand(const v1::SeaState& proto,
                                                              std::string_view prefix);

}  // namespace onesea::wire
