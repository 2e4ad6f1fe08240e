// The picture of a spectrum: energy lies where the waves come from, at their frequency.

#include "client/app/polar_plot.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "client/app/stroke_font.h"
#include "common/sea/constants.h"

namespace onesea::app {
namespace {

sea::JonswapSystem Swell(double wave_to_rad, double tp_s) {
  sea::JonswapSystem system;
  system.tp_s = tp_s;
  system.wave_to_rad = wave_to_rad;
  system.spreading = {sea::SpreadingKind::kCosine2s, 20.0, 0.0};
  return system;
}

// Only the map's top is yellow; lettering and lines are nearly grey.
Vec2d YellowestPixel(const Canvas& canvas) {
  const std::vector<std::uint8_t> rgb = canvas.Rgb();
  Vec2d best;
  int most = -1000;
  // Left of the colour legend.
  for (int y = 0; y < canvas.height(); ++y) {
    for (int x = 0; x < 1000; ++x) {
      const std::size_t i = 3 * static_cast<std::size_t>(y * canvas.width() + x);
      const int yellow = rgb[i] + rgb[i + 1] - 2 * rgb[i + 2];
      if (yellow > most) {
        most = yellow;
        best = {static_cast<double>(x), static_cast<double>(y)};
      }
    }
  }
  return best;
}

TEST(PolarPlot, EnergyLiesWhereTheWavesComeFrom) {
  // Travelling east, north, west, south: coming from W, S, E, N.
  std::array<Vec2d, 4> peak;
  Vec2d centre;
  for (std::size_t n = 0; n < 4; ++n) {
    peak[n] =
        YellowestPixel(DrawPolarPlot(Swell(0.5 * sea::kPi * static_cast<double>(n), 8.0), {}));
    centre = centre + 0.25 * peak[n];
  }
  const double radius = Norm(peak[0] - centre);
  EXPECT_GT(radius, 50.0);
  const Vec2d expected[] = {{-radius, 0.0}, {0.0, radius}, {radius, 0.0}, {0.0, -radius}};
  for (std::size_t n = 0; n < 4; ++n) {
    EXPECT_LT(Norm(peak[n] - centre - expected[n]), 0.08 * radius) << n;
  }
}

// Also of spectra without directions: the top of the colour map is somewhere on the disc.
TEST(PolarPlot, AllKindsOfSpectraAreDrawn) {
  sea::BuoySpectrum buoy;
  buoy.frequency_hz = {0.05F, 0.1F, 0.15F};
  buoy.density_m2_per_hz = {0.0F, 10.0F, 1.0F};
  sea::GridSpectrum grid;
  grid.frequency_hz = {0.05F, 0.1F, 0.15F};
  grid.wave_to_rad = {0.0F, 1.5F, 3.0F, 4.5F};
  grid.density_m2_per_hz_rad = {0, 0, 0, 0, 1, 2, 1, 0, 0, 0.5F, 0, 0};
  const sea::WaveSystem systems[] = {buoy, grid, sea::PiersonMoskowitzSystem{},
                                     sea::ElfouhailySystem{}, sea::PhillipsSystem{}};
  for (const sea::WaveSystem& system : systems) {
    const Canvas canvas = DrawPolarPlot(system, {});
    const std::vector<std::uint8_t> rgb = canvas.Rgb();
    const Vec2d at = YellowestPixel(canvas);
    const std::size_t i = 3 * static_cast<std::size_t>(at.y * canvas.width() + at.x);
    EXPECT_GT(rgb[i + 1], 180) << system.index();
  }
}

TEST(PolarPlot, TitlesAndArrowAreDrawn) {
  const sea::WaveSystem system = Swell(0.0, 8.0);
  const auto bare = DrawPolarPlot(system, {}).Rgb();
  EXPECT_NE(bare, DrawPolarPlot(system, {"title", {}, {}}).Rgb());
  EXPECT_NE(bare, DrawPolarPlot(system, {"", {"Hs"}, {}}).Rgb());
  EXPECT_NE(bare, DrawPolarPlot(system, {"", {}, 45.0}).Rgb());
}

TEST(Canvas, GreyOfTheColourSpaceIsGrey) {
  const Colour white = FromLightnessChromaHue(1.0, 0.0, 0.0);
  EXPECT_NEAR(white.r, 1.0, 1e-3);
  EXPECT_NEAR(white.b, 1.0, 1e-3);
  // OKLab's lightness 0.5 is linear 0.125, in sRGB 0.3886.
  const Colour grey = FromLightnessChromaHue(0.5, 0.0, 123.0);
  EXPECT_NEAR(grey.r, 0.3886, 1e-3);
  EXPECT_NEAR(grey.g, grey.b, 1e-3);
}

TEST(Canvas, WhatLiesOutsideIsCutOff) {
  Canvas canvas(20, 10, {0, 0, 0});
  const Segment far[] = {{{-1e6, 5.0}, {1e6, 5.0}}, {{-50.0, -50.0}, {-40.0, -40.0}}};
  canvas.Stroke(far, 2.0, {1, 1, 1});
  canvas.Ring({10.0, 5.0}, 1e5, 3.0, {1, 1, 1});
  canvas.Text({15.0, 8.0}, 30.0, Align::kLeft, "cut", {1, 0, 0});
  canvas.Blend(-1, 3, {1, 1, 1}, 1.0);
  canvas.Blend(20, 3, {1, 1, 1}, 1.0);
  const std::vector<std::uint8_t> rgb = canvas.Rgb();
  ASSERT_EQ(rgb.size(), 600U);
  EXPECT_EQ(rgb[3 * (5 * 20 + 2)], 255);  // the long line
  EXPECT_EQ(rgb[3 * (9 * 20 + 2)], 0);
}

TEST(StrokeFont, EveryPrintableLetterAndDigitHasStrokes) {
  for (char c = '0'; c <= 'z'; ++c) {
    if (!std::isalnum(static_cast<unsigned char>(c))) continue;
    EXPECT_FALSE(TextStrokes({}, 12.0, std::string(1, c)).empty()) << c;
  }
  EXPECT_GT(TextWidth("WW", 12.0), TextWidth("ii", 12.0));
  EXPECT_EQ(TextWidth("", 12.0), 0.0);
  EXPECT_EQ(TextWidth("\xe6\xb5\xb7\xff", 12.0), 0.0);  // what it does not know
  EXPECT_NEAR(TextWidth("abc", 24.0), 2.0 * TextWidth("abc", 12.0), 1e-9);
}

}  // namespace
}  // namespace onesea::app
