#pragma once

#include <memory>

#include "client/app/frame_builder.h"
#include "client/app/sea_source.h"
#include "client/app/skipper.h"

namespace onesea::client {

/// What the panel lets a person change.
struct ViewSettings {
  double sun_elevation_deg = 25.0;
  double sun_azimuth_deg = 120.0;  ///< where it stands, clockwise from north
  double cloud_cover = 0.3;
  double visibility_km = 35.0;
  double exposure_stops = 0.0;
  int water = 2;  ///< render::WaterType
  bool show_panel = true;
  bool show_keys = false;
};

/// Dear ImGui over the picture. Needs a current OpenGL context; knows no window, so that headless
/// pictures can have it too.
class Panel {
 public:
  Panel();
  ~Panel();
  Panel(const Panel&) = delete;
  Panel& operator=(const Panel&) = delete;

  struct Pointer {
    float x = -1, y = -1;
    bool pressed = false;
    float wheel = 0;
  };

  /// Draws into the bound framebuffer of width x height pixels.
  void Draw(int width, int height, double seconds, const Pointer& pointer,
            const SourceReport& report, const SeaFigures& figures, const HelmReport& helm,
            ViewSettings& settings);

  /// The pointer is over the panel: the camera should leave it alone.
  bool WantsPointer() const;

 private:
  double frames_per_second_ = 0.0;
};

}  // namespace onesea::client
