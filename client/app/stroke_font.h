#pragma once

#include <vector>

#include "absl/strings/string_view.h"
#include "client/app/canvas.h"

/// Lettering of pen strokes, like that of a plotter: smooth at every size, and in no need of a font
/// file. ASCII letters, digits and the punctuation that plots use, with ° ² ·; other characters
/// are left out.
namespace onesea::app {

/// Width of a line of text whose capitals are `height_px` high.
double TextWidth(absl::string_view text, double height_px);
/// The width of the pen that suits this height.
double TextPen(double height_px);
/// The strokes of a text whose baseline begins at `at`.
std::vector<Segment> TextStrokes(Vec2d at, double height_px, absl::string_view text);

}  // namespace onesea::app
