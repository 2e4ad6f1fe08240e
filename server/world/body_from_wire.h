#pragma once

#include "absl/status/statusor.h"
#include "common/wire/body_description.h"
#include "common/wire/world_spec.h"
#include "server/world/body_loads.h"
#include "server/world/body_spec.h"

/// Bodies as the wire describes them <-> bodies that can be stepped.
namespace onesea::world {

/// InvalidArgument where the hull's file can't be read or something is missing: presets are filled
/// in before (body_presets.h). Cost: reads the mesh.
absl::StatusOr<BodySpec> FromWire(const wire::BodyDescription& description);

BodyState FromWire(const wire::Kinematics& kinematics);

/// What viewers are told of a body, but for its id. Pre: FromWire() took the description.
wire::BodyInfo InfoOf(const wire::BodyDescription& description, const BodyModel& model);

}  // namespace onesea::world
