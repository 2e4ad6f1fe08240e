#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "absl/status/status.h"

/// What the sea is made of at one moment of weather: a sum of independent wave systems, plus
/// explicit regular waves.
///
/// Directions are `wave_to_rad`: where the waves travel, counter-clockwise from east. Frequencies
/// are in hertz, densities one-sided. Every number here enters the component hash, so nothing is
/// derived by libm.
namespace onesea::sea {

enum class SpreadingKind : std::uint8_t {
  kCosine2s = 1,      ///< D ∝ cos^2s((θ-θ0)/2), Longuet-Higgins et al. 1963
  kMitsuyasu = 2,     ///< cos^2s with s(ω), Mitsuyasu et al. 1975
  kHasselmann = 3,    ///< cos^2s with s(ω), Hasselmann et al. 1980
  kDonelanBanner = 4  ///< sech², Donelan et al. 1985, Banner 1990
};

struct Spreading {
  SpreadingKind kind = SpreadingKind::kHasselmann;
  double exponent_s = 10.0;  ///< [-] in [0, 1000]; kCosine2s only
  double swell = 0.0;        ///< xi [-] in [0, 1]; Horvath 2015 narrowing, 0 = wind sea
  friend bool operator==(const Spreading&, const Spreading&) = default;
};

/// Tessendorf 2001 eq. 40 with its errata: P(k) = A exp(-1/(kL)²)/k⁴ |k̂·ŵ|^p exp(-(k l)²), L =
/// V²/g, A = alpha/2π.
struct PhillipsSystem {
  double wind_speed_m_per_s = 10.0;  ///< V > 0
  double wind_to_rad = 0.0;
  double alpha = 0.0081;              ///< [-] in (0, 1]
  double small_wave_cutoff_m = 0.0;   ///< l >= 0; waves much shorter are suppressed
  double directional_exponent = 2.0;  ///< p in [0, 32]
  bool one_sided =
      true;  ///< no wave travels against the wind; the variance of the other half is lost
  friend bool operator==(const PhillipsSystem&, const PhillipsSystem&) = default;
};

/// Pierson & Moskowitz 1964, fully developed; alpha 0.0081, beta 0.74.
struct PiersonMoskowitzSystem {
  double wind_speed_19_5_m_per_s = 10.0;  ///< at 19.5 m; U10 = U19.5 / 1.026
  double wave_to_rad = 0.0;
  Spreading spreading;
  friend bool operator==(const PiersonMoskowitzSystem&, const PiersonMoskowitzSystem&) = default;
};

/// JONSWAP (Hasselmann et al. 1973) by height and period: scaled so that 4√m0 is exactly `hs_m`;
/// with `use_depth` the TMA factor of Kitaigorodskii (Bouws et al. 1985) shapes it before that
/// scaling.
struct JonswapSystem {
  double hs_m = 2.0;
  double tp_s = 8.0;
  double gamma = 3.3;  ///< [-] in [1, 20]
  double wave_to_rad = 0.0;
  Spreading spreading;
  bool use_depth = false;
  friend bool operator==(const JonswapSystem&, const JonswapSystem&) = default;
};

/// JONSWAP by wind and fetch: alpha = 0.076 chi^-0.22, omega_p = 2π 3.5 (g/U) chi^-0.33, chi =
/// gF/U². TMA when `use_depth`.
struct FetchJonswapSystem {
  double wind_speed_m_per_s = 10.0;  ///< U10
  double fetch_m = 100'000.0;
  double gamma = 3.3;
  double wave_to_rad = 0.0;
  Spreading spreading;
  bool use_depth = false;
  friend bool operator==(const FetchJonswapSystem&, const FetchJonswapSystem&) = default;
};

/// Elfouhaily et al. 1997 (ECKV), gravity to capillary, with its own spreading.
struct ElfouhailySystem {
  double wind_speed_m_per_s = 10.0;  ///< U10
  double inverse_wave_age = 0.84;    ///< Omega_c in [0.84, 5]; 0.84 = fully developed
  double wave_to_rad = 0.0;
  friend bool operator==(const ElfouhailySystem&, const ElfouhailySystem&) = default;
};

/// What a directional buoy publishes: density and the first four Fourier coefficients per
/// frequency. The distribution over direction is the maximum-entropy estimate (Lygre & Krogstad
/// 1986), which is never negative.
struct BuoySpectrum {
  std::vector<float> frequency_hz;       ///< (n) ascending, > 0
  std::vector<float> density_m2_per_hz;  ///< (n) >= 0
  std::vector<float>
      mean_wave_to_rad;  ///< (n) from alpha1; empty = omnidirectional data, see `fallback`
  std::vector<float> principal_wave_to_rad;  ///< (n) from alpha2, same size as mean_wave_to_rad
  std::vector<float> r1;                     ///< (n) [-] in [0, 1]
  std::vector<float> r2;                     ///< (n) [-] in [0, 1]
  double fallback_wave_to_rad = 0.0;         ///< 1-D data: direction and spreading assumed
  Spreading fallback_spreading;
  double hs_m = 0.0;  ///< > 0: the band-summed Hs of the publisher, to which the density is scaled;
                      ///< 0: as it is
  bool add_tail = true;  ///< continues the density as f⁻⁵ above the last band, beyond hs_m
  friend bool operator==(const BuoySpectrum&, const BuoySpectrum&) = default;
};

/// A directional spectrum on a grid, as wave models write it.
struct GridSpectrum {
  std::vector<float> frequency_hz;  ///< (n) ascending, > 0
  std::vector<float> wave_to_rad;   ///< (m) ascending within one turn, evenly or unevenly spaced
  std::vector<float> density_m2_per_hz_rad;  ///< (n x m) row-major, >= 0
  double hs_m = 0.0;                         ///< as in BuoySpectrum
  bool add_tail = true;
  friend bool operator==(const GridSpectrum&, const GridSpectrum&) = default;
};

using WaveSystem = std::variant<PhillipsSystem, PiersonMoskowitzSystem, JonswapSystem,
                                FetchJonswapSystem, ElfouhailySystem, BuoySpectrum, GridSpectrum>;

/// One explicit wave of any length for tank tests: eta = a cos(k·x - ωt + phase), off the lattice,
/// same dispersion.
struct RegularWave {
  double amplitude_m = 0.5;
  double period_s = 8.0;
  double wave_to_rad = 0.0;
  double phase_rad = 0.0;
  friend bool operator==(const RegularWave&, const RegularWave&) = default;
};

struct SeaState {
  std::string name;                        ///< for people; not hashed
  std::vector<WaveSystem> systems;         ///< at most kWaveSystemsMax
  std::vector<RegularWave> regular_waves;  ///< at most kRegularWavesMax
  double wind_speed_m_per_s =
      0.0;  ///< U10 for foam and for shading what is too short to be resolved
  double wind_to_rad = 0.0;
  friend bool operator==(const SeaState&, const SeaState&) = default;
};

/// InvalidArgument naming field, value and limit; `prefix` is put before field names
/// ("timeline[2].sea.").
absl::Status ValidateSeaState(const SeaState& sea, std::string_view prefix);

}  // namespace onesea::sea
