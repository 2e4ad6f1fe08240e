#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "absl/status/status.h"
#include "common/wire/body_encoder.h"

namespace onesea::wire {

/// The receiving end of BodyEncoder. Not thread-safe.
class BodyTable {
 public:
  /// Nothing moves on for longer than this after a body's last state: the stream has stalled.
  static constexpr double kExtrapolationMaxS = 1.5;

  struct Body {
    std::shared_ptr<const BodyInfo> info;
    BodyState newest;
    SimTime newest_time;
    std::optional<BodyState> before;  ///< the state before that
    SimTime before_time;

    /// At `time`: between two states on a smooth curve, after them by dead reckoning, before them
    /// as the older of them was.
    BodyState At(SimTime time) const;
  };

  /// Takes over an update of the frame at `tick`; a keyframe replaces everything. InvalidArgument
  /// (then the table is as it was) for bytes that no encoder writes, for a state without its info,
  /// more than kBodiesMax. Pre: IsTickRateExact(tick_rate_hz), IsTickInRange(tick, tick_rate_hz).
  absl::Status Apply(const BodyUpdate& update, Tick tick, int tick_rate_hz, bool keyframe);

  /// Ascending by id.
  std::span<const Body> bodies() const { return bodies_; }
  /// Null: no such body.
  const Body* Find(std::uint32_t id) const;

 private:
  std::vector<Body> bodies_;
};

}  // namespace onesea::wire
