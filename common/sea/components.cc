#include "common/sea/components.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/base/range_check.h"
#include "common/base/real_math.h"
#include "common/base/rng.h"
#include "common/sea/cell_integral.h"
#include "common/sea/component_hash.h"
#include "common/sea/constants.h"
#include "common/sea/dispersion.h"
#include "common/sea/wave_spectrum.h"

namespace onesea::sea {
namespace {

// Below this a spectrum holds nothing: 63 km, three minutes.
constexpr double kSpectrumBeginRadPerM = 1e-4;
// Smaller variances become 0: no wave is a subnormal float, which some machines flush.
constexpr double kVarianceMinM2 = 1e-30;

struct Band {
  double low = 0.0;
  double high = 0.0;
};

std::vector<Band> SortedBands(const std::vector<Cascade>& cascades) {
  std::vector<Band> bands;
  bands.reserve(cascades.size());
  for (const Cascade& c : cascades) {
    bands.push_back({c.wavenumber_min_rad_per_m, c.wavenumber_max_rad_per_m});
  }
  std::sort(bands.begin(), bands.end(), [](Band a, Band b) { return a.low < b.low; });
  return bands;
}

float ToFloat(double variance_m2) {
  return variance_m2 < kVarianceMinM2 ? 0.0f : static_cast<float>(variance_m2);
}

// The frequency at a fixed place, in the integer form that is the wave's true frequency.
std::uint64_t TurnsPerFlickOf(Vec2d k, double intrinsic_rad_per_s, const Recipe& recipe) {
  const double omega = intrinsic_rad_per_s + Dot(k, recipe.current_m_per_s);
  return TurnsPerFlick(RoundToLoop(omega, recipe.loop_period_s));
}

// Fills everything but the variances; returns the Rayleigh factor of each wave.
std::vector<double> FillWaves(const Recipe& recipe, int cascade, const Lattice& lattice,
                              const std::vector<Lattice::Index>& waves, CascadeComponents& out) {
  const std::array<std::uint32_t, 2> key = {static_cast<std::uint32_t>(recipe.seed),
                                            static_cast<std::uint32_t>(recipe.seed >> 32)};
  std::vector<double> factors;
  factors.reserve(waves.size());
  for (const Lattice::Index wave : waves) {
    const Vec2d k = lattice.WaveVector(wave.i, wave.j);
    const double sigma = IntrinsicFrequency(Norm(k), recipe.depth_m);
    const auto random =
        Philox4x32({static_cast<std::uint32_t>(cascade), static_cast<std::uint32_t>(wave.i),
                    static_cast<std::uint32_t>(wave.j), 0},
                   key);
    out.i.push_back(static_cast<std::int16_t>(wave.i));
    out.j.push_back(static_cast<std::int16_t>(wave.j));
    out.turns_per_flick.push_back(TurnsPerFlickOf(k, sigma, recipe));
    out.phase_turns.push_back(random[0]);
    out.kx_rad_per_m.push_back(static_cast<float>(k.x));
    out.ky_rad_per_m.push_back(static_cast<float>(k.y));
    out.intrinsic_rad_per_s.push_back(static_cast<float>(sigma));
    // |Gaussian|² over its mean is exponential.
    factors.push_back(recipe.amplitude == AmplitudeKind::kRayleigh
                          ? -real::Log(UnitInterval(random[1], random[2]))
                          : 1.0);
  }
  return factors;
}

// Variance of what lies outside every wave's cell ∩ band, and the slope variance above the last
// band.
struct Rest {
  double lost_variance_m2 = 0.0;
  double unresolved_mss = 0.0;
};

Rest RestOf(const WaveSpectrum& spectrum, const SpectrumTable& table, const Recipe& recipe) {
  Rest rest;
  double from = kSpectrumBeginRadPerM;
  for (const Band band : SortedBands(recipe.cascades)) {
    if (band.low > from) rest.lost_variance_m2 += RadialMoment(spectrum, from, band.low, 0);
    from = std::max(from, band.high);
  }
  if (from < spectrum.EndRadPerM()) {
    rest.lost_variance_m2 += RadialMoment(spectrum, from, spectrum.EndRadPerM(), 0);
    rest.unresolved_mss = RadialMoment(spectrum, from, spectrum.EndRadPerM(), 2);
  }
  for (const Cascade& cascade : recipe.cascades) {
    const Lattice lattice(cascade);
    if (lattice.MeetsBand({0, 0})) rest.lost_variance_m2 += lattice.Variance({0, 0}, table);
  }
  return rest;
}

// Wavenumbers at which cells are sampled, with room to spare.
Band TableRange(const std::vector<Cascade>& cascades) {
  Band range{1e9, 0.0};
  for (const Cascade& cascade : cascades) {
    range.low = std::min(range.low, Lattice(cascade).cell_rad_per_m() / 64.0);
    range.high = std::max(range.high, cascade.wavenumber_max_rad_per_m);
  }
  return range;
}

// Adds weather entry `m` to every cascade. `variance`: per cascade, per wave, zero on entry.
void AddEntry(const Recipe& recipe, const SeaState& sea, const std::vector<Lattice>& lattices,
              const std::vector<std::vector<Lattice::Index>>& waves,
              std::vector<std::vector<double>>& variance, Rest& rest) {
  const Band range = TableRange(recipe.cascades);
  for (const WaveSystem& system : sea.systems) {
    const auto spectrum = MakeWaveSpectrum(system, recipe.depth_m);
    const SpectrumTable table(*spectrum, range.low, range.high);
    for (std::size_t c = 0; c < lattices.size(); ++c) {
      for (std::size_t n = 0; n < waves[c].size(); ++n) {
        variance[c][n] += lattices[c].Variance(waves[c][n], table);
      }
    }
    const Rest more = RestOf(*spectrum, table, recipe);
    rest.lost_variance_m2 += more.lost_variance_m2;
    rest.unresolved_mss += more.unresolved_mss;
  }
}

bool IsSameWave(const RegularWave& a, const RegularWave& b) {
  return a.period_s == b.period_s && a.wave_to_rad == b.wave_to_rad && a.phase_rad == b.phase_rad;
}

RegularComponent MakeRegular(const RegularWave& wave, const Recipe& recipe) {
  RegularComponent out;
  out.intrinsic_rad_per_s = 2.0 * kPi / wave.period_s;
  const double k = WavenumberOf(out.intrinsic_rad_per_s, recipe.depth_m);
  const real::SinCosPair direction = real::SinCos(wave.wave_to_rad);
  out.kx_rad_per_m = k * direction.cos;
  out.ky_rad_per_m = k * direction.sin;
  out.turns_per_flick =
      TurnsPerFlickOf({out.kx_rad_per_m, out.ky_rad_per_m}, out.intrinsic_rad_per_s, recipe);
  out.phase_turns = TurnsOfAngle(wave.phase_rad);
  out.variance_m2.assign(recipe.timeline.size(), 0.0);
  return out;
}

// One component per distinct wave of the whole timeline, so that a wave listed by two entries keeps
// its phase and changes its amplitude. Listed twice by one entry, amplitudes add.
std::vector<RegularComponent> BuildRegular(const Recipe& recipe) {
  std::vector<RegularWave> distinct;
  std::vector<RegularComponent> components;
  for (std::size_t m = 0; m < recipe.timeline.size(); ++m) {
    for (const RegularWave& wave : recipe.timeline[m].sea.regular_waves) {
      const auto same = std::find_if(distinct.begin(), distinct.end(), [&wave](const auto& other) {
        return IsSameWave(wave, other);
      });
      const auto index = static_cast<std::size_t>(same - distinct.begin());
      if (same == distinct.end()) {
        distinct.push_back(wave);
        components.push_back(MakeRegular(wave, recipe));
      }
      double& variance = components[index].variance_m2[m];
      const double amplitude = std::sqrt(2.0 * variance) + wave.amplitude_m;
      variance = 0.5 * (amplitude * amplitude);
    }
  }
  return components;
}

// Variance of the whole surface in weather entry `m`.
double EntryVariance(const Components& components, std::size_t m) {
  double sum = 0.0;
  for (const CascadeComponents& cascade : components.cascades) {
    for (const float variance : cascade.variance_m2[m]) sum += static_cast<double>(variance);
  }
  for (const RegularComponent& wave : components.regular) sum += wave.variance_m2[m];
  return sum;
}

absl::Status CheckHeights(const Components& components) {
  for (std::size_t m = 0; m < components.recipe.timeline.size(); ++m) {
    const double hs_m = 4.0 * std::sqrt(EntryVariance(components, m));
    ONESEA_RETURN_IF_ERROR(CheckInRange(
        absl::StrCat("timeline[", m, "].sea: Hs of all its waves [m]"), hs_m, 0.0, kSeaHsMaxM));
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<std::shared_ptr<const Components>> BuildComponents(const Recipe& recipe) {
  ONESEA_RETURN_IF_ERROR(ValidateRecipe(recipe));
  auto out = std::make_shared<Components>();
  out->recipe = recipe;
  std::vector<Lattice> lattices;
  std::vector<std::vector<Lattice::Index>> waves;
  std::vector<std::vector<double>> factors;
  for (std::size_t c = 0; c < recipe.cascades.size(); ++c) {
    lattices.emplace_back(recipe.cascades[c]);
    waves.push_back(lattices[c].Waves());
    out->cascades.emplace_back().cascade = recipe.cascades[c];
    factors.push_back(
        FillWaves(recipe, static_cast<int>(c), lattices[c], waves[c], out->cascades[c]));
  }
  for (const WeatherEntry& entry : recipe.timeline) {
    std::vector<std::vector<double>> variance;
    variance.reserve(waves.size());
    for (const auto& list : waves) variance.emplace_back(list.size(), 0.0);
    Rest rest;
    AddEntry(recipe, entry.sea, lattices, waves, variance, rest);
    for (std::size_t c = 0; c < waves.size(); ++c) {
      auto& row = out->cascades[c].variance_m2.emplace_back();
      row.reserve(waves[c].size());
      for (std::size_t n = 0; n < waves[c].size(); ++n) {
        row.push_back(ToFloat(variance[c][n] * factors[c][n]));
      }
    }
    out->lost_variance_m2.push_back(rest.lost_variance_m2);
    out->unresolved_mss.push_back(rest.unresolved_mss);
  }
  out->regular = BuildRegular(recipe);
  ONESEA_RETURN_IF_ERROR(CheckHeights(*out));
  out->hash = HashOf(*out);
  return out;
}

double VarianceAt(const Components& components, SimTime time) {
  const std::vector<double> weights = WeatherWeights(components.recipe, time);
  double total = 0.0;
  for (std::size_t m = 0; m < weights.size(); ++m) {
    total += weights[m] * EntryVariance(components, m);
  }
  return total;
}

}  // namespace onesea::sea
