#include "common/sea/recipe.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/base/range_check.h"
#include "common/sea/constants.h"

namespace onesea::sea {
namespace {

// Eight samples per shortest wave on the query grid.
double WavenumberLimit(const Cascade& cascade) {
  const int index_max = cascade.query_grid_size / 8;
  return 2.0 * kPi / cascade.length_m * index_max;
}

bool IsGridSize(int n) { return n >= kGridSizeMin && n <= kGridSizeMax && (n & (n - 1)) == 0; }

absl::Status ValidateCascade(const Cascade& cascade, const std::string& name) {
  ONESEA_RETURN_IF_ERROR(CheckInRange(absl::StrCat(name, ".length_m"), cascade.length_m,
                                      kCascadeLengthMinM, kCascadeLengthMaxM));
  ONESEA_RETURN_IF_ERROR(
      CheckInRange(absl::StrCat(name, ".rotation_rad"), cascade.rotation_rad, -100.0, 100.0));
  if (!IsGridSize(cascade.query_grid_size)) {
    return absl::InvalidArgumentError(
        absl::StrCat(name, ".query_grid_size = ", cascade.query_grid_size,
                     " is not a power of two in [", kGridSizeMin, ", ", kGridSizeMax, "]"));
  }
  const double limit = WavenumberLimit(cascade);
  ONESEA_RETURN_IF_ERROR(CheckInRange(absl::StrCat(name, ".wavenumber_min_rad_per_m"),
                                      cascade.wavenumber_min_rad_per_m, 0.0, limit));
  // A limit that was rounded once more by another program is still the limit.
  ONESEA_RETURN_IF_ERROR(CheckInRange(absl::StrCat(name, ".wavenumber_max_rad_per_m"),
                                      cascade.wavenumber_max_rad_per_m, 0.0,
                                      limit * (1.0 + 1e-12)));
  if (!(cascade.wavenumber_min_rad_per_m < cascade.wavenumber_max_rad_per_m)) {
    return absl::InvalidArgumentError(absl::StrCat(
        name, ".wavenumber_max_rad_per_m = ", cascade.wavenumber_max_rad_per_m,
        " is not above wavenumber_min_rad_per_m = ", cascade.wavenumber_min_rad_per_m));
  }
  return absl::OkStatus();
}

absl::Status ValidateCascades(const std::vector<Cascade>& cascades) {
  ONESEA_RETURN_IF_ERROR(
      CheckInRange("cascades: number", static_cast<double>(cascades.size()), 1.0, kCascadesMax));
  for (std::size_t n = 0; n < cascades.size(); ++n) {
    ONESEA_RETURN_IF_ERROR(ValidateCascade(cascades[n], absl::StrCat("cascades[", n, "]")));
  }
  for (std::size_t n = 0; n < cascades.size(); ++n) {
    for (std::size_t m = 0; m < n; ++m) {
      const Cascade& a = cascades[m];
      const Cascade& b = cascades[n];
      if (a.wavenumber_min_rad_per_m < b.wavenumber_max_rad_per_m &&
          b.wavenumber_min_rad_per_m < a.wavenumber_max_rad_per_m) {
        return absl::InvalidArgumentError(
            absl::StrCat("cascades[", m, "] and cascades[", n, "]: bands overlap"));
      }
    }
  }
  return absl::OkStatus();
}

absl::Status ValidateTimeline(const Recipe& recipe) {
  const auto& timeline = recipe.timeline;
  ONESEA_RETURN_IF_ERROR(CheckInRange("timeline: number of entries",
                                      static_cast<double>(timeline.size()), 1.0,
                                      kWeatherEntriesMax));
  const double ticks_max = kQueryTimeMaxS * recipe.tick_rate_hz;
  for (std::size_t n = 0; n < timeline.size(); ++n) {
    const WeatherEntry& entry = timeline[n];
    const std::string name = absl::StrCat("timeline[", n, "]");
    ONESEA_RETURN_IF_ERROR(CheckInRange(absl::StrCat(name, ".start_tick"),
                                        static_cast<double>(entry.start_tick), -ticks_max,
                                        ticks_max));
    ONESEA_RETURN_IF_ERROR(CheckInRange(absl::StrCat(name, ".span_ticks"),
                                        static_cast<double>(entry.span_ticks), 0.0, ticks_max));
    if (n > 0 && entry.start_tick < timeline[n - 1].start_tick) {
      return absl::InvalidArgumentError(
          absl::StrCat(name, ".start_tick = ", entry.start_tick, " lies before timeline[", n - 1,
                       "].start_tick = ", timeline[n - 1].start_tick));
    }
    ONESEA_RETURN_IF_ERROR(ValidateSeaState(entry.sea, absl::StrCat(name, ".sea.")));
  }
  return absl::OkStatus();
}

// Cells that meet the band, to a percent: a disc grown by half a cell less one shrunk by it.
double WaveCountOf(const Cascade& cascade) {
  const double cells = cascade.length_m / (2.0 * kPi);
  const double low = cells * cascade.wavenumber_min_rad_per_m;
  const double high = cells * cascade.wavenumber_max_rad_per_m;
  return kPi * (high * high - low * low) + 4.0 * (high + low);
}

// What BuildComponents() will cost.
absl::Status ValidateBuildCost(const Recipe& recipe) {
  double waves = 0.0;
  std::int64_t systems = 0;
  for (const Cascade& cascade : recipe.cascades) waves += WaveCountOf(cascade);
  for (const WeatherEntry& entry : recipe.timeline) {
    systems += static_cast<std::int64_t>(entry.sea.systems.size());
  }
  const std::int64_t whole_waves = std::llround(waves);
  if (whole_waves * systems <= kBuildWavesMax) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(
      "cascades: about ", whole_waves, " waves x ", systems,
      " wave systems in the timeline = ", whole_waves * systems, ", the limit is ", kBuildWavesMax,
      "; use smaller bands, fewer systems, or wait for older weather to end"));
}

absl::Status ValidateAmplitude(AmplitudeKind kind) {
  if (kind == AmplitudeKind::kFixed || kind == AmplitudeKind::kRayleigh) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat("amplitude = ", static_cast<int>(kind), " is no known kind"));
}

}  // namespace

std::vector<Cascade> DefaultCascades() {
  struct Tile {
    double length_m;
    double rotation_deg;
  };
  // The ratio of lengths, about 5.3, keeps every band within |index| 6..32; lengths and angles are
  // chosen so that no two lattices share a direction or a multiple of a length.
  constexpr Tile kTiles[] = {{1931.0, 0.0}, {379.0, 17.0}, {71.3, -29.0}, {12.7, 41.0}};
  std::vector<Cascade> cascades;
  double from_rad_per_m = 0.0;
  for (const Tile& tile : kTiles) {
    Cascade cascade{tile.length_m, tile.rotation_deg * (kPi / 180.0), from_rad_per_m, 0.0, 256};
    cascade.wavenumber_max_rad_per_m = WavenumberLimit(cascade);
    from_rad_per_m = cascade.wavenumber_max_rad_per_m;
    cascades.push_back(cascade);
  }
  return cascades;
}

absl::Status ValidateRecipe(const Recipe& recipe) {
  if (recipe.sea_model_version != kSeaModelVersion) {
    return absl::FailedPreconditionError(absl::StrCat(
        "sea_model_version = ", recipe.sea_model_version, " is unknown here; this program knows ",
        kSeaModelVersion, ": update the older of the two"));
  }
  ONESEA_RETURN_IF_ERROR(CheckInRange("tick_rate_hz", recipe.tick_rate_hz, 1.0, kTickRateMaxHz));
  if (!IsTickRateExact(recipe.tick_rate_hz)) {
    return absl::InvalidArgumentError(absl::StrCat("tick_rate_hz = ", recipe.tick_rate_hz,
                                                   " does not divide ", kFlicksPerSecond));
  }
  if (recipe.depth_m != 0.0) {
    ONESEA_RETURN_IF_ERROR(CheckInRange("depth_m", recipe.depth_m, kDepthMinM, kDepthMaxM));
  }
  ONESEA_RETURN_IF_ERROR(
      CheckInRange("current speed [m/s]", Norm(recipe.current_m_per_s), 0.0, kCurrentMaxMPerS));
  if (recipe.loop_period_s != 0.0) {
    ONESEA_RETURN_IF_ERROR(
        CheckInRange("loop_period_s", recipe.loop_period_s, kLoopPeriodMinS, kQueryTimeMaxS));
  }
  ONESEA_RETURN_IF_ERROR(ValidateAmplitude(recipe.amplitude));
  ONESEA_RETURN_IF_ERROR(CheckInRange("choppiness", recipe.choppiness, 0.0, kChoppinessMax));
  ONESEA_RETURN_IF_ERROR(ValidateCascades(recipe.cascades));
  ONESEA_RETURN_IF_ERROR(ValidateTimeline(recipe));
  return ValidateBuildCost(recipe);
}

}  // namespace onesea::sea
