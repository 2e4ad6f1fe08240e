#pragma once

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "server/world/body_spec.h"

/// Bodies with sensible figures, of nobody's real make.
///
///   motor-boat  5.0 x 2.0 m, 450 kg, outboard motor that steers, planes
///   work-boat   10 x 3.4 m, 9 t, propeller and rudder behind it
///   buoy        1.2 m across, 500 kg, weight low
///   crate       1 x 1 x 0.8 m, 240 kg
///   raft        3 x 2 x 0.3 m, 400 kg
namespace onesea::world {

/// NotFound naming those that there are.
absl::StatusOr<BodySpec> BodyPreset(absl::string_view name);

}  // namespace onesea::world
