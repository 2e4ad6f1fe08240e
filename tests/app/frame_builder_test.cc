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

// Wakes come with their place, add to the height, and keep their version while they do not change.
TEST(FrameBuilder, WakesAddToThePictureAndToTheHeight) {
  sea::InteractionField field;
  field.cells = {-4, 10, 12, 8, 0.5};
  field.height_m.assign(field.cells.cells(), 0.25f);
  const auto still = std::make_shared<const sea::InteractionField>(field);
  const auto snapshot = std::make_shared<const sea::InteractionSnapshot>(
      sea::InteractionSnapshot{1, {still, std::make_shared<const sea::InteractionField>(field)}});
  const auto components = Build({});
  FrameBuilder builder(64);
  render::RenderFrame frame;
  const Vec2d place{0.5, 7.0};
  builder.Fill(components, SimTime::FromSeconds(3.0), frame);
  EXPECT_TRUE(frame.patches.empty());
  const double calm = builder.HeightAt(place);
  builder.SetInteraction(snapshot);
  builder.Fill(components, SimTime::FromSeconds(3.0), frame);
  ASSERT_EQ(frame.patches.size(), 2U);
  EXPECT_EQ(frame.patches[0].first_cell_m, (Vec2d{-2.0, 5.0}));
  EXPECT_EQ(frame.patches[0].columns, 12);
  EXPECT_EQ(frame.patches[0].height_m.data(), still->height_m.data());
  EXPECT_NEAR(builder.HeightAt(place), calm + 0.5, 1e-6);

  const std::uint64_t before = frame.patches[0].version, other = frame.patches[1].version;
  EXPECT_NE(before, other);
  builder.SetInteraction(std::make_shared<const sea::InteractionSnapshot>(
      sea::InteractionSnapshot{2, {std::make_shared<const sea::InteractionField>(field), still}}));
  builder.Fill(components, SimTime::FromSeconds(3.1), frame);
  EXPECT_EQ(frame.patches[1].version, before);
  EXPECT_NE(frame.patches[0].version, before);
  EXPECT_NE(frame.patches[0].version, other);
  builder.SetInteraction(nullptr);
  builder.Fill(components, SimTime::FromSeconds(3.2), frame);
  EXPECT_TRUE(frame.patches.empty());
}

}  // namespace
}  // namespace onesea::client
