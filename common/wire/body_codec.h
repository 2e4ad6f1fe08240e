#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "common/base/sim_time.h"
#include "common/wire/body_state.h"

/// States of bodies as bytes (WIRE.md, "Bodies").
///
/// A position keeps its millimetre, a turn 0.01 degrees, velocities 1 mm/s and 1 mrad/s: some 25
/// bytes a body.
namespace onesea::wire {

struct SentBody {
  BodyState state;
  Tick age_ticks = 0;  ///< the state is that of so many ticks before the frame's
};

/// What a receiver gets of `state`. Velocities saturate at kBodySpeedMaxMPerS and
/// kBodySpinMaxRadPerS. Pre: finite, position within kQueryCoordinateMaxM.
BodyState Quantised(const BodyState& state);

/// Appends to `out`. Pre: as Quantised, ascending ids.
void AppendBodies(std::span<const SentBody> bodies, std::string& out);

/// InvalidArgument for bytes that AppendBodies does not write, more than kBodiesMax, or ids that do
/// not ascend.
absl::StatusOr<std::vector<SentBody>> ReadBodies(std::string_view bytes);

}  // namespace onesea::wire
