#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "server/world/world.h"
#include "tests/sea/fake_sea.h"

/// A world on a calm sea, with a few bodies.
namespace onesea::world {

inline std::shared_ptr<const sea::Components> Calm() {
  return sea::FakeSea({.lengths_m = {97.0}, .index_max = 4, .hs_m = 1e-6, .query_grid_size = 64});
}

inline wire::BodyDescription Box(Vec3d size_m, double mass_kg) {
  wire::BodyDescription body;
  body.name = "box";
  body.shape = wire::BodyShape{.kind = wire::ShapeKind::kBox, .size_m = size_m};
  body.mass_kg = mass_kg;
  body.centre_of_mass_m = Vec3d{0, 0, -0.2 * size_m.z};
  return body;
}

inline wire::BodyDescription Boat() {
  wire::BodyDescription boat = Box({6.0, 2.0, 1.0}, 3000.0);
  boat.drag = wire::Drag{.friction = 0.004, .pressure = 0.3, .suction = 0.2};
  wire::Thruster thruster;
  thruster.position_m = {-2.5, 0, -0.3};
  thruster.diameter_m = 0.5;
  thruster.steer_rad_max = 0.5;
  boat.thrusters.push_back(thruster);
  return boat;
}

inline wire::RegionSpec Square(int cells, std::uint32_t follow_body_id = 0) {
  wire::RegionSpec region;
  region.columns = region.rows = cells;
  region.follow_body_id = follow_body_id;
  return region;
}

inline wire::Kinematics AfloatAt(Vec2d place) {
  wire::Kinematics start;
  start.position_m = {place.x, place.y, 0.0};
  return start;
}

class WorldTest : public ::testing::Test {
 protected:
  std::uint32_t Spawn(const wire::BodyDescription& body, Vec2d place = {}) {
    const auto prepared = PrepareBody(body);
    EXPECT_TRUE(prepared.ok()) << prepared.status();
    const auto id = world_.Spawn(*prepared, AfloatAt(place));
    EXPECT_TRUE(id.ok()) << id.status();
    return *id;
  }
  void AddRegion(const wire::RegionSpec& spec) {
    const auto id = world_.Apply(wire::AddRegion{spec});
    ASSERT_TRUE(id.ok()) << id.status();
  }
  void Run(int ticks) {
    for (int n = 0; n < ticks; ++n) world_.Step(++tick_, calm_);
  }
  const wire::BodyState& StateOf(std::uint32_t id) {
    for (const wire::BodyView& body : world_.view()->bodies) {
      if (body.state.id == id) return body.state;
    }
    ADD_FAILURE() << "no body " << id;
    static const wire::BodyState none;
    return none;
  }
  double HeightAt(Vec2d place) {
    return sea::SampleInteraction(*world_.view()->interaction, place).height_m;
  }

  std::shared_ptr<const sea::Components> calm_ = Calm();
  Tick tick_ = 0;
  World world_{WorldOptions{}};
};

}  // namespace onesea::world
