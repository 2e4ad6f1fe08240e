#include "client/app/spray_bursts.h"

namespace onesea::client {

void SprayBursts::Add(const std::vector<wire::Spray>& events, SimTime time) {
  for (const wire::Spray& event : events) {
    bursts_.push_back(
        {{event.position_m, event.velocity_m_per_s, event.mass_kg, 0.0, next_seed_++}, time});
  }
  while (bursts_.size() > render::kRenderSprayMax) bursts_.pop_front();
}

std::vector<render::SprayBurst> SprayBursts::At(SimTime time) {
  while (!bursts_.empty() && (time - bursts_.front().born).Seconds() >= render::kSprayLifeS) {
    bursts_.pop_front();
  }
  std::vector<render::SprayBurst> flying;
  for (const Burst& burst : bursts_) {
    // Frames are drawn a little after the moment that they show: an event may be yet to come.
    const double age_s = (time - burst.born).Seconds();
    if (age_s < 0.0) continue;
    flying.push_back(burst.burst);
    flying.back().age_s = age_s;
  }
  return flying;
}

}  // namespace onesea::client
