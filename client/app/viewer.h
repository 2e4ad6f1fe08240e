#pragma once

#include <memory>
#include <string>

#include "absl/status/status.h"
#include "client/app/camera_control.h"
#include "client/app/panel.h"
#include "client/app/sea_source.h"

namespace onesea::client {

struct ViewerOptions {
  int width = 1280, height = 720;
  double frames_per_second = 30.0;  ///< headless: pictures per second of sea time
  double seconds = 5.0;             ///< headless: of sea time
  std::string out = "frames";       ///< headless and P: folder of the pictures
  int grid_size = 256;              ///< N of each cascade
  int samples = 0;                  ///< of the surface's edges: 1, 4 or 0, as render::Quality
  CameraControl camera;
  ViewSettings settings;
};

/// Opens a window and shows the sea until it is closed.
absl::Status RunWindow(SeaSource& source, ViewerOptions options);

/// Draws seconds * frames_per_second pictures of consecutive sea times into PNG files, as fast as
/// it can, telling its progress on stdout. Needs no display.
absl::Status RunHeadless(SeaSource& source, ViewerOptions options);

}  // namespace onesea::client
