#include "common/sea/component_hash.h"

#include "common/base/hash.h"

namespace onesea::sea {
namespace {

template <typename T>
void AddAll(Hash64& hash, const std::vector<T>& values) {
  hash.Add(static_cast<std::uint64_t>(values.size()));
  for (const T value : values) hash.Add(value);
}

// What the recipe adds to the components: how they move, mix and are shown. The spectra themselves
// are in the variances.
void AddRecipe(Hash64& hash, const Recipe& recipe) {
  hash.Add(recipe.sea_model_version);
  hash.Add(recipe.seed);
  hash.Add(recipe.tick_rate_hz);
  hash.Add(recipe.depth_m);
  hash.Add(recipe.current_m_per_s.x);
  hash.Add(recipe.current_m_per_s.y);
  hash.Add(recipe.loop_period_s);
  hash.Add(static_cast<int>(recipe.amplitude));
  hash.Add(recipe.choppiness);
  hash.Add(static_cast<std::uint64_t>(recipe.timeline.size()));
  for (const WeatherEntry& entry : recipe.timeline) {
    hash.Add(entry.start_tick);
    hash.Add(entry.span_ticks);
    hash.Add(entry.sea.wind_speed_m_per_s);
    hash.Add(entry.sea.wind_to_rad);
  }
}

void AddCascade(Hash64& hash, const CascadeComponents& waves) {
  hash.Add(waves.cascade.length_m);
  hash.Add(waves.cascade.rotation_rad);
  hash.Add(waves.cascade.wavenumber_min_rad_per_m);
  hash.Add(waves.cascade.wavenumber_max_rad_per_m);
  hash.Add(waves.cascade.query_grid_size);
  AddAll(hash, waves.i);
  AddAll(hash, waves.j);
  AddAll(hash, waves.turns_per_flick);
  AddAll(hash, waves.phase_turns);
  AddAll(hash, waves.kx_rad_per_m);
  AddAll(hash, waves.ky_rad_per_m);
  AddAll(hash, waves.intrinsic_rad_per_s);
  for (const std::vector<float>& variance : waves.variance_m2) AddAll(hash, variance);
}

}  // namespace

std::uint64_t HashOf(const Components& components) {
  Hash64 hash;
  AddRecipe(hash, components.recipe);
  for (const CascadeComponents& cascade : components.cascades) AddCascade(hash, cascade);
  for (const RegularComponent& wave : components.regular) {
    hash.Add(wave.kx_rad_per_m);
    hash.Add(wave.ky_rad_per_m);
    hash.Add(wave.intrinsic_rad_per_s);
    hash.Add(wave.turns_per_flick);
    hash.Add(wave.phase_turns);
    AddAll(hash, wave.variance_m2);
  }
  AddAll(hash, components.unresolved_mss);
  AddAll(hash, components.lost_variance_m2);
  return hash.value();
}

}  // namespace onesea::sea
