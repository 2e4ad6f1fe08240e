// Three boats, two wakes and what floats about, from view 12 on with spray:
//   harbour_picture OUT.png [WIDTH HEIGHT SAMPLES VIEW]
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "client/app/png_writer.h"
#include "client/render/gl_objects.h"
#include "client/render/offscreen_context.h"
#include "client/render/renderer.h"
#include "tests/render/test_wake.h"

namespace onesea::render {
namespace {

// From the bow of the red boat, which slams every second.
void AddSpray(RenderFrame& frame) {
  for (int n = 0; n < 36; ++n) {
    const double side = n % 2 == 0 ? 1.0 : -1.0, age_s = 0.04 * (n / 2);
    const Vec2d along{std::cos(0.5), std::sin(0.5)}, left{-along.y, along.x};
    const Vec2d bow = Vec2d{18, -2} + (2.4 - 4.2 * age_s) * along + (side * 0.6) * left;
    const Vec2d out = 1.6 * along + (side * 2.6) * left;
    frame.spray.push_back({{bow.x, bow.y, 0.4},
                           {out.x, out.y, 2.6},
                           4.0 + 3.0 * (n % 3),
                           age_s,
                           static_cast<std::uint32_t>(n + 1)});
  }
}

int Main(const char* path, int width, int height, int samples, int view) {
  auto context = OffscreenContext::Create();
  if (!context.ok()) return 1;
  auto renderer = Renderer::Create();
  if (!renderer.ok()) {
    std::fprintf(stderr, "%s\n", std::string(renderer.status().message()).c_str());
    return 1;
  }
  TestSea sea(0.5, 3.6, 2.6);
  const std::vector<TestWake> wakes = HarbourWakes();
  RenderFrame frame;
  sea.FillFrame(5.0, frame);
  FillHarbour(sea, wakes, frame);
  frame.quality.samples = samples;
  frame.weather = {5.0, 2.6, 30'000.0, 0.25};
  frame.water = WaterType::kII;
  frame.sun = {2.0, 0.75};
  const Camera cameras[] = {
      {{0, 0, 3.2}, 0.16, -0.08, 0.0, 0.8},     {{8, -14, 9}, 0.85, -0.3, 0.0, 0.8},
      {{11, -6.5, 1.6}, 0.45, -0.06, 0.0, 0.9}, {{5.5, -1.2, 1.3}, 0.35, -0.15, 0.05, 0.9},
      {{-45, -10, 14}, 0.2, -0.12, 0.0, 0.5},   {{9, -5, -2.5}, 0.35, 0.18, 0.0, 0.9}};
  frame.camera = cameras[view % 6];
  if (view % 12 >= 6) frame.sun = {0.5, 0.12};
  if (view >= 12) AddSpray(frame);
  ColorTarget target;
  target.Resize(width, height, GL_RGBA8);
  (*renderer)->Draw(frame, width, height, target.framebuffer.id());
  std::vector<std::uint8_t> rgb(static_cast<std::size_t>(width * height * 3));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  for (int y = 0; y < height; ++y) {
    glReadPixels(0, height - 1 - y, width, 1, GL_RGB, GL_UNSIGNED_BYTE,
                 rgb.data() + static_cast<std::size_t>(y * width * 3));
  }
  return client::WritePng(path, width, height, rgb).ok() ? 0 : 1;
}

}  // namespace
}  // namespace onesea::render

int main(int argc, char** argv) {
  const auto number = [&](int n, int other) { return argc > n ? std::atoi(argv[n]) : other; };
  if (argc < 2) return 2;
  return onesea::render::Main(argv[1], number(2, 1280), number(3, 720), number(4, 0), number(5, 0));
}
