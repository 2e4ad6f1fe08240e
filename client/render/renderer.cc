#include "client/render/renderer.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <optional>
#include <span>

#include "client/render/atmosphere.h"
#include "client/render/attenuation_texture.h"
#include "client/render/frame_block.h"
#include "client/render/ground_textures.h"
#include "client/render/passes/classify.h"
#include "client/render/passes/hulls.h"
#include "client/render/passes/ripples.h"
#include "client/render/passes/ropes.h"
#include "client/render/passes/sky.h"
#include "client/render/passes/smooth_steps.h"
#include "client/render/passes/spray.h"
#include "client/render/passes/surface.h"
#include "client/render/passes/surface_grid.h"
#include "client/render/passes/terrain.h"
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
       HullPass h, RopePass o, TerrainPass l, SprayPass d, ToneMapPass t)
      : ripples(std::move(r)),
        grid(std::move(g)),
        classify(std::move(c)),
        sky(std::move(s)),
        surface(std::move(w)),
        smooth_steps(std::move(e)),
        hulls(std::move(h)),
        ropes(std::move(o)),
        terrain(std::move(l)),
        spray(std::move(d)),
        tone(std::move(t)) {}

  // The light of the last picture, kept until sun, clouds or haze change.
  struct LightKey {
    Sun sun;
    double cloud_cover = 0.0, visibility_m = 0.0;
    friend bool operator==(const LightKey&, const LightKey&) = default;
  };

  struct Picture;
  void UpdateLight(const RenderFrame& frame);
  void UploadSea(Picture& picture);
  OceanGrid FillBlock(Picture& picture);
  void ShadeSea(const Picture& picture, const HullMirror& mirror);
  void DrawHullsAndRopes(const Picture& picture, bool hulls_in_view);
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
  RopePass ropes;
  TerrainPass terrain;
  SprayPass spray;
  ToneMapPass tone;
  SeaTextures sea;
  PatchTextures patches;
  GroundTextures ground;
  AttenuationTexture attenuation;
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
  ONESEA_ASSIGN_OR_RETURN(RopePass ropes, RopePass::Create());
  ONESEA_ASSIGN_OR_RETURN(TerrainPass terrain, TerrainPass::Create());
  ONESEA_ASSIGN_OR_RETURN(SprayPass spray, SprayPass::Create());
  ONESEA_ASSIGN_OR_RETURN(ToneMapPass tone, ToneMapPass::Create());
  return std::unique_ptr<Renderer>(new Renderer(std::make_unique<Impl>(
      std::move(ripples), std::move(grid), std::move(classify), std::move(sky), std::move(surface),
      std::move(smooth_steps), std::move(hulls), std::move(ropes), std::move(terrain),
      std::move(spray), std::move(tone))));
}

Renderer::Renderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Renderer::~Renderer() = default;
void Renderer::MeasurePasses(bool measure) { impl_->measure = measure; }
const std::vector<PassTime>& Renderer::pass_times() const { return impl_->pass_times; }

// What a picture is made of, beside what the passes keep.
struct Renderer::Impl::Picture {
  const RenderFrame& frame;
  int width, height, samples;
  std::vector<SlopeStats> stats{};
  double displacement_max_m = 0.0;  // of the surface, any way
  FrameBlock block{};
  bool terrain = false;  // in view
};

void Renderer::Impl::UploadSea(Picture& picture) {
  const RenderFrame& frame = picture.frame;
  double variance = 0.0;
  Pass("upload", [&] {
    for (const CascadePlanes& planes : frame.cascades) {
      picture.stats.push_back(MeasureSlopes(planes));
      variance += picture.stats.back().height_variance_m2;
    }
    sea.Upload(frame.cascades);
    surface.SetFoamWindow(frame.foam);
  });
  Pass("ripples", [&] {
    ripples.Draw(empty, frame.seed, frame.time_s,
                 0.66 * UnresolvedSlopeVariance(frame, picture.stats), frame.weather.wind_to_rad);
  });
  picture.displacement_max_m = 3.2 * std::sqrt(variance) + LargestHeightM(frame.patches);
  for (const RegularWaveNow& wave : frame.regular_waves) {
    picture.displacement_max_m += wave.amplitude_m;
  }
}

OceanGrid Renderer::Impl::FillBlock(Picture& picture) {
  const RenderFrame& frame = picture.frame;
  const Vec2d eye{frame.camera.position_m.x, frame.camera.position_m.y};
  Camera over_water = frame.camera;
  over_water.position_m.z -= frame.water_level_m;
  const OceanGrid lattice =
      FitOceanGrid(over_water, picture.width, picture.height, frame.quality.pixels_per_column,
                   picture.displacement_max_m);
  picture.block = MakeFrameBlock(frame, light, lattice, picture.stats, ripples.stats(),
                                 RipplePass::kLengthM, picture.width, picture.height);
  if (!frame.patches.empty()) {
    Pass("patches", [&] { patches.Update(frame.patches, eye, picture.block); });
  }
  attenuation.Update(frame.attenuation, eye, picture.block);
  if (frame.terrain != nullptr) {
    ground.Update(frame.terrain, eye, frame.water_level_m, picture.block);
    // From above, water hides what its troughs don't bare.
    const double lowest_m = picture.block.eye.z < 0.0f ? -1e9 : -picture.displacement_max_m;
    picture.terrain =
        terrain.Prepare(ground, picture.block, lowest_m, 1.5 * frame.quality.pixels_per_column);
  }
  return lattice;
}

void Renderer::Impl::ShadeSea(const Picture& picture, const HullMirror& mirror) {
  SurfaceVariant variant;
  variant.underside = picture.block.eye.z < picture.displacement_max_m;
  variant.ripples = picture.frame.quality.ripples;
  variant.regular_waves = !picture.frame.regular_waves.empty();
  variant.cascades = static_cast<int>(picture.frame.cascades.size());
  variant.patches = static_cast<int>(picture.block.counts.w);
  variant.terrain = picture.frame.terrain != nullptr;
  variant.attenuated = attenuation.any();
  surface.Draw(empty, scene, {grid, sea, patches, ground, attenuation, ripples, sky}, mirror,
               variant);
}

void Renderer::Impl::DrawHullsAndRopes(const Picture& picture, bool hulls_in_view) {
  // From above, water hides what its troughs don't bare.
  const double lowest_m = picture.block.eye.z < 0.0f ? -1e9 : -picture.displacement_max_m;
  const bool ropes_in_view =
      !picture.frame.ropes.empty() &&
      ropes.Prepare(picture.frame, picture.block, lowest_m, picture.width, picture.height);
  if (hulls_in_view) {
    const std::span<const PixelBox> boxes =
        ropes_in_view ? ropes.boxes() : std::span<const PixelBox>();
    Pass("hulls", [&] { hulls.Draw(empty, scene, grid, sky, boxes); });
  }
  if (!ropes_in_view) return;
  Pass("ropes", [&] { ropes.Draw(scene, grid, sky, hulls_in_view ? hulls.depth() : nullptr); });
}

void Renderer::Draw(const RenderFrame& frame, int width, int height, unsigned framebuffer) {
  ONESEA_CHECK(width > 0 && height > 0);
  ONESEA_CHECK(!frame.cascades.empty() && frame.cascades.size() <= kRenderCascadesMax);
  Impl& r = *impl_;
  r.pass_times.clear();
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glDisable(GL_SCISSOR_TEST);
  r.UpdateLight(frame);

  const int samples = frame.quality.samples == 0 ? r.samples_default : frame.quality.samples;
  Impl::Picture picture{frame, width, height, samples};
  r.UploadSea(picture);
  const OceanGrid lattice = r.FillBlock(picture);
  const FrameBlock& block = picture.block;
  r.UploadBlock(block);
  r.scene.Resize(width, height, GL_RGBA16F);
  r.Pass("small sky", [&] { r.sky.DrawSmall(r.empty, block, width, height); });
  const bool hulls = !frame.hulls.empty() && r.hulls.Prepare(frame, block, width, height);
  HullMirror mirror;
  if (hulls) {
    r.Pass("mirror", [&] {
      mirror = r.hulls.DrawMirror(width, height, r.sea, r.patches, r.attenuation, r.sky);
    });
  }
  r.Pass("geometry",
         [&] { r.grid.Draw(lattice, r.sea, r.patches, r.attenuation, width, height, samples); });
  if (picture.terrain) r.Pass("land mesh", [&] { r.terrain.DrawGeometry(r.ground); });
  r.Pass("classify", [&] { r.classify.Draw(r.empty, r.scene, r.grid, picture.terrain); });
  r.Pass("sky", [&] { r.sky.Place(r.empty, block, r.scene); });
  r.Pass("surface", [&] { r.ShadeSea(picture, mirror); });
  if (picture.terrain) {
    r.Pass("land", [&] { r.terrain.Shade(r.empty, r.scene, r.grid, r.ground, r.sky); });
  }
  if (samples == 1) {
    r.Pass("steps", [&] { r.smooth_steps.Draw(r.empty, r.scene, r.grid, r.classify); });
  }
  r.DrawHullsAndRopes(picture, hulls);
  if (!frame.spray.empty()) {
    r.Pass("spray", [&] { r.spray.Draw(frame, r.scene, r.grid, r.sky); });
  }
  r.Pass("tone map", [&] { r.tone.Draw(r.empty, r.scene, framebuffer, frame.quality.bloom); });
}

}  // namespace onesea::render
