#pragma once

#include <cmath>

#include "common/sea/constants.h"

/// Directions of files into the one sense used inside: where waves travel, counter-clockwise from
/// east, in [0, 2π).
namespace onesea::ingest {

inline constexpr double kRadPerDeg = sea::kPi / 180.0;

inline double WrapToTurn(double angle_rad) {
  const double turn = 2.0 * sea::kPi;
  const double wrapped = angle_rad - turn * std::floor(angle_rad / turn);
  return wrapped < turn ? wrapped : 0.0;
}

/// From nautical "coming from", clockwise from north (NDBC, SWAN's NDIR).
inline double WaveToFromNautical(double from_deg) {
  return WrapToTurn((270.0 - from_deg) * kRadPerDeg);
}

/// From nautical "going to", clockwise from north, in radians (WAVEWATCH III).
inline double WaveToFromCompass(double to_rad) { return WrapToTurn(0.5 * sea::kPi - to_rad); }

/// To nautical "coming from", for people; in [0, 360).
inline double NauticalFromWaveTo(double wave_to_rad) {
  return WrapToTurn(1.5 * sea::kPi - wave_to_rad) / kRadPerDeg;
}

}  // namespace onesea::ingest
