#include "client/app/polar_plot.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "absl/strings/str_format.h"
#include "client/app/png_writer.h"
#include "client/app/stroke_font.h"
#include "common/sea/constants.h"
#include "common/sea/dispersion.h"
#include "common/sea/wave_spectrum.h"

namespace onesea::app {
namespace {

using sea::kPi;

constexpr int kRows = 360;     // frequencies
constexpr int kColumns = 720;  // directions
constexpr double kShownShare = 0.98;
constexpr double kFrequencyMaxHz = 1.0;

constexpr Vec2d kCentre{520.0, 604.0};
constexpr double kRadius = 400.0;

const Colour kPaper = FromLightnessChromaHue(0.17, 0.03, 255.0);
const Colour kInk = FromLightnessChromaHue(0.93, 0.01, 240.0);
const Colour kFaintInk = FromLightnessChromaHue(0.72, 0.02, 245.0);
const Colour kAccent = FromLightnessChromaHue(0.78, 0.15, 55.0);

// E(f, θ) [m²/Hz/rad] on rings; column 0 travels east, then counter-clockwise.
struct PolarDensity {
  double frequency_max_hz = 0.0;
  double largest = 0.0;
  std::vector<float> value;  // (kRows x kColumns); row i at (i + 0.5)/kRows of frequency_max_hz
};

// E = P(k) k dk/df in deep water; ∫E dθ is given back as well.
double FillRow(const sea::WaveSpectrum& spectrum, double f_hz, std::vector<float>& row) {
  const double k = sea::WavenumberOf(2.0 * kPi * f_hz, 0.0);
  const double per_hz = 2.0 * kPi * k / sea::GroupVelocity(k, 0.0);
  const sea::WaveSpectrum::Node node = spectrum.NodeAt(k);
  double sum = 0.0;
  for (std::size_t j = 0; j < row.size(); ++j) {
    const double angle = 2.0 * kPi * static_cast<double>(j) / static_cast<double>(row.size());
    const double shape = spectrum.Shape(node, {std::cos(angle), std::sin(angle)});
    row[j] = static_cast<float>(node.radial * shape * per_hz);
    sum += row[j];
  }
  return sum * 2.0 * kPi / static_cast<double>(row.size());
}

// Where kShownShare of the variance below 1 Hz is reached, rounded up to a twentieth of a hertz.
double ShownFrequency(const sea::WaveSpectrum& spectrum) {
  constexpr int kSteps = 500;
  std::vector<double> sum(kSteps + 1, 0.0);
  std::vector<float> row(90);
  for (int i = 1; i <= kSteps; ++i) {
    const double f_hz = kFrequencyMaxHz * (i - 0.5) / kSteps;
    sum[static_cast<std::size_t>(i)] =
        sum[static_cast<std::size_t>(i - 1)] + FillRow(spectrum, f_hz, row);
  }
  const auto reached = std::lower_bound(sum.begin(), sum.end(), kShownShare * sum.back());
  const double f_hz = kFrequencyMaxHz * static_cast<double>(reached - sum.begin()) / kSteps;
  return std::clamp(std::ceil(f_hz / 0.05 - 1e-9) * 0.05, 0.15, kFrequencyMaxHz);
}

PolarDensity Sample(const sea::WaveSystem& system) {
  const std::unique_ptr<const sea::WaveSpectrum> spectrum = sea::MakeWaveSpectrum(system, 0.0);
  PolarDensity density;
  density.frequency_max_hz = ShownFrequency(*spectrum);
  std::vector<float> row(kColumns);
  for (int i = 0; i < kRows; ++i) {
    FillRow(*spectrum, density.frequency_max_hz * (i + 0.5) / kRows, row);
    density.value.insert(density.value.end(), row.begin(), row.end());
  }
  density.largest = *std::max_element(density.value.begin(), density.value.end());
  return density;
}

// Bilinear; `ring` in [0, 1] of the shown frequencies, `turn` in [0, 1) of travel.
double Interpolate(const PolarDensity& density, double ring, double turn) {
  const double y = std::clamp(ring * kRows - 0.5, 0.0, kRows - 1.0), x = turn * kColumns;
  const int i = std::min(static_cast<int>(y), kRows - 2), j = static_cast<int>(x) % kColumns;
  const double v = y - i, u = x - std::floor(x);
  const auto at = [&](int row, int column) {
    const int index = row * kColumns + column % kColumns;
    return density.value[static_cast<std::size_t>(index)];
  };
  const double near = at(i, j) + u * (at(i, j + 1) - at(i, j));
  const double far = at(i + 1, j) + u * (at(i + 1, j + 1) - at(i + 1, j));
  return near + v * (far - near);
}

// Deep water to foam: lightness grows evenly, hue turns from blue over turquoise to sunlit yellow.
Colour MapColour(double share) {
  const double t = std::clamp(share, 0.0, 1.0);
  const double hue_deg = 268.0 - 172.0 * std::pow(t, 1.25);
  return FromLightnessChromaHue(0.22 + 0.73 * t, 0.075 + 0.05 * t, hue_deg);
}

std::vector<Colour> ColourTable() {
  std::vector<Colour> table(1024);
  for (std::size_t i = 0; i < table.size(); ++i)
    table[i] = MapColour(static_cast<double>(i) / 1023);
  return table;
}

Vec2d AtCompass(double from_deg, double radius_px) {
  const double angle = from_deg * kPi / 180.0;
  return {kCentre.x + radius_px * std::sin(angle), kCentre.y - radius_px * std::cos(angle)};
}

void DrawDisc(const PolarDensity& density, const std::vector<Colour>& colours, Canvas& canvas) {
  for (int y = 0; y < canvas.height(); ++y) {
    for (int x = 0; x < canvas.width(); ++x) {
      const double east = x + 0.5 - kCentre.x, north = kCentre.y - y - 0.5;
      const double radius = std::hypot(east, north);
      const double cover = std::clamp(kRadius + 0.5 - radius, 0.0, 1.0);
      if (cover <= 0.0) continue;
      // Waves that come from here travel to the opposite side.
      const double turn = (std::atan2(-north, -east) + 2.0 * kPi) / (2.0 * kPi);
      const double value = Interpolate(density, radius / kRadius, turn - std::floor(turn));
      const double share = density.largest > 0.0 ? std::sqrt(value / density.largest) : 0.0;
      const std::size_t index = static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * 1023.0);
      canvas.Blend(x, y, colours[index], cover);
    }
  }
}

// Where the rings' labels cover least: the compass direction, among the sixteenths between the
// spokes, of least energy on a sector around it.
double QuietFromDeg(const PolarDensity& density) {
  double best_deg = 0.0, least = 1e300;
  for (double from_deg = 15.0; from_deg < 360.0; from_deg += 30.0) {
    double sum = 0.0;
    for (double offset_deg = -14.0; offset_deg <= 14.0; offset_deg += 2.0) {
      const double turn = std::fmod(270.0 - from_deg - offset_deg + 720.0, 360.0) / 360.0;
      for (double ring = 0.2; ring <= 1.0; ring += 0.02) {
        sum += std::sqrt(Interpolate(density, ring, turn));
      }
    }
    if (sum < least) {
      least = sum;
      best_deg = from_deg;
    }
  }
  return best_deg;
}

void DrawRings(const PolarDensity& density, Canvas& canvas) {
  const double max_hz = density.frequency_max_hz;
  const double step_hz = max_hz <= 0.31 ? 0.05 : max_hz <= 0.61 ? 0.1 : 0.2;
  const double label_deg = QuietFromDeg(density);
  for (int n = 1; n * step_hz < max_hz + 1e-9; ++n) {
    const double radius = kRadius * n * step_hz / max_hz;
    const bool is_rim = n * step_hz > max_hz - 1e-9;
    if (!is_rim) canvas.Ring(kCentre, radius, 1.1, kInk, 0.32);
  }
  std::vector<Segment> spokes;
  for (double deg = 0.0; deg < 360.0; deg += 30.0) {
    spokes.push_back({AtCompass(deg, 0.06 * kRadius), AtCompass(deg, kRadius)});
  }
  canvas.Stroke(spokes, 1.0, kInk, 0.18);
  canvas.Ring(kCentre, kRadius, 2.0, kInk, 0.85);
  // Closer to the rim a label would lie across it.
  for (int n = 1; n * step_hz < 0.87 * max_hz; ++n) {
    const Vec2d at = AtCompass(label_deg, kRadius * n * step_hz / max_hz);
    const std::string text =
        absl::StrFormat("%.2f Hz \xc2\xb7 %.3g s", n * step_hz, 1.0 / (n * step_hz));
    canvas.TextWithHalo({at.x, at.y + 6.0}, 12.0, Align::kCentre, text, kInk, MapColour(0.0));
  }
}

void DrawCompass(Canvas& canvas) {
  const char* const names[] = {"N", "NE", "E", "SE", "S", "SW", "W", "NW"};
  for (int n = 0; n < 8; ++n) {
    const bool is_main = n % 2 == 0;
    const double height_px = is_main ? 20.0 : 14.0;
    const Vec2d at = AtCompass(45.0 * n, kRadius + (is_main ? 38.0 : 36.0));
    canvas.Text({at.x, at.y + 0.5 * height_px}, height_px, Align::kCentre, names[n],
                is_main ? kInk : kFaintInk);
  }
  std::vector<Segment> ticks;
  for (int deg = 0; deg < 360; deg += 10) {
    ticks.push_back(
        {AtCompass(deg, kRadius + 3.0), AtCompass(deg, kRadius + (deg % 30 == 0 ? 13.0 : 8.0))});
  }
  canvas.Stroke(ticks, 1.4, kInk, 0.8);
}

// 0 and the numbers 1, 2, 5 with their tenfolds, up to `largest`.
std::vector<double> RoundValues(double largest) {
  std::vector<double> values = {0.0};
  if (!(largest > 1e-20)) return values;
  const int top = static_cast<int>(std::floor(std::log10(largest)));
  for (int decade = top - 3; decade <= top; ++decade) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double value = digit * std::pow(10.0, decade);
      if (value <= largest) values.push_back(value);
    }
  }
  return values;
}

void DrawLegend(const PolarDensity& density, const std::vector<Colour>& colours, Canvas& canvas) {
  constexpr double kLeft = 1050.0, kRight = 1074.0, kTop = 374.0, kBottom = 834.0;
  for (int y = static_cast<int>(kTop); y < static_cast<int>(kBottom); ++y) {
    const double share = (kBottom - y - 0.5) / (kBottom - kTop);
    const std::size_t index = static_cast<std::size_t>(share * 1023.0);
    canvas.FillBox({kLeft, static_cast<double>(y)}, {kRight, y + 1.0}, colours[index]);
  }
  canvas.Text({kLeft, kTop - 46.0}, 14.0, Align::kLeft, "density", kInk);
  canvas.Text({kLeft, kTop - 22.0}, 12.0, Align::kLeft, "m\xc2\xb2/Hz/rad", kFaintInk);
  double last_y = 1e9;
  for (const double value : RoundValues(density.largest)) {
    const double share = density.largest > 0.0 ? value / density.largest : 0.0;
    const double y = kBottom - std::sqrt(share) * (kBottom - kTop);
    if (last_y - y < 20.0) continue;
    last_y = y;
    const Segment tick{{kRight + 3.0, y}, {kRight + 9.0, y}};
    canvas.Stroke({&tick, 1}, 1.4, kInk, 0.8);
    canvas.Text({kRight + 16.0, y + 5.5}, 11.0, Align::kLeft, absl::StrFormat("%g", value), kInk);
  }
}

// Points the way the waves go.
void DrawArrow(double from_deg, Canvas& canvas) {
  const Vec2d tail = AtCompass(from_deg, kRadius + 24.0), tip = AtCompass(from_deg, kRadius - 34.0);
  const Vec2d left = AtCompass(from_deg - 1.3, kRadius - 16.0);
  const Vec2d right = AtCompass(from_deg + 1.3, kRadius - 16.0);
  const Segment strokes[] = {{tail, tip}, {left, tip}, {right, tip}};
  canvas.Stroke(strokes, 3.4, kAccent);
}

void DrawTitles(const PolarPlotText& text, Canvas& canvas) {
  canvas.Text({56.0, 62.0}, 22.0, Align::kLeft, text.title, kInk);
  double x = 56.0;
  for (const std::string& phrase : text.subtitle) {
    canvas.Text({x, 102.0}, 16.0, Align::kLeft, phrase, kAccent);
    x += TextWidth(phrase, 16.0) + 36.0;
  }
  const double bottom = canvas.height() - 34.0;
  canvas.Text({56.0, bottom - 24.0}, 11.0, Align::kLeft, "around: where the waves come from",
              kFaintInk);
  canvas.Text({56.0, bottom}, 11.0, Align::kLeft, "outwards: their frequency", kFaintInk);
}

}  // namespace

Canvas DrawPolarPlot(const sea::WaveSystem& system, const PolarPlotText& text) {
  const PolarDensity density = Sample(system);
  const std::vector<Colour> colours = ColourTable();
  Canvas canvas(kPolarPlotWidth, kPolarPlotHeight, kPaper);
  DrawDisc(density, colours, canvas);
  DrawRings(density, canvas);
  DrawCompass(canvas);
  if (text.mean_from_deg) DrawArrow(*text.mean_from_deg, canvas);
  DrawLegend(density, colours, canvas);
  DrawTitles(text, canvas);
  return canvas;
}

absl::Status WritePolarPlotPng(const sea::WaveSystem& system, const PolarPlotText& text,
                               const std::string& path) {
  const Canvas canvas = DrawPolarPlot(system, text);
  return client::WritePng(path, canvas.width(), canvas.height(), canvas.Rgb());
}

}  // namespace onesea::app
