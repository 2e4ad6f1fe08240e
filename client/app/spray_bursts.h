#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "client/render/render_frame.h"
#include "common/base/sim_time.h"
#include "common/wire/world_update.h"

namespace onesea::client {

/// Remembers bursts of spray for as long as they fly. One thread.
class SprayBursts {
 public:
  /// Events that came with a frame of `time`; beyond kRenderSprayMax the oldest are dropped.
  void Add(const std::vector<wire::Spray>& events, SimTime time);

  /// What flies at `time`; forgets what is over by then.
  std::vector<render::SprayBurst> At(SimTime time);

 private:
  struct Burst {
    render::SprayBurst burst;
    SimTime born;
  };
  std::deque<Burst> bursts_;
  std::uint32_t next_seed_ = 1;
};

}  // namespace onesea::client
