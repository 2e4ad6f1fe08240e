// Synthesis of 8 fields against B(N): the best bare FFTW for the same fields, four packed c2c on
// padded rows, planned PATIENT, in this very process. Compare ratios, not microseconds.
#include <benchmark/benchmark.h>
#include <fftw3.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <map>
#include <vector>

#include "common/sea/evolve.h"
#include "common/sea/fft_strip.h"
#include "common/sea/surface.h"
#include "tests/bench/thread_seconds.h"
#include "tests/sea/fake_sea.h"

namespace onesea::sea {
namespace {

std::shared_ptr<const Components> Sea() {
  static const std::shared_ptr<const Components> sea = FakeSea({.lengths_m = {500.0}});
  return sea;
}

struct BareFftw {
  explicit BareFftw(int n) : n(n), pitch(n + 8) {
    for (auto& grid : in) grid = Alloc();
    for (auto& grid : out) grid = Alloc();
    const int sizes[2] = {n, n}, padded[2] = {n, pitch};
    in_place = fftwf_plan_many_dft(2, sizes, 1, in[0], padded, 1, 0, in[0], padded, 1, 0,
                                   FFTW_BACKWARD, FFTW_PATIENT);
    apart = fftwf_plan_many_dft(2, sizes, 1, in[0], padded, 1, 0, out[0], padded, 1, 0,
                                FFTW_BACKWARD, FFTW_PATIENT);
    for (auto& grid : in) std::memset(grid, 0, Bytes());
  }
  std::size_t Bytes() const { return sizeof(fftwf_complex) * n * pitch; }
  fftwf_complex* Alloc() { return fftwf_alloc_complex(static_cast<std::size_t>(n) * pitch); }
  void RunInPlace() {
    for (auto& grid : in) fftwf_execute_dft(in_place, grid, grid);
  }
  void RunApart() {
    for (int f = 0; f < 4; ++f) fftwf_execute_dft(apart, in[f], out[f]);
  }
  int n, pitch;
  fftwf_complex* in[4];
  fftwf_complex* out[4];
  fftwf_plan in_place, apart;
};

BareFftw& Bare(int n) {
  static std::map<int, std::unique_ptr<BareFftw>> bare;
  if (!bare[n]) bare[n] = std::make_unique<BareFftw>(n);
  return *bare[n];
}

// B(N), the better of in place and out of place.
double BareSeconds(int n) {
  BareFftw& bare = Bare(n);
  return std::min(MedianThreadSeconds([&] { bare.RunInPlace(); }),
                  MedianThreadSeconds([&] { bare.RunApart(); }));
}

void BM_Synthesise8Fields(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  const auto kind = static_cast<TransformKind>(state.range(1));
  Synthesiser synthesiser(Sea(), 0, n, kRenderFields, kind);
  CascadeFields fields(n, kRenderFields);
  std::int64_t flicks = 0;
  const auto run = [&] { synthesiser.Evaluate(SimTime{flicks += 11760000}, fields); };
  for (auto _ : state) run();
  // In turns, so that a busy neighbour slows both.
  double own_s = 1e9, bare_s = 1e9;
  for (int round = 0; round < 5; ++round) {
    own_s = std::min(own_s, MedianThreadSeconds(run));
    bare_s = std::min(bare_s, BareSeconds(n));
  }
  Evolver evolver(Sea(), 0, n, kRenderFields);
  const std::size_t room = evolver.spectrum_floats() + kStripLanes;
  const FloatArray spectrum = AllocateZeros<float>(2 * room);
  const double evolve_s = MedianThreadSeconds([&] {
    evolver.SetTime(SimTime{flicks += 11760000});
    for (int f = 0; f < 8; f += 2) {
      evolver.Pack(static_cast<Field>(f), static_cast<Field>(f + 1), spectrum.get() + kStripLanes,
                   spectrum.get() + kStripLanes + room);
    }
  });
  state.counters["us"] = own_s * 1e6;
  state.counters["B_us"] = bare_s * 1e6;
  state.counters["ratio_to_B"] = own_s / bare_s;
  state.counters["evolve_and_pack_share"] = evolve_s / own_s;
}
BENCHMARK(BM_Synthesise8Fields)
    ->ArgNames({"N", "fftw"})
    ->Args({128, 1})
    ->Args({256, 1})
    ->Args({512, 1})
    ->Args({256, 2})
    ->Unit(benchmark::kMicrosecond);

void BM_MemcpyBound(benchmark::State& state) {
  // Writing the 8 planes at 256² alone, for context.
  std::vector<float> from(8 * 256 * 256), to(from.size());
  for (auto _ : state) {
    std::memcpy(to.data(), from.data(), from.size() * sizeof(float));
    benchmark::DoNotOptimize(to.data());
  }
}
// Two cascades on two cores: every thread its own synthesiser. items_per_second of threads:2 over
// threads:1 is the gain (2 at best; on a busy machine it says little).
void BM_CascadePerThread(benchmark::State& state) {
  Synthesiser synthesiser(Sea(), 0, 256, kRenderFields);
  CascadeFields fields(256, kRenderFields);
  std::int64_t flicks = 0;
  for (auto _ : state) synthesiser.Evaluate({flicks += kFlicksPerSecond / 60}, fields);
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(BM_CascadePerThread)->ThreadRange(1, 2)->UseRealTime()->Unit(benchmark::kMicrosecond);

BENCHMARK(BM_MemcpyBound)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace onesea::sea
