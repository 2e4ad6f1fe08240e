#include "common/sea/sea_state.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/base/range_check.h"
#include "common/sea/constants.h"

namespace onesea::sea {
namespace {

// An angle may count turns, but not so many that a double forgets the angle.
constexpr double kAngleMaxRad = 1000.0;
// A system needs some wind: below this the fetch laws overflow.
constexpr double kWindSpeedMinMPerS = 1e-3;

// Checks one system; `prefix` ends in a dot.
struct Validator {
  std::string prefix;

  std::string Field(const std::string& name) const { return absl::StrCat(prefix, name); }
  absl::Status Within(const std::string& name, double value, double low, double high) const {
    return CheckInRange(Field(name), value, low, high);
  }
  absl::Status Above(const std::string& name, double value, double low, double high) const {
    return CheckAbove(Field(name), value, low, high);
  }
  absl::Status Angle(const std::string& name, double value) const {
    return Within(name, value, -kAngleMaxRad, kAngleMaxRad);
  }

  absl::Status Check(const std::string& name, const Spreading& s) const {
    const int kind = static_cast<int>(s.kind);
    if (kind < 1 || kind > static_cast<int>(SpreadingKind::kDonelanBanner)) {
      return absl::InvalidArgumentError(
          absl::StrCat(Field(name), ".kind = ", kind, " is no known kind of spreading"));
    }
    ONESEA_RETURN_IF_ERROR(Within(absl::StrCat(name, ".exponent_s"), s.exponent_s, 0.0, 1000.0));
    return Within(absl::StrCat(name, ".swell"), s.swell, 0.0, 1.0);
  }

  absl::Status operator()(const PhillipsSystem& s) const {
    ONESEA_RETURN_IF_ERROR(
        Above("wind_speed_m_per_s", s.wind_speed_m_per_s, kWindSpeedMinMPerS, kWindSpeedMaxMPerS));
    ONESEA_RETURN_IF_ERROR(Angle("wind_to_rad", s.wind_to_rad));
    ONESEA_RETURN_IF_ERROR(Above("alpha", s.alpha, 0.0, 1.0));
    ONESEA_RETURN_IF_ERROR(Within("small_wave_cutoff_m", s.small_wave_cutoff_m, 0.0, 10.0));
    return Within("directional_exponent", s.directional_exponent, 0.0, 32.0);
  }

  absl::Status operator()(const PiersonMoskowitzSystem& s) const {
    ONESEA_RETURN_IF_ERROR(Above("wind_speed_19_5_m_per_s", s.wind_speed_19_5_m_per_s,
                                 kWindSpeedMinMPerS, kWindSpeedMaxMPerS));
    ONESEA_RETURN_IF_ERROR(Angle("wave_to_rad", s.wave_to_rad));
    return Check("spreading", s.spreading);
  }

  absl::Status operator()(const JonswapSystem& s) const {
    ONESEA_RETURN_IF_ERROR(Above("hs_m", s.hs_m, 0.0, kHsMaxM));
    ONESEA_RETURN_IF_ERROR(Within("tp_s", s.tp_s, kPeriodMinS, kPeriodMaxS));
    ONESEA_RETURN_IF_ERROR(Within("gamma", s.gamma, 1.0, 20.0));
    ONESEA_RETURN_IF_ERROR(Angle("wave_to_rad", s.wave_to_rad));
    return Check("spreading", s.spreading);
  }

  absl::Status operator()(const FetchJonswapSystem& s) const {
    ONESEA_RETURN_IF_ERROR(
        Above("wind_speed_m_per_s", s.wind_speed_m_per_s, kWindSpeedMinMPerS, kWindSpeedMaxMPerS));
    ONESEA_RETURN_IF_ERROR(Within("fetch_m", s.fetch_m, 100.0, 1e7));
    ONESEA_RETURN_IF_ERROR(Within("gamma", s.gamma, 1.0, 20.0));
    ONESEA_RETURN_IF_ERROR(Angle("wave_to_rad", s.wave_to_rad));
    return Check("spreading", s.spreading);
  }

  absl::Status operator()(const ElfouhailySystem& s) const {
    ONESEA_RETURN_IF_ERROR(
        Above("wind_speed_m_per_s", s.wind_speed_m_per_s, kWindSpeedMinMPerS, kWindSpeedMaxMPerS));
    ONESEA_RETURN_IF_ERROR(Within("inverse_wave_age", s.inverse_wave_age, 0.84, 5.0));
    return Angle("wave_to_rad", s.wave_to_rad);
  }

  absl::Status CheckSize(const std::string& name, std::size_t size, std::size_t wanted) const {
    if (size == wanted) return absl::OkStatus();
    return absl::InvalidArgumentError(
        absl::StrCat(Field(name), " has ", size, " values, needs ", wanted));
  }

  absl::Status CheckAll(const std::string& name, const std::vector<float>& values, double low,
                        double high) const {
    for (std::size_t n = 0; n < values.size(); ++n) {
      ONESEA_RETURN_IF_ERROR(Within(absl::StrCat(name, "[", n, "]"), values[n], low, high));
    }
    return absl::OkStatus();
  }

  absl::Status CheckAscending(const std::string& name, const std::vector<float>& values) const {
    for (std::size_t n = 1; n < values.size(); ++n) {
      if (!(values[n] > values[n - 1])) {
        return absl::InvalidArgumentError(absl::StrCat(Field(name), "[", n, "] = ", values[n],
                                                       " is not above its predecessor ",
                                                       values[n - 1]));
      }
    }
    return absl::OkStatus();
  }

  absl::Status CheckFrequencies(const std::vector<float>& frequency_hz) const {
    ONESEA_RETURN_IF_ERROR(Within("frequency_hz: number", static_cast<double>(frequency_hz.size()),
                                  2.0, kSpectrumFrequenciesMax));
    ONESEA_RETURN_IF_ERROR(
        CheckAll("frequency_hz", frequency_hz, 1.0 / (10.0 * kPeriodMaxS), 1.0 / kPeriodMinS));
    return CheckAscending("frequency_hz", frequency_hz);
  }

  // A density may be huge for a moment of arithmetic, its Hs may not; and a scale needs energy.
  absl::Status CheckHs(double hs_m, double variance_m2) const {
    ONESEA_RETURN_IF_ERROR(Within("hs_m", hs_m, 0.0, kHsMaxM));
    if (hs_m > 0.0 && !(variance_m2 > 0.0)) {
      return absl::InvalidArgumentError(
          absl::StrCat(Field("hs_m"), " = ", hs_m, ", but the density is zero everywhere"));
    }
    return Within("hs of the density", 4.0 * std::sqrt(variance_m2), 0.0, 10.0 * kHsMaxM);
  }

  absl::Status operator()(const BuoySpectrum& s) const;
  absl::Status operator()(const GridSpectrum& s) const;

  absl::Status Check(const RegularWave& wave) const {
    ONESEA_RETURN_IF_ERROR(Above("amplitude_m", wave.amplitude_m, 0.0, kHsMaxM));
    ONESEA_RETURN_IF_ERROR(Within("period_s", wave.period_s, kPeriodMinS, kPeriodMaxS));
    ONESEA_RETURN_IF_ERROR(Angle("wave_to_rad", wave.wave_to_rad));
    return Angle("phase_rad", wave.phase_rad);
  }
};

absl::Status Validator::operator()(const BuoySpectrum& s) const {
  ONESEA_RETURN_IF_ERROR(CheckFrequencies(s.frequency_hz));
  const std::size_t n = s.frequency_hz.size();
  ONESEA_RETURN_IF_ERROR(CheckSize("density_m2_per_hz", s.density_m2_per_hz.size(), n));
  ONESEA_RETURN_IF_ERROR(CheckAll("density_m2_per_hz", s.density_m2_per_hz, 0.0, 1e6));
  const std::size_t directional = s.mean_wave_to_rad.empty() ? 0 : n;
  ONESEA_RETURN_IF_ERROR(CheckSize("mean_wave_to_rad", s.mean_wave_to_rad.size(), directional));
  ONESEA_RETURN_IF_ERROR(
      CheckSize("principal_wave_to_rad", s.principal_wave_to_rad.size(), directional));
  ONESEA_RETURN_IF_ERROR(CheckSize("r1", s.r1.size(), directional));
  ONESEA_RETURN_IF_ERROR(CheckSize("r2", s.r2.size(), directional));
  ONESEA_RETURN_IF_ERROR(
      CheckAll("mean_wave_to_rad", s.mean_wave_to_rad, -kAngleMaxRad, kAngleMaxRad));
  ONESEA_RETURN_IF_ERROR(
      CheckAll("principal_wave_to_rad", s.principal_wave_to_rad, -kAngleMaxRad, kAngleMaxRad));
  ONESEA_RETURN_IF_ERROR(CheckAll("r1", s.r1, 0.0, 1.0));
  ONESEA_RETURN_IF_ERROR(CheckAll("r2", s.r2, 0.0, 1.0));
  ONESEA_RETURN_IF_ERROR(Angle("fallback_wave_to_rad", s.fallback_wave_to_rad));
  ONESEA_RETURN_IF_ERROR(Check("fallback_spreading", s.fallback_spreading));
  double variance = 0.0;
  for (std::size_t m = 1; m < n; ++m) {
    variance += 0.5 * (s.density_m2_per_hz[m] + s.density_m2_per_hz[m - 1]) *
                (s.frequency_hz[m] - s.frequency_hz[m - 1]);
  }
  return CheckHs(s.hs_m, variance);
}

absl::Status Validator::operator()(const GridSpectrum& s) const {
  ONESEA_RETURN_IF_ERROR(CheckFrequencies(s.frequency_hz));
  const std::size_t n = s.frequency_hz.size();
  const std::size_t m = s.wave_to_rad.size();
  ONESEA_RETURN_IF_ERROR(
      Within("wave_to_rad: number", static_cast<double>(m), 2.0, kSpectrumDirectionsMax));
  ONESEA_RETURN_IF_ERROR(CheckAll("wave_to_rad", s.wave_to_rad, -kAngleMaxRad, kAngleMaxRad));
  ONESEA_RETURN_IF_ERROR(CheckAscending("wave_to_rad", s.wave_to_rad));
  const double turn = s.wave_to_rad.back() - s.wave_to_rad.front();
  ONESEA_RETURN_IF_ERROR(Within("wave_to_rad: last - first", turn, 0.0, 2.0 * kPi - 1e-4));
  ONESEA_RETURN_IF_ERROR(CheckSize("density_m2_per_hz_rad", s.density_m2_per_hz_rad.size(), n * m));
  ONESEA_RETURN_IF_ERROR(CheckAll("density_m2_per_hz_rad", s.density_m2_per_hz_rad, 0.0, 1e6));
  double variance = 0.0;  // roughly: enough to tell something from nothing and from too much
  for (std::size_t a = 1; a < n; ++a) {
    const double width = s.frequency_hz[a] - s.frequency_hz[a - 1];
    for (std::size_t b = 0; b < m; ++b) {
      variance += 0.5 * width * (2.0 * kPi / static_cast<double>(m)) *
                  (s.density_m2_per_hz_rad[a * m + b] + s.density_m2_per_hz_rad[(a - 1) * m + b]);
    }
  }
  return CheckHs(s.hs_m, variance);
}

}  // namespace

absl::Status ValidateSeaState(const SeaState& sea, std::string_view prefix) {
  const std::string path(prefix);
  const Validator top{path};
  ONESEA_RETURN_IF_ERROR(
      top.Within("systems: number", static_cast<double>(sea.systems.size()), 0.0, kWaveSystemsMax));
  ONESEA_RETURN_IF_ERROR(top.Within("regular_waves: number",
                                    static_cast<double>(sea.regular_waves.size()), 0.0,
                                    kRegularWavesMax));
  ONESEA_RETURN_IF_ERROR(
      top.Within("wind_speed_m_per_s", sea.wind_speed_m_per_s, 0.0, kWindSpeedMaxMPerS));
  ONESEA_RETURN_IF_ERROR(top.Angle("wind_to_rad", sea.wind_to_rad));
  for (std::size_t n = 0; n < sea.systems.size(); ++n) {
    const Validator validator{absl::StrCat(path, "systems[", n, "].")};
    ONESEA_RETURN_IF_ERROR(std::visit(validator, sea.systems[n]));
  }
  for (std::size_t n = 0; n < sea.regular_waves.size(); ++n) {
    const Validator validator{absl::StrCat(path, "regular_waves[", n, "].")};
    ONESEA_RETURN_IF_ERROR(validator.Check(sea.regular_waves[n]));
  }
  return absl::OkStatus();
}

}  // namespace onesea::sea
