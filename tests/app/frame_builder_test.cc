#include "client/app/frame_builder.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/sea/constants.h"

namespace onesea::client {
namespace {

std::shared_ptr<const sea::Components> Build(sea::SeaState state) {
  sea::Recipe recipe;
  recipe.cascades = sea::DefaultCascades();
  recipe.timeline.push_back({0, 0, std::move(state)});
  auto components = sea::BuildComponents(recipe);
  EXPECT_TRUE(components.ok()) << components.status().message();
  return *components;
}

TEST(FrameBuilder, FiguresAreTheSeas) {
  sea::SeaState state;
  sea::JonswapSystem system;
  system.hs_m = 2.5;
  system.tp_s = 9.0;
  state.systems.push_back(system);
  state.wind_speed_m_per_s = 8.0;
  FrameBuilder builder(64);
  render::RenderFrame frame;
  builder.Fill(Build(state), SimTime::FromSeconds(30.0), frame);
  const SeaFigures figures = builder.Figures();
  EXPECT_NEAR(figures.hs_m, 2.5, 0.03);
  EXPECT_NEAR(figures.tp_s, 9.0, 0.9);  // a bin is 0.01 Hz
  EXPECT_EQ(frame.cascades.size(), sea::DefaultCascades().size());
  EXPECT_DOUBLE_EQ(frame.weather.wind_speed_m_per_s, 8.0);
}

// The regular wave that the renderer gets is the one that queries answer with.
TEST(FrameBuilder, RegularWaveHasItsPhase) {
  sea::SeaState state;
  state.regular_waves.push_back(
      {.amplitude_m = 0.01, .period_s = 8.0, .wave_to_rad = 0.7, .phase_rad = 0.3});
  FrameBuilder builder(64);
  render::RenderFrame frame;
  builder.Fill(Build(state), SimTime::FromSeconds(12345.6), frame);
  ASSERT_EQ(frame.regular_waves.size(), 1U);
  const render::RegularWaveNow& wave = frame.regular_waves[0];
  EXPECT_NEAR(wave.amplitude_m, 0.01, 1e-9);
  for (double x : {0.0, 13.0, -40.0}) {
    // At 1 cm the choppy shift changes the height by less than k a² = 6e-6 m.
    const double expected = wave.amplitude_m * std::cos(wave.kx_rad_per_m * x + wave.phase_rad);
    EXPECT_NEAR(builder.HeightAt({x, 0.0}), expected, 2e-5);
  }
}

}  // namespace
}  // namespace onesea::client
