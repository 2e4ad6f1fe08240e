#pragma once

#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "client/app/canvas.h"
#include "common/sea/sea_state.h"

/// A directional spectrum as people draw it: a disc with north on top, the direction the waves come
/// from around it, frequency outwards, energy as colour.
namespace onesea::app {

struct PolarPlotText {
  std::string title;                    ///< one line, large
  std::vector<std::string> subtitle;    ///< phrases of the line below it: "Hs 4.71 m", "Tp 10.0 s"
  std::optional<double> mean_from_deg;  ///< where an arrow points in, nautical
};

inline constexpr int kPolarPlotWidth = 1200;
inline constexpr int kPolarPlotHeight = 1080;

/// Draws the sea that the recipe's components are made of: a buoy's directions by maximum entropy,
/// with the tail, in deep water. The frequency axis ends where 98 % of the variance lie within.
/// Colours are of even perceptual steps over the square root of the density, so that a swell shows
/// beside a storm. Pre: ValidateSeaState() is OK for `system`. Cost: about 0.2 s.
Canvas DrawPolarPlot(const sea::WaveSystem& system, const PolarPlotText& text);

/// The same as a PNG file. Unavailable, naming the path, if it can't be written.
absl::Status WritePolarPlotPng(const sea::WaveSystem& system, const PolarPlotText& text,
                               const std::string& path);

}  // namespace onesea::app
