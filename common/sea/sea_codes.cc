#include "common/sea/sea_codes.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/real_math.h"
#include "common/sea/constants.h"

namespace onesea::sea {
namespace {

// Probable wave height [m] by Beaufort force, open sea.
constexpr double kBeaufortHsM[] = {0.0, 0.1, 0.2, 0.6, 1.0,  2.0, 3.0,
                                   4.0, 5.5, 7.0, 9.0, 11.5, 14.0};
constexpr int kBeaufortMax = 12;

// Middles of the ranges of code table 3700 [m]: 0, -0.1, -0.5, -1.25, -2.5, -4, -6, -9, -14, above.
constexpr double kWmoHsM[] = {0.0, 0.05, 0.3, 0.875, 1.875, 3.25, 5.0, 7.5, 11.5, 14.0};
constexpr int kWmoMax = 9;

double BeaufortWind(double force) { return 0.836 * force * std::sqrt(force); }

// The force, with its fraction, whose table height is hs_m. Pre: 0 < hs_m <= 14.
double BeaufortOfHs(double hs_m) {
  int force = 1;
  while (force < kBeaufortMax && kBeaufortHsM[force] < hs_m) ++force;
  const double low = kBeaufortHsM[force - 1];
  return force - 1 + (hs_m - low) / (kBeaufortHsM[force] - low);
}

double FetchLawPeriod(double hs_m, double wind_m_per_s) {
  const double root_chi = hs_m * kGravity / (0.0016 * wind_m_per_s * wind_m_per_s);
  const double omega_p =
      7.0 * kPi * (kGravity / wind_m_per_s) * real::Pow(root_chi * root_chi, -0.33);
  return 2.0 * kPi / omega_p;
}

SeaState SeaOf(std::string name, double hs_m, double wind_m_per_s, double wave_to_rad) {
  SeaState sea;
  sea.name = std::move(name);
  sea.wind_speed_m_per_s = wind_m_per_s;
  sea.wind_to_rad = wave_to_rad;
  if (hs_m > 0.0) {
    JonswapSystem system;
    system.hs_m = hs_m;
    system.tp_s = FetchLawPeriod(hs_m, wind_m_per_s);
    system.wave_to_rad = wave_to_rad;
    sea.systems.push_back(system);
  }
  return sea;
}

absl::Status CheckCode(const char* name, int value, int max) {
  if (value >= 0 && value <= max) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(name, " = ", value, " is outside [0, ", max, "]"));
}

}  // namespace

absl::StatusOr<SeaState> SeaOfBeaufort(int force, double wave_to_rad) {
  ONESEA_RETURN_IF_ERROR(CheckCode("beaufort", force, kBeaufortMax));
  SeaState sea = SeaOf(absl::StrCat("Beaufort ", force), kBeaufortHsM[force], BeaufortWind(force),
                       wave_to_rad);
  ONESEA_RETURN_IF_ERROR(ValidateSeaState(sea, ""));
  return sea;
}

absl::StatusOr<SeaState> SeaOfWmoCode(int code, double wave_to_rad) {
  ONESEA_RETURN_IF_ERROR(CheckCode("wmo_sea_state", code, kWmoMax));
  const double hs_m = kWmoHsM[code];
  const double wind_m_per_s = hs_m > 0.0 ? BeaufortWind(BeaufortOfHs(hs_m)) : 0.0;
  SeaState sea = SeaOf(absl::StrCat("WMO sea state ", code), hs_m, wind_m_per_s, wave_to_rad);
  ONESEA_RETURN_IF_ERROR(ValidateSeaState(sea, ""));
  return sea;
}

}  // namespace onesea::sea
