#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "common/sea/interaction_field.h"

/// The interaction layer at moments that are over.
///
/// Snapshots are kept at some ticks only. Between two of them heights follow the cubic with the
/// heights and the vertical velocities of both ends: of a wave of frequency ω kept every Δ its
/// error is (ωΔ)⁴/384 of the amplitude, 2e-5 for a wave of 2 s kept ten times a second. Slopes,
/// velocities and foam are linear in between: (ωΔ)²/8, 1.2 % of the same wave.
namespace onesea::sea {

/// Ascending ticks, each with velocities.
using InteractionPast = std::vector<std::shared_ptr<const InteractionSnapshot>>;

/// A moment within what is kept; points into it.
struct InteractionMoment {
  const InteractionSnapshot* before = nullptr;
  const InteractionSnapshot* after = nullptr;  ///< may be the same
  double share = 0.0;                          ///< of the way from one to the other, [0, 1]
  double span_s = 0.0;                         ///< between them
};

/// `tick` may lie between ticks. None where it is older than what is kept or later than `present`.
std::optional<InteractionMoment> FindMoment(const InteractionPast& past,
                                            const InteractionSnapshot& present, double tick,
                                            int tick_rate_hz);

/// Cost: two of SampleInteraction(snapshot), one where the moment is that of a snapshot.
InteractionSample SampleInteraction(const InteractionMoment& moment, Vec2d place);

}  // namespace onesea::sea
