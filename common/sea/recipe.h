#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "absl/status/status.h"
#include "common/base/sim_time.h"
#include "common/base/vec.h"
#include "common/sea/sea_state.h"

/// The recipe: everything from which any process builds the same spectral sea, bit for bit.
namespace onesea::sea {

/// Raised whenever the same recipe would give another sea. A process refuses a version it does not
/// know.
inline constexpr int kSeaModelVersion = 1;

enum class AmplitudeKind : std::uint8_t {
  kFixed = 1,    ///< random phases only: every seed has the recipe's Hs
  kRayleigh = 2  ///< Gaussian coefficients: Hs varies from seed to seed as in nature
};

/// One periodic tile of the sea. Its waves are the lattice k = (2π/length) R(rotation) (i, j) whose
/// cells meet the band [wavenumber_min, wavenumber_max); a cell's variance is the integral of the
/// spectrum over cell ∩ band, so the disjoint bands of all cascades together carry ∫S over their
/// union exactly once.
struct Cascade {
  double length_m = 1000.0;   ///< tile side, in [kCascadeLengthMinM, kCascadeLengthMaxM]
  double rotation_rad = 0.0;  ///< of the lattice, counter-clockwise; hides the repetition
  double wavenumber_min_rad_per_m = 0.0;  ///< band, half-open
  double wavenumber_max_rad_per_m = 0.0;  ///< at most 2π/length * query_grid_size / 8
  int query_grid_size = 256;  ///< N of the grid that answers queries: 64, 128, ..., 1024
  friend bool operator==(const Cascade&, const Cascade&) = default;
};

/// From `start_tick` on, over `span_ticks` (0: at once), the sea turns from what it is then into
/// `sea`.
struct WeatherEntry {
  Tick start_tick = 0;
  std::int64_t span_ticks = 0;
  SeaState sea;
  friend bool operator==(const WeatherEntry&, const WeatherEntry&) = default;
};

struct Recipe {
  int sea_model_version = kSeaModelVersion;
  std::uint64_t seed = 1;
  int tick_rate_hz = 60;       ///< divides kFlicksPerSecond
  double depth_m = 0.0;        ///< of flat bottom; 0 = infinitely deep
  Vec2d current_m_per_s;       ///< uniform surface current (east, north)
  double loop_period_s = 0.0;  ///< 0, or at least kLoopPeriodMinS: every frequency is rounded to a
                               ///< multiple of 1/loop_period_s
  AmplitudeKind amplitude = AmplitudeKind::kFixed;
  double choppiness = 1.0;             ///< lambda [-] in [0, kChoppinessMax]; above 1 crests fold
  std::vector<Cascade> cascades;       ///< 1..kCascadesMax, bands disjoint
  std::vector<WeatherEntry> timeline;  ///< 1..kWeatherEntriesMax, ascending start_tick; the first
                                       ///< holds for all earlier time
  friend bool operator==(const Recipe&, const Recipe&) = default;
};

/// Four cascades from 1931 m to 13 m with no common period, rotated against each other, waves from
/// 0.4 m to 1931 m.
std::vector<Cascade> DefaultCascades();

/// OK or InvalidArgument with field, value, limit; FailedPrecondition for an unknown
/// sea_model_version.
absl::Status ValidateRecipe(const Recipe& recipe);

/// Share of each timeline entry in the variance at `time`, all >= 0, summing to 1:
/// entry n moves the mix by sin²θ, θ = (π/2)(3u² - 2u³), u = (t - start)/span clamped to [0, 1].
/// Source: docs/determinism.md (contract 5). Exact bits on every machine.
std::vector<double> WeatherWeights(const Recipe& recipe, SimTime time);
/// The same into storage that the caller keeps. Pre: weights.size() == recipe.timeline.size().
void WeatherWeights(const Recipe& recipe, SimTime time, std::span<double> weights);

/// The wind [m/s], where it blows to: the weighted mean of the entries' speeds, in the direction of
/// the mean of their vectors, so that it veers from one to the next without dying down.
Vec2d WindAt(const Recipe& recipe, SimTime time);

/// Appends a change that begins at `start_tick`, and folds away entries that no longer matter at
/// `start_tick` - 1 h. InvalidArgument if `start_tick` lies before the last entry's start, or the
/// limit of entries is reached.
absl::Status AppendWeather(Recipe& recipe, WeatherEntry entry);

}  // namespace onesea::sea
