#include "client/app/canvas.h"

#include <algorithm>
#include <cmath>

#include "client/app/stroke_font.h"
#include "common/base/check.h"

namespace onesea::app {
namespace {

constexpr double kPi = 3.14159265358979323846;

double ToSrgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

struct Linear {
  double r, g, b;
  bool IsInside() const {
    const double low = std::min({r, g, b}), high = std::max({r, g, b});
    return low >= -1e-6 && high <= 1.0 + 1e-6;
  }
};

Linear FromOklab(double lightness, double a, double b) {
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3.0);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3.0);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3.0);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

float Mix(float from, float to, double weight) {
  return static_cast<float>(from + (to - from) * weight);
}

double DistanceTo(const Segment& segment, Vec2d p) {
  const double dx = segment.to.x - segment.from.x, dy = segment.to.y - segment.from.y;
  const double px = p.x - segment.from.x, py = p.y - segment.from.y;
  const double length2 = dx * dx + dy * dy;
  const double t = length2 > 0.0 ? std::clamp((px * dx + py * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(px - t * dx, py - t * dy);
}

// How much of a pixel lies within `half_width` of something `distance` away.
double Coverage(double distance, double half_width) {
  return std::clamp(half_width + 0.5 - distance, 0.0, std::min(1.0, 2.0 * half_width));
}

}  // namespace

Colour FromLightnessChromaHue(double lightness, double chroma, double hue_deg) {
  const double hue = hue_deg * kPi / 180.0;
  Linear linear{};
  for (double c = chroma; c >= 0.0; c -= 0.002) {
    linear = FromOklab(lightness, c * std::cos(hue), c * std::sin(hue));
    if (linear.IsInside()) break;
  }
  const auto channel = [](double value) {
    return static_cast<float>(ToSrgb(std::clamp(value, 0.0, 1.0)));
  };
  return {channel(linear.r), channel(linear.g), channel(linear.b)};
}

Canvas::Canvas(int width, int height, Colour background) : width_(width), height_(height) {
  ONESEA_CHECK(width > 0 && height > 0 && width <= 8192 && height <= 8192);
  pixels_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), background);
}

std::vector<std::uint8_t> Canvas::Rgb() const {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(3 * pixels_.size());
  for (const Colour& pixel : pixels_) {
    for (const float channel : {pixel.r, pixel.g, pixel.b}) {
      rgb.push_back(static_cast<std::uint8_t>(std::lround(255.0F * channel)));
    }
  }
  return rgb;
}

void Canvas::Blend(int x, int y, Colour colour, double alpha) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
  Colour& pixel = pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                          static_cast<std::size_t>(x)];
  pixel = {Mix(pixel.r, colour.r, alpha), Mix(pixel.g, colour.g, alpha),
           Mix(pixel.b, colour.b, alpha)};
}

void Canvas::Stroke(std::span<const Segment> segments, double width_px, Colour colour,
                    double alpha) {
  const double half = 0.5 * width_px, reach = half + 1.0;
  Vec2d low{1e9, 1e9}, high{-1e9, -1e9};
  for (const Segment& s : segments) {
    low = {std::min({low.x, s.from.x, s.to.x}), std::min({low.y, s.from.y, s.to.y})};
    high = {std::max({high.x, s.from.x, s.to.x}), std::max({high.y, s.from.y, s.to.y})};
  }
  const auto first = [&](double v, int max) {
    return static_cast<int>(std::clamp(std::floor(v - reach), 0.0, static_cast<double>(max)));
  };
  const int x0 = first(low.x, width_), y0 = first(low.y, height_);
  const int x1 = first(high.x + 2.0 * reach + 1.0, width_);
  const int y1 = first(high.y + 2.0 * reach + 1.0, height_);
  if (x1 <= x0 || y1 <= y0) return;
  const int columns = x1 - x0;
  std::vector<double> cover(static_cast<std::size_t>(columns) * static_cast<std::size_t>(y1 - y0));
  for (const Segment& s : segments) {
    const int sx0 = std::max(x0, first(std::min(s.from.x, s.to.x), width_));
    const int sx1 = std::min(x1, first(std::max(s.from.x, s.to.x) + 2.0 * reach + 1.0, width_));
    const int sy0 = std::max(y0, first(std::min(s.from.y, s.to.y), height_));
    const int sy1 = std::min(y1, first(std::max(s.from.y, s.to.y) + 2.0 * reach + 1.0, height_));
    for (int y = sy0; y < sy1; ++y) {
      for (int x = sx0; x < sx1; ++x) {
        double& c = cover[static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(columns) +
                          static_cast<std::size_t>(x - x0)];
        c = std::max(c, Coverage(DistanceTo(s, {x + 0.5, y + 0.5}), half));
      }
    }
  }
  for (std::size_t i = 0; i < cover.size(); ++i) {
    if (cover[i] <= 0.0) continue;
    Blend(x0 + static_cast<int>(i) % columns, y0 + static_cast<int>(i) / columns, colour,
          alpha * cover[i]);
  }
}

void Canvas::Ring(Vec2d centre, double radius_px, double width_px, Colour colour, double alpha) {
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const double distance = std::hypot(x + 0.5 - centre.x, y + 0.5 - centre.y) - radius_px;
      if (std::abs(distance) > width_px + 1.0) continue;
      Blend(x, y, colour, alpha * Coverage(std::abs(distance), 0.5 * width_px));
    }
  }
}

void Canvas::FillBox(Vec2d low, Vec2d high, Colour colour) {
  for (int y = static_cast<int>(low.y); y < static_cast<int>(high.y); ++y) {
    for (int x = static_cast<int>(low.x); x < static_cast<int>(high.x); ++x) {
      Blend(x, y, colour, 1.0);
    }
  }
}

void Canvas::Text(Vec2d at, double height_px, Align align, absl::string_view text, Colour colour) {
  const double width_px = TextWidth(text, height_px);
  const double shift = align == Align::kLeft ? 0.0 : align == Align::kCentre ? 0.5 : 1.0;
  Stroke(TextStrokes({at.x - shift * width_px, at.y}, height_px, text), TextPen(height_px), colour);
}

void Canvas::TextWithHalo(Vec2d at, double height_px, Align align, absl::string_view text,
                          Colour colour, Colour halo) {
  const double shift = align == Align::kLeft ? 0.0 : align == Align::kCentre ? 0.5 : 1.0;
  const Vec2d start{at.x - shift * TextWidth(text, height_px), at.y};
  Stroke(TextStrokes(start, height_px, text), TextPen(height_px) + 5.0, halo, 0.75);
  Text(at, height_px, align, text, colour);
}

}  // namespace onesea::app
