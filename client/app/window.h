#pragma once

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "client/app/camera_control.h"
#include "client/app/skipper.h"

namespace onesea::client {

/// What happened in the window since the last Poll().
struct WindowInput {
  CameraInput camera;
  float pointer_x = -1, pointer_y = -1;  ///< framebuffer pixels, from the upper left
  bool pointer_pressed = false;
  float wheel = 0;
  bool key_help = false, key_picture = false, key_orbit = false, key_panel = false;
  bool key_follow = false;
  double sun_up = 0;  ///< [-1, 1], keys held
  SkipperInput skipper;
};

/// A window with an OpenGL 3.3 core context, current on this thread. The only file that knows GLFW.
class Window {
 public:
  /// Unavailable, saying to use --headless, where there is no display.
  static absl::StatusOr<std::unique_ptr<Window>> Open(const std::string& title, int width,
                                                      int height);
  ~Window();

  bool ShouldClose() const;
  /// Handles events; answers what they amount to.
  WindowInput Poll();
  /// Shows what was drawn; waits for the screen's refresh.
  void Present();
  int width() const;  ///< of the framebuffer, in pixels; 0 while minimised
  int height() const;

 private:
  struct Impl;
  explicit Window(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace onesea::client
