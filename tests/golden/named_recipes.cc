#include "tests/golden/named_recipes.h"

#include "common/sea/sea_codes.h"

namespace onesea::sea {
namespace {

Recipe RecipeOf(SeaState sea) {
  Recipe recipe;
  recipe.cascades = DefaultCascades();
  recipe.timeline.push_back({0, 0, std::move(sea)});
  return recipe;
}

BuoySpectrum Buoy(bool directional) {
  BuoySpectrum s;
  for (int n = 0; n < 40; ++n) {
    const float x = static_cast<float>(n) / 40.0f;
    s.frequency_hz.push_back(0.035f + 0.0115f * static_cast<float>(n));
    s.density_m2_per_hz.push_back(90.0f * x * x * (1.0f - x) * (1.0f - x) * (1.0f - x));
    if (!directional) continue;
    s.mean_wave_to_rad.push_back(1.0f + 0.5f * x);
    s.principal_wave_to_rad.push_back(1.1f + 0.4f * x);
    s.r1.push_back(0.9f - 0.4f * x);
    s.r2.push_back(0.8f - 0.6f * x);
  }
  s.hs_m = 3.1;
  s.fallback_wave_to_rad = 2.5;
  s.fallback_spreading.kind = SpreadingKind::kMitsuyasu;
  return s;
}

GridSpectrum Grid() {
  GridSpectrum s;
  for (int m = 0; m < 24; ++m) s.wave_to_rad.push_back(0.26f * static_cast<float>(m));
  for (int n = 0; n < 25; ++n) {
    s.frequency_hz.push_back(0.04f + 0.02f * static_cast<float>(n));
    for (int m = 0; m < 24; ++m) {
      const float lobe = 1.0f - 0.04f * static_cast<float>((m - 7) * (m - 7));
      s.density_m2_per_hz_rad.push_back(
          lobe > 0.0f ? lobe * static_cast<float>(n * (25 - n)) / 90.0f : 0.0f);
    }
  }
  return s;
}

Recipe Coast() {
  JonswapSystem wind_sea{1.4, 5.5, 3.3, 0.4, {SpreadingKind::kHasselmann, 10.0, 0.0}, true};
  JonswapSystem swell{0.9, 13.0, 6.0, -0.3, {SpreadingKind::kDonelanBanner, 10.0, 0.6}, true};
  Recipe recipe = RecipeOf({"coast", {wind_sea, swell}, {{0.2, 9.0, 0.1, 0.5}}, 9.0, 0.4});
  recipe.seed = 0x123456789abcdef0ULL;
  recipe.depth_m = 12.5;
  recipe.current_m_per_s = {0.8, -0.3};
  recipe.loop_period_s = 90.0;
  recipe.choppiness = 0.9;
  return recipe;
}

Recipe Families() {
  PhillipsSystem phillips;
  phillips.small_wave_cutoff_m = 0.1;
  phillips.directional_exponent = 3.5;
  FetchJonswapSystem fetch;
  fetch.spreading = {SpreadingKind::kMitsuyasu, 10.0, 0.3};
  PiersonMoskowitzSystem moskowitz;
  moskowitz.spreading = {SpreadingKind::kCosine2s, 12.0, 0.0};
  Recipe recipe = RecipeOf(
      {"families", {phillips, fetch, moskowitz, ElfouhailySystem{9.0, 1.3, 2.0}}, {}, 9.0, 0.0});
  recipe.amplitude = AmplitudeKind::kRayleigh;
  recipe.seed = 77;
  return recipe;
}

Recipe Measured() {
  Recipe recipe = RecipeOf({"measured", {Buoy(true), Buoy(false), Grid()}, {}, 12.0, 1.0});
  recipe.seed = 41010;
  recipe.depth_m = 840.0;
  return recipe;
}

Recipe Storm() {
  Recipe recipe = RecipeOf(*SeaOfBeaufort(5, 0.5));
  recipe.timeline.push_back({3600, 7200, *SeaOfBeaufort(9, 0.9)});
  recipe.timeline.push_back({7200, 3600, *SeaOfWmoCode(4, 1.5)});
  recipe.cascades.resize(3);
  recipe.cascades[0].query_grid_size = 512;
  recipe.tick_rate_hz = 50;
  return recipe;
}

}  // namespace

std::vector<NamedRecipe> NamedRecipes() {
  return {{"default", RecipeOf({"default", {JonswapSystem{}}, {}, 8.0, 0.0})},
          {"coast", Coast()},
          {"families", Families()},
          {"measured", Measured()},
          {"storm", Storm()}};
}

}  // namespace onesea::sea
