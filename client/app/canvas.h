#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "absl/strings/string_view.h"
#include "common/base/vec.h"

/// A small picture of smooth lines and lettering, without a graphics library or a font on the
/// machine. Pixels: x to the right, y down, the centre of the first at (0.5, 0.5).
namespace onesea::app {

/// sRGB, each in [0, 1].
struct Colour {
  float r = 0.0F, g = 0.0F, b = 0.0F;
};

/// OKLab lightness [0, 1], chroma and hue in degrees; what lies outside sRGB loses chroma. Equal
/// steps of lightness look equal. Source: B. Ottosson, "A perceptual color space", 2020.
Colour FromLightnessChromaHue(double lightness, double chroma, double hue_deg);

struct Segment {
  Vec2d from, to;
};

enum class Align { kLeft, kCentre, kRight };

class Canvas {
 public:
  Canvas(int width, int height, Colour background);

  int width() const { return width_; }
  int height() const { return height_; }
  /// (height x width x 3), top row first.
  std::vector<std::uint8_t> Rgb() const;

  /// Mixes `colour` in with weight `alpha` [0, 1]; outside the picture nothing happens.
  void Blend(int x, int y, Colour colour, double alpha);
  /// Round-ended strokes, as one shape: where they cross nothing is painted twice.
  void Stroke(std::span<const Segment> segments, double width_px, Colour colour,
              double alpha = 1.0);
  void Ring(Vec2d centre, double radius_px, double width_px, Colour colour, double alpha = 1.0);
  void FillBox(Vec2d low, Vec2d high, Colour colour);

  /// One line of text (stroke_font.h) whose baseline begins, is centred or ends at `at`. Capitals
  /// are `height_px` high. A halo of the given colour keeps it legible on top of other things.
  void Text(Vec2d at, double height_px, Align align, absl::string_view text, Colour colour);
  void TextWithHalo(Vec2d at, double height_px, Align align, absl::string_view text, Colour colour,
                    Colour halo);

 private:
  int width_, height_;
  std::vector<Colour> pixels_;  // (height x width)
};

}  // namespace onesea::app
