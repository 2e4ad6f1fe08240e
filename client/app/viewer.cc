#include "client/app/viewer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "client/app/body_models.h"
#include "client/app/cockpit.h"
#include "client/app/frame_builder.h"
#include "client/app/png_writer.h"
#include "client/app/pose_log.h"
#include "client/app/spray_bursts.h"
#include "client/app/window.h"
#include "client/model/rope_ends.h"
#include "client/render/gl_objects.h"
#include "client/render/offscreen_context.h"
#include "client/render/renderer.h"
#include "common/base/check.h"
#include "common/base/clock.h"

namespace onesea::client {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr std::int64_t kLiveStepNs =
    10'000'000;  // between looks at the keys while nothing is drawn

absl::Status MakeFolder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (!error) return absl::OkStatus();
  return absl::UnavailableError(
      absl::StrCat("can't make the folder ", path, ": ", error.message()));
}

void ApplySettings(const ViewSettings& settings, render::RenderFrame& frame) {
  frame.sun.azimuth_rad = (90.0 - settings.sun_azimuth_deg) * kDegree;
  frame.sun.elevation_rad = settings.sun_elevation_deg * kDegree;
  frame.weather.cloud_cover = settings.cloud_cover;
  frame.weather.visibility_m = 1000.0 * settings.visibility_km;
  frame.exposure_stops = settings.exposure_stops;
  frame.water = static_cast<render::WaterType>(settings.water);
}

// Renderer, panel and sea of one context: what window and headless share.
class Scene {
 public:
  static absl::StatusOr<std::unique_ptr<Scene>> Create(const ViewerOptions& options) {
    ONESEA_ASSIGN_OR_RETURN(std::unique_ptr<render::Renderer> renderer, render::Renderer::Create());
    return std::unique_ptr<Scene>(new Scene(std::move(renderer), options));
  }

  void DrawSea(SeaSource& source, SimTime time, const Cockpit& cockpit,
               const ViewSettings& settings, int width, int height, unsigned framebuffer) {
    // The place decides where foam is kept; the height over the waves is known after synthesis.
    frame_.camera = cockpit.At(0.0);
    if (const std::shared_ptr<const WorldView> world = source.world(); world != nullptr) {
      builder_.SetInteraction(world->shared_interaction());
      frame_.hulls = models_.At(*world, time, source.meshes(), cockpit.own());
      frame_.ropes.clear();
      for (const RopeNow& rope : RopesAt(*world, time, cockpit.own())) {
        frame_.ropes.push_back(
            {.from_m = rope.from_m, .to_m = rope.to_m, .length_m = rope.length_m});
      }
      spray_.Add(source.TakeSpray(), world->time());
      frame_.spray = spray_.At(time);
    }
    builder_.SetWaterLevel(source.WaterLevelAt(time));
    builder_.Fill(source.components(), time, frame_);
    frame_.camera = cockpit.At(builder_.HeightAt(cockpit.place()));
    ApplySettings(settings, frame_);
    renderer_->Draw(frame_, width, height, framebuffer);
    TellTrouble(source.meshes());
  }

  void DrawPanel(SeaSource& source, const HelmReport& helm, int width, int height, double seconds,
                 const Panel::Pointer& pointer, ViewSettings& settings) {
    panel_.Draw(width, height, seconds, pointer, source.Report(), builder_.Figures(), helm,
                settings);
  }
  bool PanelWantsPointer() const { return panel_.WantsPointer(); }

  absl::Status SavePicture(const std::string& path, int width, int height) {
    std::vector<std::uint8_t> rows(static_cast<std::size_t>(width * height * 3)), rgb(rows.size());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, rows.data());
    const std::size_t stride = static_cast<std::size_t>(width) * 3;
    for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
      std::memcpy(&rgb[y * stride], &rows[rows.size() - (y + 1) * stride], stride);
    }
    return WritePng(path, width, height, rgb);
  }

 private:
  Scene(std::unique_ptr<render::Renderer> renderer, const ViewerOptions& options)
      : renderer_(std::move(renderer)), builder_(options.grid_size) {
    frame_.quality.samples = options.samples;
  }

  // Once each, for those who have no panel.
  void TellTrouble(const MeshFetcher* meshes) {
    const std::string trouble = meshes != nullptr ? meshes->trouble() : "";
    if (trouble == trouble_) return;
    trouble_ = trouble;
    if (!trouble.empty()) std::fprintf(stderr, "onesea-view: %s\n", trouble.c_str());
  }

  std::unique_ptr<render::Renderer> renderer_;
  Panel panel_;
  FrameBuilder builder_;
  BodyModels models_;
  SprayBursts spray_;
  render::RenderFrame frame_;
  std::string trouble_;
};

void ApplyKeys(const WindowInput& input, double seconds, ViewSettings& settings, Cockpit& cockpit) {
  if (input.key_help) settings.show_keys = !settings.show_keys;
  if (input.key_panel) settings.show_panel = !settings.show_panel;
  if (input.key_orbit) cockpit.ToggleOrbit();
  if (input.key_follow) cockpit.ToggleFollow();
  settings.sun_elevation_deg =
      std::clamp(settings.sun_elevation_deg + 10.0 * input.sun_up * seconds, -8.0, 90.0);
}

}  // namespace

absl::Status RunWindow(SeaSource& source, ViewerOptions options) {
  ONESEA_ASSIGN_OR_RETURN(std::unique_ptr<Window> window,
                          Window::Open("Onesea", options.width, options.height));
  ONESEA_ASSIGN_OR_RETURN(std::unique_ptr<Scene> scene, Scene::Create(options));
  Cockpit cockpit(source, options.camera);
  std::int64_t last_ns = SystemClock().MonotonicNs();
  int pictures = 0;
  while (!window->ShouldClose()) {
    ONESEA_RETURN_IF_ERROR(source.status());
    WindowInput input = window->Poll();
    const std::int64_t now_ns = SystemClock().MonotonicNs();
    const double seconds = 1e-9 * static_cast<double>(now_ns - last_ns);
    last_ns = now_ns;
    const int width = window->width(), height = window->height();
    if (width == 0 || height == 0) {
      SystemClock().SleepUntil(now_ns + 50'000'000);
      continue;
    }
    if (scene->PanelWantsPointer())
      input.camera.turn_px = input.camera.tilt_px = input.camera.zoom = 0;
    ApplyKeys(input, seconds, options.settings, cockpit);
    const SimTime time = source.Now();
    cockpit.Update(input.skipper, input.camera, time, seconds);
    scene->DrawSea(source, time, cockpit, options.settings, width, height, 0);
    if (input.key_picture) {
      ONESEA_RETURN_IF_ERROR(MakeFolder(options.out));
      const std::string path = absl::StrFormat("%s/picture_%03d.png", options.out, pictures++);
      ONESEA_RETURN_IF_ERROR(scene->SavePicture(path, width, height));
      std::printf("saved %s\n", path.c_str());
    }
    const Panel::Pointer pointer{input.pointer_x, input.pointer_y, input.pointer_pressed,
                                 input.wheel};
    scene->DrawPanel(source, cockpit.report(), width, height, seconds, pointer, options.settings);
    window->Present();
  }
  return absl::OkStatus();
}

absl::Status RunHeadless(SeaSource& source, ViewerOptions options) {
  ONESEA_RETURN_IF_ERROR(MakeFolder(options.out));
  ONESEA_ASSIGN_OR_RETURN(const std::unique_ptr<render::OffscreenContext> context,
                          render::OffscreenContext::Create());
  ONESEA_ASSIGN_OR_RETURN(std::unique_ptr<Scene> scene, Scene::Create(options));
  render::ColorTarget target;
  target.Resize(options.width, options.height, GL_RGBA8);
  const Cockpit cockpit(source, options.camera);
  const int count =
      std::max(1, static_cast<int>(std::lround(options.seconds * options.frames_per_second)));
  const SimTime start = source.Now();
  const std::int64_t start_ns = SystemClock().MonotonicNs();
  for (int n = 0; n < count; ++n) {
    ONESEA_RETURN_IF_ERROR(source.status());
    const SimTime time = start + SimTime::FromSeconds(n / options.frames_per_second);
    scene->DrawSea(source, time, cockpit, options.settings, options.width, options.height,
                   target.framebuffer.id());
    if (options.settings.show_panel) {
      scene->DrawPanel(source, cockpit.report(), options.width, options.height,
                       1.0 / options.frames_per_second, {}, options.settings);
    }
    ONESEA_RETURN_IF_ERROR(scene->SavePicture(absl::StrFormat("%s/frame_%05d.png", options.out, n),
                                              options.width, options.height));
    const double spent_s = 1e-9 * static_cast<double>(SystemClock().MonotonicNs() - start_ns);
    std::printf("\rpicture %d of %d, %.0f ms each ", n + 1, count, 1000.0 * spent_s / (n + 1));
    std::fflush(stdout);
  }
  std::printf("\n%d pictures of %dx%d in %s: frame_00000.png ... frame_%05d.png\n", count,
              options.width, options.height, std::filesystem::absolute(options.out).c_str(),
              count - 1);
  return absl::OkStatus();
}

absl::Status RunLive(SeaSource& source, ViewerOptions options) {
  ONESEA_RETURN_IF_ERROR(MakeFolder(options.out));
  ONESEA_ASSIGN_OR_RETURN(const std::unique_ptr<render::OffscreenContext> context,
                          render::OffscreenContext::Create());
  ONESEA_ASSIGN_OR_RETURN(std::unique_ptr<Scene> scene, Scene::Create(options));
  std::unique_ptr<PoseLog> poses;
  if (!options.poses.empty()) {
    ONESEA_ASSIGN_OR_RETURN(poses, PoseLog::Open(options.poses));
  }
  render::ColorTarget target;
  target.Resize(options.width, options.height, GL_RGBA8);
  Cockpit cockpit(source, options.camera);
  const std::int64_t start_ns = SystemClock().MonotonicNs();
  double last_s = 0.0;
  int pictures = 0, moment = 0;  // the moment of the next picture, in pictures
  for (double now_s = 0.0; now_s < options.seconds;) {
    ONESEA_RETURN_IF_ERROR(source.status());
    const SimTime time = source.Now();
    cockpit.Update(options.drive.At(now_s), {}, time, now_s - last_s);
    last_s = now_s;
    if (const auto world = source.world(); poses != nullptr && world != nullptr) {
      poses->Write(*world, time, cockpit.own());
    }
    if (now_s * options.frames_per_second >= moment) {
      moment = static_cast<int>(now_s * options.frames_per_second) + 1;
      scene->DrawSea(source, time, cockpit, options.settings, options.width, options.height,
                     target.framebuffer.id());
      if (options.settings.show_panel) {
        scene->DrawPanel(source, cockpit.report(), options.width, options.height,
                         1.0 / options.frames_per_second, {}, options.settings);
      }
      ONESEA_RETURN_IF_ERROR(
          scene->SavePicture(absl::StrFormat("%s/frame_%05d.png", options.out, pictures++),
                             options.width, options.height));
    }
    const std::int64_t now_ns = SystemClock().MonotonicNs();
    SystemClock().SleepUntil(now_ns + kLiveStepNs);
    now_s = 1e-9 * static_cast<double>(SystemClock().MonotonicNs() - start_ns);
  }
  std::printf("%d pictures of %dx%d in %s, of %.1f s\n", pictures, options.width, options.height,
              std::filesystem::absolute(options.out).c_str(), options.seconds);
  return poses != nullptr ? poses->Close() : absl::OkStatus();
}

}  // namespace onesea::client
