#pragma once

#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "common/wire/body_description.h"

/// Ready-made bodies, of nobody's real make.
namespace onesea::wire {

/// boat (6 x 2.2 m, 1.9 t, outboard motor that steers), crate (1 m, 350 kg), buoy (1.2 m across,
/// 500 kg, weight low), raft (4 x 3 m). NotFound naming those that there are.
absl::StatusOr<BodyDescription> BodyKind(std::string_view kind);

/// "boat, buoy, crate, raft"
std::string BodyKindNames();

}  // namespace onesea::wire
