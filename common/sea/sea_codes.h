#pragma once

#include "absl/status/statusor.h"
#include "common/sea/sea_state.h"

/// Seas by the codes that people use: Beaufort force and the WMO sea-state code.
///
/// Each becomes one JONSWAP system (γ 3.3, Hasselmann spreading) with the table's height and the
/// period that JONSWAP's fetch laws give that height under that wind: χ from
/// Hs = 0.0016 √χ U²/g, then ω_p = 7π (g/U) χ^-0.33.
namespace onesea::sea {

/// Beaufort force 0..12: wind and probable wave height of the open sea after WMO's table; U10 is
/// the middle of the force's range, v = 0.836 B^1.5 (12: 34.8 m/s). Force 0 is flat water.
/// InvalidArgument outside 0..12.
absl::StatusOr<SeaState> SeaOfBeaufort(int force, double wave_to_rad);

/// WMO code table 3700, 0..9: the middle of the code's range of Hs; 9 ("over 14 m") is 14 m. The
/// wind is the one that raises such a height in the Beaufort table. Code 0 is flat water.
/// InvalidArgument outside 0..9.
absl::StatusOr<SeaState> SeaOfWmoCode(int code, double wave_to_rad);

}  // namespace onesea::sea
