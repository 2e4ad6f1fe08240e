// From a recipe to its components, one core: a part of joining a session (< 300 ms in all). Prints
// the hash too, so that a faster version that gives another sea is noticed.

#include <benchmark/benchmark.h>

#include <cinttypes>
#include <cstdio>

#include "common/base/real_math.h"
#include "common/sea/components.h"
#include "common/sea/wave_spectrum.h"
#include "tests/golden/named_recipes.h"

namespace onesea::sea {
namespace {

void BuildNamed(benchmark::State& state, const NamedRecipe& named) {
  std::uint64_t hash = 0;
  for (auto _ : state) {
    const auto components = BuildComponents(named.recipe);
    hash = (*components)->hash;
    benchmark::DoNotOptimize(hash);
  }
  char text[32];
  std::snprintf(text, sizeof text, "hash %016" PRIx64, hash);
  state.SetLabel(text);
}

void TabulateJonswap(benchmark::State& state) {
  const auto spectrum = MakeWaveSpectrum(JonswapSystem{}, 0.0);
  for (auto _ : state) {
    const SpectrumTable table(*spectrum, 5e-5, 16.0);
    benchmark::DoNotOptimize(table.Density({0.1, 0.0}, 0.1));
  }
}
BENCHMARK(TabulateJonswap)->Unit(benchmark::kMillisecond);

template <double (*Function)(double)>
void RealMath(benchmark::State& state) {
  double x = 0.1;
  for (auto _ : state) {
    benchmark::DoNotOptimize(Function(x));
    x = x < 6.0 ? x + 0.01 : 0.1;
  }
}
BENCHMARK(RealMath<real::Exp>);
BENCHMARK(RealMath<real::Log>);
BENCHMARK(RealMath<real::Sin>);
BENCHMARK(RealMath<real::Tanh>);

const bool registered = [] {
  for (const NamedRecipe& named : NamedRecipes()) {
    benchmark::RegisterBenchmark(("BuildComponents/" + named.name).c_str(), BuildNamed, named)
        ->Unit(benchmark::kMillisecond);
  }
  return true;
}();

}  // namespace
}  // namespace onesea::sea
