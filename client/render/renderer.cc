#include "client/render/renderer.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <optional>

#include "client/render/atmosphere.h"
#include "client/render/frame_block.h"
#include "client/render/passes/classify.h"
#include "client/render/passes/hulls.h"
#include "client/render/passes/ripples.h"
#include "client/render/passes/sky.h"
#include "client/render/passes/smooth_steps.h"
#include "client/render/passes/surface.h"
#include "client/render/passes/surface_grid.h"
#include "client/render/passes/tone_map.h"
#include "client/render/patch_textures.h"
#include "client/render/sea_textures.h"
#include "common/base/check.h"
#include "common/base/clock.h"

namespace onesea::render {

namespace {

// Mesa's and Chromium's rasterisers without a graphics card.
bool IsSoftware() {
  const std::string name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  for (const char* known : {"llvmpipe", "softpipe", "SwiftShader"}) {
    if (name.find(known) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

struct Renderer::Impl {
  Impl(RipplePass r, SurfaceGridPass g, ClassifyPass c, SkyPass s, SurfacePass w, SmoothStepsPass e,
       HullPass h, ToneMapPass t)
      : ripples(std::move(r)),
        grid(std::move(g)),
        classify(std::move(c)),
        sky(std::move(s)),
        surface(std::move(w)),
        smooth_steps(std::move(e)),
        hulls(std::move(h)),
        tone(std::move(t)) {}

  // The light of the last picture, kept until sun, clouds or haze change.
  struct LightKey {
    Sun sun;
    double cloud_cover = 0.0, visibility_m = 0.0;
    friend bool operator==(const LightKey&, const LightKey&) = default;
  };

  void UpdateLight(const RenderFrame& frame);
  void UploadBlock(const FrameBlock& block);
  template <typename F>
  void Pass(const char* name, F&& draw);

  RipplePass ripples;
  SurfaceGridPass grid;
  ClassifyPass classify;
  SkyPass sky;
  SurfacePass surface;
  SmoothStepsPass smooth_steps;
  HullPass hulls;
  ToneMapPass tone;
  SeaTextures sea;
  PatchTextures patches;
  ColorTarget scene;
  VertexArray empty;
  Buffer block_buffer;
  std::optional<Atmosphere> atmosphere;
  std::optional<LightKey> light_key;
  SkyLight light;
  const int samples_default = IsSoftware() ? 1 : 4;
  bool measure = false;
  std::vector<PassTime> pass_times;
};

template <typename F>
void Renderer::Impl::Pass(const char* name, F&& draw) {
  if (!measure) {
    draw();
    return;
  }
  glFinish();
  const std::int64_t start_ns = SystemClock().MonotonicNs();
  const std::clock_t cpu_start = std::clock();
  draw();
  glFinish();
  const double cpu_ms = 1000.0 * static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
  const double wall_ms = 1e-6 * static_cast<double>(SystemClock().MonotonicNs() - start_ns);
  pass_times.push_back({name, wall_ms, cpu_ms});
}

void Renderer::Impl::UpdateLight(const RenderFrame& frame) {
  const LightKey key{frame.sun, frame.weather.cloud_cover, frame.weather.visibility_m};
  if (light_key == key) return;
  if (!light_key || light_key->visibility_m != key.visibility_m) {
    atmosphere.emplace(std::clamp(key.visibility_m, 500.0, 200'000.0));
  }
  light_key = key;
  light = ComputeSkyLight(*atmosphere, key.sun, key.cloud_cover, key.visibility_m);
  sky.SetLight(light);
}

void Renderer::Impl::UploadBlock(const FrameBlock& block) {
  glBindBuffer(GL_UNIFORM_BUFFER, block_buffer.id());
  glBufferData(GL_UNIFORM_BUFFER, sizeof(FrameBlock), &block, GL_STREAM_DRAW);
  glBindBufferBase(GL_UNIFORM_BUFFER, kFrameBlockBinding, block_buffer.id());
}

absl::StatusOr<std::unique_ptr<Renderer>> Renderer::Create() {
  ONESEA_ASSIGN_OR_RETURN(RipplePass ripples, RipplePass::Create());
  ONESEA_ASSIGN_OR_RETURN(SurfaceGridPass grid, SurfaceGridPass::Create());
  ONESEA_ASSIGN_OR_RETURN(ClassifyPass classify, ClassifyPass::Create());
  ONESEA_ASSIGN_OR_RETURN(SkyPass sky, SkyPass::Create());
  ONESEA_ASSIGN_OR_RETURN(SurfacePass surface, SurfacePass::Create());
  ONESEA_ASSIGN_OR_RETURN(SmoothStepsPass smooth_steps, SmoothStepsPass::Create());
  ONESEA_ASSIGN_OR_RETURN(HullPass hulls, HullPass::Create());
  ONESEA_ASSIGN_OR_RETURN(ToneMapPass tone, ToneMapPass::Create());
  return std::unique_ptr<Renderer>(new Renderer(std::make_unique<Impl>(
      std::move(ripples), std::move(grid), std::move(classify), std::move(sky), std::move(surface),
      std::move(smooth_steps), std::move(hulls), std::move(tone))));
}

Renderer::Renderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Renderer::~Renderer() = default;
void Renderer::MeasurePasses(bool measure) { impl_->measure = measure; }
const std::vector<PassTime>& Renderer::pass_times() const { return impl_->pass_times; }

void Renderer::Draw(const RenderFrame& frame, int width, int height, unsigned framebuffer) {
  ONESEA_CHECK(width > 0 && height > 0);
  ONESEA_CHECK(!frame.cascades.empty() && frame.cascades.size() <= kRenderCascadesMax);
  Impl& r = *impl_;
  r.pass_times.clear();
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glDisable(GL_SCISSOR_TEST);
  r.UpdateLight(frame);

  std::vector<SlopeStats> stats;
  double variance = 0.0;
  r.Pass("upload", [&] {
    for (const CascadePlanes& planes : frame.cascades) {
      stats.push_back(MeasureSlopes(planes));
      variance += stats.back().height_variance_m2;
    }
    r.sea.Upload(frame.cascades);
    r.surface.SetFoamWindow(frame.foam);
  });
  r.Pass("ripples", [&] {
    r.ripples.Draw(r.empty, frame.seed, frame.time_s, 0.66 * UnresolvedSlopeVariance(frame, stats),
                   frame.weather.wind_to_rad);
  });

  double displacement_max_m = 3.2 * std::sqrt(variance);
  for (const RegularWaveNow& wave : frame.regular_waves) displacement_max_m += wave.amplitude_m;
  displacement_max_m += LargestHeightM(frame.patches);
  const OceanGrid grid = FitOceanGrid(frame.camera, width, height, frame.quality.pixels_per_column,
                                      displacement_max_m);
  FrameBlock block = MakeFrameBlock(frame, r.light, grid, stats, r.ripples.stats(),
                                    RipplePass::kLengthM, width, height);
  if (!frame.patches.empty()) {
    r.Pass("patches", [&] {
      r.patches.Update(frame.patches, {frame.camera.position_m.x, frame.camera.position_m.y},
                       block);
    });
  }
  r.UploadBlock(block);
  const int samples = frame.quality.samples == 0 ? r.samples_default : frame.quality.samples;
  r.scene.Resize(width, height, GL_RGBA16F);
  r.Pass("small sky", [&] { r.sky.DrawSmall(r.empty, block, width, height); });
  const bool hulls = !frame.hulls.empty() && r.hulls.Prepare(frame, block, width, height);
  HullMirror mirror;
  if (hulls) {
    r.Pass("mirror", [&] { mirror = r.hulls.DrawMirror(width, height, r.sea, r.patches, r.sky); });
  }
  r.Pass("geometry", [&] { r.grid.Draw(grid, r.sea, r.patches, width, height, samples); });
  r.Pass("classify", [&] { r.classify.Draw(r.empty, r.scene, r.grid); });
  r.Pass("sky", [&] { r.sky.Place(r.empty, block, r.scene); });
  r.Pass("surface", [&] {
    SurfaceVariant variant;
    variant.underside = frame.camera.position_m.z < displacement_max_m;
    variant.ripples = frame.quality.ripples;
    variant.regular_waves = !frame.regular_waves.empty();
    variant.cascades = static_cast<int>(frame.cascades.size());
    variant.patches = static_cast<int>(block.counts.w);
    r.surface.Draw(r.empty, r.scene, r.grid, r.sea, r.patches, r.ripples, r.sky, mirror, variant);
  });
  if (samples == 1) {
    r.Pass("steps", [&] { r.smooth_steps.Draw(r.empty, r.scene, r.grid, r.classify); });
  }
  if (hulls) r.Pass("hulls", [&] { r.hulls.Draw(r.empty, r.scene, r.grid, r.sky); });
  r.Pass("tone map", [&] { r.tone.Draw(r.empty, r.scene, framebuffer, frame.quality.bloom); });
}

}  // namespace onesea::render
