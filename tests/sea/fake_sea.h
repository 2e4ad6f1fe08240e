#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "common/sea/components.h"
#include "common/sea/constants.h"
#include "common/sea/dispersion.h"

/// Components made by hand, so that synthesis is tested apart from spectra: random phases on every
/// lattice point of an annulus, with variances that fall as k⁻⁴.
namespace onesea::sea {

struct FakeSeaOptions {
  std::vector<double> lengths_m = {613.0, 171.0, 47.0, 13.0};
  int index_max = 32;
  double hs_m = 3.0;
  double depth_m = 0.0;
  double choppiness = 1.0;
  Vec2d current_m_per_s = {};
  double peak_rad_per_m = 0.05;  ///< longer waves than this are weak
  bool one_sided = false;        ///< only waves with a component towards +x
  int query_grid_size = 256;
  std::uint64_t seed = 1;
};

inline std::uint64_t NextRandom(std::uint64_t& state) {  // SplitMix64
  std::uint64_t z = (state += 0x9e3779b97f4a7c15ULL);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}
inline double NextUnit(std::uint64_t& state) {
  return static_cast<double>(NextRandom(state) >> 11) * 0x1p-53;
}

inline double Sigma(double k, double depth_m) {
  const double deep = kGravity * k + kSurfaceTensionOverDensity * k * k * k;
  return std::sqrt(depth_m > 0 ? deep * std::tanh(k * depth_m) : deep);
}

inline std::shared_ptr<Components> FakeSea(const FakeSeaOptions& options = {}) {
  auto sea = std::make_shared<Components>();
  Recipe& recipe = sea->recipe;
  recipe.depth_m = options.depth_m;
  recipe.choppiness = options.choppiness;
  recipe.current_m_per_s = options.current_m_per_s;
  recipe.timeline.resize(1);
  std::uint64_t random = options.seed;
  double total = 0.0, k_below = 0.0;
  for (std::size_t c = 0; c < options.lengths_m.size(); ++c) {
    CascadeComponents waves;
    waves.cascade.length_m = options.lengths_m[c];
    waves.cascade.rotation_rad = 0.37 * static_cast<double>(c);
    waves.cascade.query_grid_size = options.query_grid_size;
    const double unit = 2.0 * kPi / options.lengths_m[c];
    waves.cascade.wavenumber_min_rad_per_m = k_below;
    waves.cascade.wavenumber_max_rad_per_m = unit * options.index_max;
    waves.variance_m2.resize(1);
    const double co = std::cos(waves.cascade.rotation_rad),
                 si = std::sin(waves.cascade.rotation_rad);
    for (int j = -options.index_max; j <= options.index_max; ++j) {
      for (int i = -options.index_max; i <= options.index_max; ++i) {
        const double k = unit * std::hypot(i, j);
        if ((i == 0 && j == 0) || k < k_below || k > unit * (options.index_max + 0.5)) continue;
        const double kx = unit * (co * i - si * j), ky = unit * (si * i + co * j);
        const double spread =
            options.one_sided ? (kx > 0 ? kx * kx / (k * k) : 0.0) : 0.2 + 0.8 * kx * kx / (k * k);
        const double energy = spread * std::exp(-std::pow(options.peak_rad_per_m / k, 2)) *
                              std::pow(k, -4) * unit * unit;
        const double sigma = Sigma(k, options.depth_m);
        waves.i.push_back(static_cast<std::int16_t>(i));
        waves.j.push_back(static_cast<std::int16_t>(j));
        waves.kx_rad_per_m.push_back(static_cast<float>(kx));
        waves.ky_rad_per_m.push_back(static_cast<float>(ky));
        waves.intrinsic_rad_per_s.push_back(static_cast<float>(sigma));
        waves.turns_per_flick.push_back(
            TurnsPerFlick(sigma + kx * options.current_m_per_s.x + ky * options.current_m_per_s.y));
        waves.phase_turns.push_back(static_cast<std::uint32_t>(NextRandom(random) >> 32));
        waves.variance_m2[0].push_back(static_cast<float>(energy));
        total += energy;
      }
    }
    k_below = unit * (options.index_max + 0.5);
    recipe.cascades.push_back(waves.cascade);
    sea->cascades.push_back(std::move(waves));
  }
  const double scale = options.hs_m * options.hs_m / 16.0 / total;
  for (auto& waves : sea->cascades) {
    for (float& v : waves.variance_m2[0]) v = static_cast<float>(v * scale);
  }
  return sea;
}

}  // namespace onesea::sea
