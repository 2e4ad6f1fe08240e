#include "common/sea/interaction_past.h"

namespace onesea::sea {

std::optional<InteractionMoment> FindMoment(const InteractionPast& past,
                                            const InteractionSnapshot& present, double tick,
                                            int tick_rate_hz) {
  const auto tick_of = [](const InteractionSnapshot& s) { return static_cast<double>(s.tick); };
  const InteractionSnapshot* after = &present;
  if (!(tick <= tick_of(present))) return std::nullopt;
  if (tick == tick_of(present)) return InteractionMoment{after, after, 0.0, 0.0};
  for (auto kept = past.rbegin(); kept != past.rend(); ++kept) {
    const InteractionSnapshot* before = kept->get();
    if (tick >= tick_of(*before)) {
      const double ticks = tick_of(*after) - tick_of(*before);
      if (tick == tick_of(*before)) return InteractionMoment{before, before, 0.0, 0.0};
      return InteractionMoment{before, after, (tick - tick_of(*before)) / ticks,
                               ticks / tick_rate_hz};
    }
    after = before;
  }
  return std::nullopt;
}

InteractionSample SampleInteraction(const InteractionMoment& moment, Vec2d place) {
  const InteractionSample a = SampleInteraction(*moment.before, place);
  if (moment.before == moment.after) return a;
  const InteractionSample b = SampleInteraction(*moment.after, place);
  const double t = moment.share, s = 1.0 - t;
  InteractionSample between;
  // Hermite's cubic.
  between.height_m = s * s * (1.0 + 2.0 * t) * a.height_m + t * t * (1.0 + 2.0 * s) * b.height_m +
                     moment.span_s * s * t * (s * a.velocity.z - t * b.velocity.z);
  between.slope = s * a.slope + t * b.slope;
  between.velocity = s * a.velocity + t * b.velocity;
  between.foam = s * a.foam + t * b.foam;
  return between;
}

}  // namespace onesea::sea
