#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "absl/status/statusor.h"
#include "common/base/sim_time.h"
#include "common/sea/recipe.h"

/// The waves that a recipe means: bit for bit the same on every IEEE-754 machine.
///
/// A component is one travelling wave
///
///   eta(x, t) = a cos(k·x - ωt + φ),   a = √(2 Σ_m w_m(t) E_m)
///
///   symbol  unit     meaning
///   k       rad/m    wave vector, world frame (east, north)
///   ω       rad/s    2π · turns per flick · kFlicksPerSecond, Doppler shift k·U included, any sign
///   φ       rad      phase at t = 0, from Philox4x32-10 keyed by (seed, cascade, i, j)
///   E_m     m²       variance in weather entry m: the integral of its spectrum over cell ∩ band
///   w_m     -        WeatherWeights() at t
///
/// A phase is a fraction of a turn in wrapping integer arithmetic: turns(t) = φ - frequency ·
/// flicks (mod 2⁶⁴), so it is exact however long a session runs.
namespace onesea::sea {

/// Structure of arrays; element n of every array is one wave. Order: j outer, i inner, both
/// ascending.
struct CascadeComponents {
  Cascade cascade;
  std::vector<std::int16_t> i, j;                 ///< (n) lattice indices, never both 0
  std::vector<std::uint64_t> turns_per_flick;     ///< (n) ω/2π, 2⁻⁶⁴ turn, two's complement
  std::vector<std::uint32_t> phase_turns;         ///< (n) φ/2π in 2⁻³² turn
  std::vector<float> kx_rad_per_m, ky_rad_per_m;  ///< (n) world frame
  std::vector<float> intrinsic_rad_per_s;  ///< (n) σ = √(g k tanh kh ...), without the current
  std::vector<std::vector<float>> variance_m2;  ///< (weather entries x n), Rayleigh included
};

/// A regular wave made ready: same phase law as above, in double.
struct RegularComponent {
  double kx_rad_per_m = 0.0, ky_rad_per_m = 0.0;
  double intrinsic_rad_per_s = 0.0;
  std::uint64_t turns_per_flick = 0;
  std::uint64_t phase_turns = 0;    ///< 2⁻⁶⁴ turn
  std::vector<double> variance_m2;  ///< (weather entries), a²/2 where the entry lists this wave
};

class Attenuation;

struct Components {
  Recipe recipe;
  std::vector<CascadeComponents> cascades;
  std::vector<RegularComponent> regular;
  std::uint64_t hash = 0;                ///< over all of the above, every entry of the timeline
  std::vector<double> unresolved_mss;    ///< (weather entries) ∫ k²S above the last band
  std::vector<double> lost_variance_m2;  ///< (weather entries) ∫S outside all bands
  /// How the terrain lowers these waves, see OverTerrain() in attenuation.h; null: the open sea.
  std::shared_ptr<const Attenuation> attenuation;
};

/// InvalidArgument as ValidateRecipe(), or for a sea above kSeaHsMaxM. Cost: about 20 ms per wave
/// system with the default cascades, one core. Immutable afterwards: share it.
absl::StatusOr<std::shared_ptr<const Components>> BuildComponents(const Recipe& recipe);

/// Variance of the whole surface at `time`: Σ w_m E_m [m²]; Hs = 4 √ of it.
double VarianceAt(const Components& components, SimTime time);

}  // namespace onesea::sea
