// Bodies and water give each other what they take.
#include <algorithm>
#include <cmath>

#include "common/sea/constants.h"
#include "tests/world/world_scene.h"

namespace onesea::world {
namespace {

constexpr double kRhoG = sea::kWaterDensityKgPerM3 * sea::kGravity;

// The highest of the layer at least `beyond_m` from the middle.
double HighestBeyond(const World& world, double beyond_m) {
  double highest = 0.0;
  for (const auto& field : world.view()->interaction->fields) {
    for (std::size_t n = 0; n < field->height_m.size(); ++n) {
      const auto column = static_cast<std::int64_t>(n) % field->cells.columns;
      const auto row = static_cast<std::int64_t>(n) / field->cells.columns;
      const Vec2d place =
          field->cells.PlaceOf(field->cells.west + column, field->cells.south + row);
      if (Norm(place) < beyond_m) continue;
      highest = std::max(highest, static_cast<double>(std::abs(field->height_m[n])));
    }
  }
  return highest;
}

// An hour in still water, with the layer's heights and velocities acting on the box that made
// them: no waves, no energy, no drift. Both ways of radiation, at 30 ticks a second.
TEST(WorldCoupling, ABoxAtRestMakesNoWavesForAnHour) {
  for (const auto radiation : {wire::Radiation::kCoefficients, wire::Radiation::kGrid}) {
    WorldOptions options;
    options.tick_rate_hz = 30;
    World world(options);
    wire::RegionSpec region = Square(64);
    ASSERT_TRUE(world.Apply(wire::AddRegion{region}).ok());
    wire::BodyDescription box = Box({3, 2, 1}, 2500.0);
    box.radiation = radiation;
    const auto prepared = PrepareBody(box);
    ASSERT_TRUE(world.Spawn(*prepared, AfloatAt({0, 0})).ok());
    const auto calm = Calm();
    Tick tick = 0;
    const auto run = [&](double seconds) {
      double highest = 0.0, fastest = 0.0;
      for (int n = 0; n < static_cast<int>(seconds * 30); ++n) {
        world.Step(++tick, calm);
        const wire::BodyState& state = world.view()->bodies[0].state;
        fastest =
            std::max(fastest, std::max(Norm(state.velocity_m_per_s), Norm(state.spin_rad_per_s)));
        if (n % 30 == 0) highest = std::max(highest, HighestBeyond(world, 5.0));
      }
      return std::pair(highest, fastest);
    };
    run(300.0);  // it came as suddenly as it was spawned
    const auto early = run(600.0);
    run(2100.0);
    const auto late = run(600.0);
    EXPECT_LT(early.first, 1e-3);
    EXPECT_LT(late.first, std::max(early.first, 2e-4));
    EXPECT_LT(late.second, std::max(early.second, 1e-3));
    // It comes to lie between two cells, where the layer is the same on both sides of it.
    const wire::BodyState& state = world.view()->bodies[0].state;
    EXPECT_LT(std::hypot(state.position_m.x, state.position_m.y), 0.26);
  }
}

// A capsule is towed through still water. The momentum of the waves that it makes, ρ ∫ η u dA, is
// what the pressure of the layer took from it. (Friction and form drag go into eddies, which the
// layer doesn't know.) The hull feels less than it gives, 0.87 of it here: the water under it is
// sampled every half radius, which cuts across the shorter waves.
TEST(WorldCoupling, WavesHaveTheMomentumThatTheBodyLost) {
  World world{WorldOptions{}};
  ASSERT_TRUE(world.Apply(wire::AddRegion{Square(320)}).ok());
  wire::BodyDescription capsule;
  capsule.shape =
      wire::BodyShape{.kind = wire::ShapeKind::kCapsule, .radius_m = 0.9, .length_m = 5.0};
  capsule.mass_kg = 0.45 * sea::kWaterDensityKgPerM3 * sea::kPi * 0.81 * (5.0 + 1.2);
  capsule.control = wire::BodyControl::kByOwner;
  capsule.drag = wire::Drag{.friction = 0.0, .pressure = 0.0, .suction = 0.0};
  // Pressure alone: nothing of coefficients.
  capsule.added_mass.emplace().fill(0.0);
  capsule.viscous_damping.emplace().fill(0.0);
  capsule.radiation_damping.emplace().fill(0.0);
  const auto prepared = PrepareBody(capsule);
  ASSERT_TRUE(prepared.ok()) << prepared.status();
  const double z = prepared->model->rest.centre_height_m;
  const auto calm = Calm();
  Tick tick = 0;
  wire::BodyPose pose;
  pose.body_id = *world.Spawn(*prepared, AfloatAt({-25, 0}));
  pose.state.position_m = {-25, 0, z};
  const auto step = [&](double speed) {
    pose.state.velocity_m_per_s = {speed, 0, 0};
    const auto wrenches = world.SetPoses({&pose, 1}, calm);
    EXPECT_TRUE(wrenches.ok()) << wrenches.status();
    world.Step(++tick, calm);
    pose.state.position_m.x += speed / 60.0;
    return wrenches->front().force_n.x;
  };
  for (int n = 0; n < 2400; ++n) step(0.0);
  double lost_n_s = 0.0;
  for (int n = 0; n < 600; ++n) lost_n_s -= step(std::min(4.5, n / 60.0 * 2.0)) / 60.0;
  const sea::InteractionField& field = *world.view()->interaction->fields[0];
  double waves_n_s = 0.0, energy_j = 0.0;
  const double cell_m2 = field.cells.cell_m * field.cells.cell_m;
  for (std::size_t n = 0; n < field.height_m.size(); ++n) {
    waves_n_s += sea::kWaterDensityKgPerM3 * cell_m2 * field.height_m[n] * field.flow->x[n];
    energy_j += 0.5 * kRhoG * cell_m2 * field.height_m[n] * field.height_m[n];
  }
  EXPECT_GT(lost_n_s, 200.0);
  EXPECT_GT(energy_j, 1000.0);
  EXPECT_GT(lost_n_s / waves_n_s, 0.8);
  EXPECT_LT(lost_n_s / waves_n_s, 1.05);
}

// Water that a hull presses away is found around it, all of it.
TEST(WorldCoupling, WaterThatMakesRoomIsFoundAround) {
  InteractionLayer layer({.depth_m = 4.0, .edge_cells = 0});
  const std::vector<RegionAsk> asks{{.id = 1, .columns = 128, .rows = 128, .centre_m = {}}};
  ASSERT_TRUE(layer.Place(asks).ok());
  const double volume_m3 = 6.0;
  for (int n = 0; n < 600; ++n) {
    const double share = std::min(1.0, n / 300.0);
    EXPECT_TRUE(layer.AddPressure({3, -2}, 3.0, share * volume_m3 * kRhoG));
    layer.Step();
    if (n % 50 != 49) continue;
    double sum = 0.0, under = 0.0;
    const auto snapshot = layer.Snapshot(n);
    for (const float height : snapshot->fields[0]->height_m) sum += 0.25 * height;
    for (double x = -0.5; x <= 6.5; x += 0.5) {
      for (double y = -5.5; y <= 1.5; y += 0.5) {
        under -= 0.25 * sea::SampleInteraction(*snapshot, {x, y}).height_m;
      }
    }
    EXPECT_NEAR(sum, 0.0, 1e-3) << n;
    if (n < 350) continue;
    EXPECT_NEAR(under, volume_m3, 0.25 * volume_m3) << n;
  }
}

}  // namespace
}  // namespace onesea::world
