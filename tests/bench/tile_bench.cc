// Tiles of the interaction layer: time to encode and decode one frame of 256 x 256 cells, its bytes
// beside the 262144 of raw floats, and the worst error. CPU time; the scene is computed outside.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

#include "common/wire/tile_encoder.h"
#include "common/wire/tile_store.h"
#include "tests/wire/pool_scene.h"

namespace onesea::wire {
namespace {

constexpr double kRawBytes = 4.0 * PoolScene::kSide * PoolScene::kSide;
constexpr int kFrames = 60;

double Bytes(const TileUpdate& update) {
  std::size_t bytes = 0;
  for (const std::string& blob : update.blobs) bytes += blob.size() + 2;  // tag and length
  return static_cast<double>(bytes);
}

struct Recording {
  std::vector<std::vector<float>> frames;
  RegionLayout layout;
};

Recording Record(int sources, double height_step_m) {
  PoolScene scene(sources);
  Recording recording{{}, scene.field(height_step_m).layout};
  for (int n = 0; n < kFrames; ++n) {
    scene.Step();
    const TileField field = scene.field();
    recording.frames.emplace_back(field.height_m.begin(), field.height_m.end());
  }
  return recording;
}

void BM_Encode(benchmark::State& state) {
  const Recording recording =
      Record(static_cast<int>(state.range(0)), 1e-3 * static_cast<double>(state.range(1)));
  TileEncoder encoder;
  std::size_t frame = 0;
  const auto encode = [&]() -> const TileUpdate& {
    const TileField field{recording.layout, recording.frames[frame++ % kFrames], {}};
    return encoder.Encode({&field, 1});
  };
  encode();
  for (auto _ : state) benchmark::DoNotOptimize(encode().blobs.size());
  frame = 0;
  TileEncoder measured;
  TileStore store;
  double bytes = 0.0, worst_m = 0.0, sum_squares = 0.0;
  for (std::size_t n = 0; n < kFrames; ++n) {
    const TileField field{recording.layout, recording.frames[n], {}};
    const TileUpdate& update = measured.Encode({&field, 1});
    if (n > 0) bytes += Bytes(update) / (kFrames - 1);
    store.Apply(update, n == 0).IgnoreError();
    for (std::size_t cell = 0; cell < field.height_m.size(); ++cell) {
      const double error = std::abs(field.height_m[cell] - store.fields()[0].height_m[cell]);
      worst_m = std::max(worst_m, error);
      sum_squares += error * error;
    }
  }
  state.counters["bytes_a_frame"] = bytes;
  state.counters["raw_over_bytes"] = kRawBytes / bytes;
  state.counters["keyframe_bytes"] = Bytes(measured.Keyframe());
  state.counters["worst_mm"] = 1e3 * worst_m;
  state.counters["rms_mm"] = 1e3 * std::sqrt(sum_squares * 4.0 / (kFrames * kRawBytes));
}
BENCHMARK(BM_Encode)
    ->ArgNames({"sources", "step_mm"})
    ->ArgsProduct({{4, 16}, {1, 2, 4}})
    ->Unit(benchmark::kMicrosecond);

void BM_Decode(benchmark::State& state) {
  const Recording recording = Record(static_cast<int>(state.range(0)), 1e-3);
  TileEncoder encoder;
  std::vector<TileUpdate> updates;
  for (const std::vector<float>& heights : recording.frames) {
    const TileField field{recording.layout, heights, {}};
    updates.push_back(encoder.Encode({&field, 1}));
  }
  TileStore store;
  std::size_t frame = 0;
  for (auto _ : state) {
    const bool first = frame % kFrames == 0;
    if (!store.Apply(updates[frame++ % kFrames], first).ok()) state.SkipWithError("refused");
  }
}
BENCHMARK(BM_Decode)->ArgName("sources")->Arg(4)->Arg(16)->Unit(benchmark::kMicrosecond);

// The price of a session whose water rests.
void BM_EncodeCalm(benchmark::State& state) {
  const std::vector<float> heights(PoolScene::kSide * PoolScene::kSide, 0.5e-3F);
  const TileField field{PoolScene(0).field().layout, heights, heights};
  TileEncoder encoder;
  for (auto _ : state) benchmark::DoNotOptimize(encoder.Encode({&field, 1}).blobs.size());
}
BENCHMARK(BM_EncodeCalm)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace onesea::wire
