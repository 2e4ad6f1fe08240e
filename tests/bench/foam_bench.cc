// Foam: a step of one lattice instant, a step that also uncovers new cells, and the pre-roll of a
// newcomer.
#include <benchmark/benchmark.h>

#include "common/sea/components.h"
#include "common/sea/foam.h"

namespace onesea::sea {
namespace {

std::shared_ptr<const Components> Sea() {
  Recipe recipe;
  recipe.cascades = DefaultCascades();
  recipe.timeline.resize(1);
  PiersonMoskowitzSystem system;
  system.wind_speed_19_5_m_per_s = 15.0;
  recipe.timeline[0].sea.systems = {system};
  recipe.timeline[0].sea.wind_speed_m_per_s = 14.6;
  return *BuildComponents(recipe);
}

void BM_FoamStep(benchmark::State& state) {
  FoamWindow window(Sea(), {});
  window.MoveTo(SimTime{}, {});
  double t = 0.0, x = 0.0;
  for (auto _ : state) {
    t += 0.25;
    x += static_cast<double>(state.range(0));
    window.MoveTo(SimTime::FromSeconds(t), {x, 0.0});
  }
}
BENCHMARK(BM_FoamStep)->ArgName("metres_per_step")->Arg(0)->Arg(3)->Unit(benchmark::kMillisecond);

void BM_FoamPreRoll(benchmark::State& state) {
  const auto sea = Sea();
  for (auto _ : state) {
    FoamWindow window(sea, {});
    window.MoveTo(SimTime{}, {});
    benchmark::DoNotOptimize(window.Cells().data());
  }
}
BENCHMARK(BM_FoamPreRoll)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace onesea::sea
