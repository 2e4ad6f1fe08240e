#pragma once

#include <cstdint>

#include "common/base/quaternion.h"
#include "common/base/vec.h"

namespace onesea::wire {

/// What is known of a body at one moment. World frame.
struct BodyState {
  std::uint32_t id = 0;  ///< > 0
  Vec3d position_m;      ///< centre of mass
  Quaternion turn;       ///< body to world
  Vec3d velocity_m_per_s;
  Vec3d spin_rad_per_s;
  std::uint8_t flags = 0;  ///< of kBody...
};

inline constexpr std::uint8_t kBodyByOwner = 1;  ///< its owner integrates it
inline constexpr std::uint8_t kBodyDriven = 2;   ///< somebody holds its lease
inline constexpr std::uint8_t kBodyAground = 4;  ///< touches the bottom or the land

/// As it would be `seconds` later if it kept both velocities. Pre: finite.
inline BodyState Extrapolate(const BodyState& state, double seconds) {
  BodyState later = state;
  later.position_m = state.position_m + seconds * state.velocity_m_per_s;
  later.turn = Normalised(TurnBy(seconds * state.spin_rad_per_s) * state.turn);
  return later;
}

/// At `share` of the way of `seconds` from a to b, [0, 1]: the cubic with the velocities of both
/// ends; the turn is the normalised mean, even enough for frames of one stream. Pre: finite.
BodyState Interpolate(const BodyState& a, const BodyState& b, double seconds, double share);

}  // namespace onesea::wire
