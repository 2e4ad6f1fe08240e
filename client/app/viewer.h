#pragma once

#include <memory>
#include <string>

#include "absl/status/status.h"
#include "client/app/camera_control.h"
#include "client/app/drive_script.h"
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
  bool live = false;  ///< headless: pictures of the session's present instead of as fast as it can
  DriveScript drive;  ///< live: the keys
  std::string poses;  ///< live: file for where every body was drawn; empty: none
};

/// Opens a window and shows the sea until it is closed.
absl::Status RunWindow(SeaSource& source, ViewerOptions options);

/// Draws seconds * frames_per_second pictures of consecutive sea times into PNG files, as fast as
/// it can, telling its progress on stdout. Needs no display.
absl::Status RunHeadless(SeaSource& source, ViewerOptions options);

/// The same beside the session's clock, as in a window: a picture that comes late is left out.
/// Keys come from `options.drive`.
absl::Status RunLive(SeaSource& source, ViewerOptions options);

}  // namespace onesea::client
