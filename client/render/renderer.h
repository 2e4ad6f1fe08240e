#pragma once

#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "client/render/render_frame.h"

namespace onesea::render {

struct PassTime {
  std::string name;
  double wall_ms = 0.0;
  double cpu_ms = 0.0;  ///< of all threads of the process: steadier than wall on a busy machine
};

/// Draws RenderFrames with OpenGL 3.3 core. Needs a current context, from creation to destruction,
/// always on the same thread.
class Renderer {
 public:
  /// Compiles the shaders and makes the textures: 0.3 s. Internal error with the driver's log.
  static absl::StatusOr<std::unique_ptr<Renderer>> Create();
  ~Renderer();

  /// Draws into `framebuffer` (0: the window's), of width x height pixels. Leaves that framebuffer
  /// bound. A change of sun, clouds or visibility costs 100 ms once.
  void Draw(const RenderFrame& frame, int width, int height, unsigned framebuffer);

  /// From now on waits for each pass and notes its time; for benchmarks.
  void MeasurePasses(bool measure);
  /// Of each pass of the last Draw(), in order; empty unless measured.
  const std::vector<PassTime>& pass_times() const;

 private:
  struct Impl;
  explicit Renderer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace onesea::render
