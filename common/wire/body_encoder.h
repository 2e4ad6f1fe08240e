#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/wire/body_codec.h"
#include "common/wire/body_description.h"

namespace onesea::wire {

/// What one frame says of bodies, the same for every viewer. Order of application: removed, infos,
/// states.
struct BodyUpdate {
  std::vector<std::uint32_t> removed_ids;
  std::vector<std::shared_ptr<const BodyInfo>> infos;  ///< of new and of changed bodies
  std::string states;                                  ///< AppendBodies
  bool empty() const { return removed_ids.empty() && infos.empty() && states.empty(); }
};

/// How far a receiver's extrapolation may be off before a body is sent again.
struct BodyTolerance {
  double position_m = 5e-3;
  double angle_rad = 1.75e-3;  ///< 0.1 degrees
  double refresh_s = 1.0;      ///< a moving body is sent at least so often; receivers rely on it
};

struct BodyView {
  BodyState state;                       ///< finite
  std::shared_ptr<const BodyInfo> info;  ///< another pointer: it changed
};
/// Null: none of this id. Pre: ascending ids.
const BodyView* FindBody(std::span<const BodyView> bodies, std::uint32_t id);

/// Dead reckoning: sends a body when what receivers make of its last state would be too far off.
/// Whoever applied every update since a keyframe is within the tolerance, plus half a millimetre
/// and 0.01 degrees of rounding, at each tick that was offered. Allocates only when a body appears.
/// Not thread-safe.
class BodyEncoder {
 public:
  /// `tick_s` is the length of a tick.
  BodyEncoder(double tick_s, const BodyTolerance& tolerance = {});

  /// `bodies` ascend by id; who is missing has been removed. Valid until the next call.
  const BodyUpdate& Encode(Tick tick, std::span<const BodyView> bodies);

  /// What receivers of everything hold since the last Encode(), for a frame of that tick.
  BodyUpdate Keyframe() const;

 private:
  struct Sent {
    BodyState state;  // as receivers have it
    Tick tick = 0;
    std::shared_ptr<const BodyInfo> info;
  };
  bool MustSend(const Sent& sent, const BodyState& state, Tick tick) const;

  double tick_s_;
  BodyTolerance tolerance_;
  Tick tick_ = 0;                  // of the last Encode()
  std::vector<Sent> sent_, next_;  // ascending by id
  std::vector<SentBody> states_;
  BodyUpdate update_;
};

}  // namespace onesea::wire
