#pragma once

#include <memory>
#include <span>
#include <vector>

#include "common/base/sim_time.h"
#include "common/sea/interaction_field.h"
#include "common/wire/body_encoder.h"
#include "common/wire/world_command.h"
#include "server/query/query_engine.h"

/// Virtual instruments: what they read of a session at one tick.
namespace onesea::server {

/// A session at a tick. What is pointed to lives as long as the call that gets it.
struct InstrumentMoment {
  Tick tick = 0;
  std::shared_ptr<const sea::Components> components;
  const sea::InteractionSnapshot* interaction = nullptr;  ///< at `tick`
  std::span<const wire::WaterLevel> water_level;          ///< of the session, over all time
  std::span<const wire::BodyView> bodies;                 ///< ascending ids
  std::span<const wire::BodyView> before;                 ///< a tick earlier
};

/// All instruments' values, in their order (wire::ValueCount each). NaN of a body that isn't there,
/// or for an Imu wasn't there a tick ago.
///
/// Wave gauge: the height that QueryPoints answers for that place and tick.
/// Pressure, above the atmosphere's: rho g d + linear theory's dynamic pressure (the exact sum of
/// sea::SampleAtDepth) + rho g times the interaction layer's height, which isn't taken to fade with
/// depth; d is counted from the level. Between level and surface, in a crest: rho g times the depth
/// below the surface. 0 in the air and on land. Under troughs linear theory is off by second order.
/// Imu: specific force f = R' (a - g), a = dv/dt + dw/dt x r + w x (w x r), the rates being
/// differences over the last tick; so (0, 0, +9.81) at rest and 0 in free fall.
///
/// Pre: validated. Cost: a snapshot a tick if there are gauges (shared with queries), and 15 µs a
/// pressure gauge. For one thread.
class InstrumentReader {
 public:
  explicit InstrumentReader(std::vector<wire::Instrument> instruments);

  std::vector<double> Read(QueryEngine& engine, const InstrumentMoment& moment);

 private:
  void ReadGauges(QueryEngine& engine, const InstrumentMoment& moment);
  void ReadPressures(const sea::SeaSnapshot& snapshot, const InstrumentMoment& moment,
                     const wire::QueryAnswer& surface);

  struct Gauge {
    std::size_t value = 0;      // index of its value
    bool pressure = false;      // else a wave gauge
    std::uint32_t body_id = 0;  // of a pressure gauge; 0: fixed to the world
    Vec3d position_m;
    Vec3d place_m;  // in the world, now
  };
  std::vector<wire::Instrument> instruments_;
  std::vector<Gauge> gauges_;
  std::size_t value_count_ = 0;
  std::vector<double> values_;
};

}  // namespace onesea::server
