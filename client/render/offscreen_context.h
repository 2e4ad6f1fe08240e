#pragma once

#include <memory>
#include <string>

#include "absl/status/statusor.h"

namespace onesea::render {

/// An OpenGL core context (3.3 or newer) without window, display server or X. Current on the thread
/// that made it until destroyed. Draw to framebuffers of your own; there is no default one.
class OffscreenContext {
 public:
  /// Tries, in this order: each EGL device, Mesa's surfaceless platform, the default display.
  /// Unavailable with each attempt's reason when none works.
  static absl::StatusOr<std::unique_ptr<OffscreenContext>> Create();
  ~OffscreenContext();

  /// "device 0", "surfaceless" or "default display".
  const std::string& path() const { return path_; }

 private:
  OffscreenContext(void* display, void* context, std::string path)
      : display_(display), context_(context), path_(std::move(path)) {}
  void* display_;
  void* context_;
  std::string path_;
};

}  // namespace onesea::render
