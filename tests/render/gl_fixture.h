#pragma once

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "client/render/gl_objects.h"
#include "client/render/offscreen_context.h"
#include "client/render/renderer.h"

namespace onesea::render {

struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  // (height x width x 3), top row first
};

/// A context without a window for each test; fails, never skips, without OpenGL: headless drawing
/// is a promise of the product.
class GlTest : public testing::Test {
 protected:
  void SetUp() override {
    auto context = OffscreenContext::Create();
    ASSERT_TRUE(context.ok()) << context.status().message();
    context_ = std::move(*context);
  }
  void TearDown() override {
    renderer_.reset();
    EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
  }

  Renderer& renderer() {
    if (!renderer_) {
      auto renderer = Renderer::Create();
      EXPECT_TRUE(renderer.ok()) << renderer.status().message();
      renderer_ = std::move(*renderer);
    }
    return *renderer_;
  }

  Picture Draw(const RenderFrame& frame, int width, int height) {
    ColorTarget target;
    target.Resize(width, height, GL_RGBA8);
    renderer().Draw(frame, width, height, target.framebuffer.id());
    Picture picture{width, height,
                    std::vector<std::uint8_t>(static_cast<std::size_t>(width * height * 3))};
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    for (int y = 0; y < height; ++y) {
      glReadPixels(0, height - 1 - y, width, 1, GL_RGB, GL_UNSIGNED_BYTE,
                   picture.rgb.data() + static_cast<std::size_t>(y * width * 3));
    }
    return picture;
  }

 private:
  std::unique_ptr<OffscreenContext> context_;
  std::unique_ptr<Renderer> renderer_;
};

}  // namespace onesea::render
