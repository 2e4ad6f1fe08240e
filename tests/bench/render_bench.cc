// Time of each pass of the renderer at the default preset, software rendering or not.
//
//   render_bench [FRAMES]      default 12
//
// Prints wall and process-CPU milliseconds, the median over frames; the first frame, which compiles
// shaders, is left out. On a machine that others use, CPU is the steadier figure: two threads of
// the software renderer share it.
#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "absl/flags/flag.h"
#include "absl/flags/parse.h"
#include "absl/flags/usage.h"
#include "client/render/gl_objects.h"
#include "client/render/offscreen_context.h"
#include "client/render/renderer.h"
#include "common/base/clock.h"
#include "tests/render/test_sea.h"
#include "tests/render/test_wake.h"

ABSL_FLAG(int, frames, 12, "Pictures per size; the first is left out");
ABSL_FLAG(bool, harbour, false, "With two wakes, new in each picture, and eight bodies");
ABSL_FLAG(int, bodies, 0, "With --harbour: as many more bodies, 20 to 300 m away");
ABSL_FLAG(int, ropes, 0, "With --harbour: as many ropes of ten metres from body to body");
ABSL_FLAG(bool, shore, false, "Before an island, with the sea lower over its shelf");
ABSL_FLAG(int, samples, 0, "Samples of the geometry: 1, 4 or 0, as the driver can afford");

namespace onesea::render {
namespace {

double Median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

void Measure(Renderer& renderer, RenderFrame& frame, TestSea& sea, int width, int height,
             int frames) {
  ColorTarget target;
  target.Resize(width, height, GL_RGBA8);
  std::vector<std::vector<double>> wall, cpu;
  std::vector<double> whole;
  std::vector<std::string> names;
  for (int n = 0; n <= frames; ++n) {
    sea.FillFrame(5.0 + n / 30.0, frame);
    for (WaterPatch& patch : frame.patches) patch.version = static_cast<std::uint64_t>(n);
    renderer.MeasurePasses(true);
    renderer.Draw(frame, width, height, target.framebuffer.id());
    const std::vector<PassTime> passes = renderer.pass_times();
    renderer.MeasurePasses(false);
    const std::int64_t start_ns = SystemClock().MonotonicNs();
    renderer.Draw(frame, width, height, target.framebuffer.id());
    glFinish();
    const double ms = 1e-6 * static_cast<double>(SystemClock().MonotonicNs() - start_ns);
    if (n == 0) {
      wall.resize(passes.size());
      cpu.resize(passes.size());
      for (const PassTime& pass : passes) names.push_back(pass.name);
      continue;
    }
    for (std::size_t p = 0; p < passes.size(); ++p) {
      wall[p].push_back(passes[p].wall_ms);
      cpu[p].push_back(passes[p].cpu_ms);
    }
    whole.push_back(ms);
  }
  std::printf("%dx%d, %d samples, %s\n", width, height, frame.quality.samples,
              glGetString(GL_RENDERER));
  double wall_sum = 0.0, cpu_sum = 0.0;
  for (std::size_t p = 0; p < names.size(); ++p) {
    std::printf("  %-10s wall %7.1f ms   cpu %7.1f ms\n", names[p].c_str(), Median(wall[p]),
                Median(cpu[p]));
    wall_sum += Median(wall[p]);
    cpu_sum += Median(cpu[p]);
  }
  std::printf("  %-10s wall %7.1f ms   cpu %7.1f ms\n", "sum", wall_sum, cpu_sum);
  std::printf("  frame      wall %7.1f ms   (passes not separated)\n", Median(whole));
}

// An island of 30 m in water of 25 m, 350 m away, in samples 5 m apart.
void AddShore(RenderFrame& frame) {
  auto terrain = std::make_shared<sea::Terrain>();
  auto factors = std::make_shared<sea::AttenuationGrid>();
  constexpr int kSide = 401;
  terrain->west_m = factors->west_m = -500.0;
  terrain->south_m = factors->south_m = -1000.0;
  terrain->cell_m = factors->cell_m = 5.0;
  terrain->columns = terrain->rows = factors->columns = factors->rows = kSide;
  factors->planes = 5;
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const double r = std::hypot(-500.0 + 5.0 * i - 600.0, -1000.0 + 5.0 * j);
      const double z = -25.0 + 55.0 * std::exp(-r * r / (2.0 * 220.0 * 220.0)) +
                       2.0 * std::sin(0.05 * i) * std::sin(0.07 * j);
      terrain->elevation_m.push_back(static_cast<float>(z));
      const auto factor = static_cast<float>(std::clamp(-z / 5.0, 0.0, 1.0));
      factors->factor.insert(factors->factor.end(), 5, factor);
    }
  }
  frame.terrain = terrain;
  frame.attenuation = factors;
}

int Main(int frames) {
  auto context = OffscreenContext::Create();
  if (!context.ok()) {
    std::fprintf(stderr, "%s\n", std::string(context.status().message()).c_str());
    return 1;
  }
  auto renderer = Renderer::Create();
  if (!renderer.ok()) {
    std::fprintf(stderr, "%s\n", std::string(renderer.status().message()).c_str());
    return 1;
  }
  TestSea sea(2.1, 7.5, 2.6);
  RenderFrame frame;
  frame.quality.samples = absl::GetFlag(FLAGS_samples);
  frame.camera.position_m = {0.0, 0.0, 4.0};
  frame.camera.pitch_rad = -0.05;
  const std::vector<TestWake> wakes = HarbourWakes();
  if (absl::GetFlag(FLAGS_harbour)) {
    sea.FillFrame(5.0, frame);
    FillHarbour(sea, wakes, frame);
    for (int n = 0; n < absl::GetFlag(FLAGS_bodies); ++n) {
      HullInstance body = frame.hulls[static_cast<std::size_t>(n % 8)];
      const double range = 20.0 + 280.0 * (n * 0.618 - std::floor(n * 0.618));
      const double bearing = 0.35 * std::sin(n * 1.7);
      body.position_m.x = range * std::cos(bearing);
      body.position_m.y = range * std::sin(bearing);
      frame.hulls.push_back(body);
    }
    for (int n = 0; n < absl::GetFlag(FLAGS_ropes); ++n) {
      const Vec3d from = frame.hulls[static_cast<std::size_t>(n) % frame.hulls.size()].position_m;
      frame.ropes.push_back(
          {from + Vec3d{0, 0, 2}, from + Vec3d{6, n % 2 == 0 ? 7.0 : -7.0, 2}, 10});
    }
  }
  if (absl::GetFlag(FLAGS_shore)) AddShore(frame);
  for (const auto& [width, height] : {std::pair{640, 360}, std::pair{1280, 720}}) {
    Measure(**renderer, frame, sea, width, height, frames);
  }
  return 0;
}

}  // namespace
}  // namespace onesea::render

int main(int argc, char** argv) {
  absl::SetProgramUsageMessage("What a picture costs, pass by pass.");
  absl::ParseCommandLine(argc, argv);
  return onesea::render::Main(std::max(1, absl::GetFlag(FLAGS_frames)));
}
