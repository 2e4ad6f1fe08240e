#include "server/world/body_spec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "absl/strings/match.h"
#include "server/world/body_from_wire.h"
#include "server/world/body_presets.h"
#include "server/world/hull_shapes.h"

namespace onesea::world {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// What a change of a good body is refused for; empty: not at all.
std::string Refusal(auto change) {
  BodySpec spec = *FromWire(*BodyPreset("work-boat"));
  change(spec);
  return std::string(ValidateBodySpec(spec).message());
}

TEST(BodySpec, RefusalsNameTheField) {
  EXPECT_EQ(Refusal([](BodySpec&) {}), "");
  const auto named = [](const char* field, auto change) {
    const std::string message = Refusal(change);
    EXPECT_TRUE(absl::StrContains(message, field)) << field << ": \"" << message << "\"";
  };
  named("mass_kg = 0 ", [](BodySpec& s) { s.mass_kg = 0; });
  named("mass_kg", [](BodySpec& s) { s.mass_kg = kNan; });
  named("mass_kg", [](BodySpec& s) { s.mass_kg = -1; });
  named("denser", [](BodySpec& s) { s.mass_kg = 1e8; });
  named("open edges", [](BodySpec& s) { s.shape.mesh.triangles.pop_back(); });
  named("shape.size_m", [](BodySpec& s) {
    s.shape = {.kind = ShapeKind::kBox, .size_m = {1, kNan, 1}};
  });
  named("shape.radius_m",
        [](BodySpec& s) { s.shape = {.kind = ShapeKind::kSphere, .radius_m = 1e9}; });
  named("shape.kind", [](BodySpec& s) { s.shape.kind = static_cast<ShapeKind>(77); });
  named("centre_of_mass_m", [](BodySpec& s) { s.centre_of_mass_m = Vec3d{0, kNan, 0}; });
  named("inertia_kg_m2", [](BodySpec& s) { s.inertia_kg_m2 = Mat3d{}; });
  named("inertia_kg_m2", [](BodySpec& s) {
    s.inertia_kg_m2 = Mat3d{{1, 0, 0, 0, -1, 0, 0, 0, 1}};
  });
  named("added_mass is not symmetric", [](BodySpec& s) {
    s.added_mass.emplace();
    for (int i = 0; i < 6; ++i) (*s.added_mass)[i][i] = 10;
    (*s.added_mass)[0][4] = 5;
  });
  named("added_mass has a direction", [](BodySpec& s) {
    s.added_mass.emplace();
    (*s.added_mass)[2][2] = -10;
  });
  named("viscous_damping[1][1]", [](BodySpec& s) {
    s.viscous_damping.emplace();
    (*s.viscous_damping)[1][1] = kNan;
  });
  named("drag.pressure", [](BodySpec& s) { s.drag.pressure = -1; });
  named("windage.lateral_area_m2", [](BodySpec& s) { s.windage.lateral_area_m2 = kNan; });
  named("thrusters[0].diameter_m", [](BodySpec& s) { s.thrusters[0].diameter_m = 0; });
  named("thrusters[0].direction", [](BodySpec& s) { s.thrusters[0].direction = {0, 0, 0}; });
  named("thrusters (count)", [](BodySpec& s) { s.thrusters.resize(9, s.thrusters[0]); });
  named("rudders[0].behind_thruster", [](BodySpec& s) { s.rudders[0].behind_thruster = 1; });
  named("rudders[1].aspect_ratio", [](BodySpec& s) { s.rudders[1].aspect_ratio = 0; });
  named("control", [](BodySpec& s) { s.control = static_cast<BodyControl>(0); });
  named("radiation", [](BodySpec& s) { s.radiation = static_cast<Radiation>(9); });
  named("heave_memory", [](BodySpec& s) { s.heave_memory.kernel = {1, kNan}; });
}

// Every shape becomes a model with figures that make sense, floating or not.
TEST(BodySpec, ShapesBecomeModels) {
  for (const ShapeKind kind :
       {ShapeKind::kBox, ShapeKind::kSphere, ShapeKind::kCylinder, ShapeKind::kCapsule}) {
    for (const double mass : {0.5, 100.0, 3000.0}) {
      BodySpec spec;
      spec.shape.kind = kind;
      spec.mass_kg = mass;
      const auto model = MakeBodyModel(spec);
      ASSERT_TRUE(model.ok()) << model.status();
      for (int i = 0; i < 6; ++i) {
        EXPECT_GE((*model)->added_at_rest[i][i], 0.0);
        EXPECT_GE((*model)->added_submerged[i][i], 0.0);
        EXPECT_GE((*model)->viscous_damping[i][i], 0.0);
      }
      EXPECT_EQ((*model)->rest.floats, mass < 1025 * (*model)->solid.volume_m3);
      EXPECT_GT((*model)->added_at_rest[2][2], 0.0);
    }
  }
}

// A half-sunk sphere has 1/2 of its displacement; the mirrored ellipsoid is exact there.
TEST(BodySpec, SphereHasItsAddedMass) {
  BodySpec spec;
  spec.shape.kind = ShapeKind::kSphere;
  spec.mass_kg = 0.5 * 1025 * 4.0 / 3 * sea::kPi * 0.125;
  const auto model = *MakeBodyModel(spec);
  for (int i : {0, 1, 2}) EXPECT_NEAR(model->added_at_rest[i][i] / spec.mass_kg, 0.5, 0.01);
}

TEST(Propulsion, LagsAndPullsAsItsCurveSays) {
  const wire::Thruster thruster{.diameter_m = 0.5, .turns_per_s_max = 10, .lag_s = 2};
  DriveCommand command;
  command.throttle[0] = 5;  // cut at 1
  DriveState state;
  for (int n = 0; n < 120; ++n) AdvanceDrive({&thruster, 1}, {}, command, 1.0 / 60, state);
  EXPECT_NEAR(state.turns_per_s[0], 10 * (1 - std::exp(-1.0)), 1e-9);
  state.turns_per_s[0] = 10;
  const WaterPatch calm;
  const auto thrust = [&](double speed, double z) {
    return Propel({&thruster, 1}, {}, state, {}, {{0, 0, z}, {}}, {speed, 0, 0}, {},
                  WaterSampler(calm), 1000)
        .force_n.x;
  };
  EXPECT_NEAR(thrust(0, -2), 1000 * 0.0625 * 100 * 0.35, 1e-9);
  EXPECT_NEAR(thrust(10 * 0.5 * 0.35 / 0.4, -2), 0.0, 1e-9);  // J where K_T is 0
  EXPECT_EQ(thrust(0, 2), 0.0);                               // in the air
}

// Fujii's slope at a small angle, side and sign: positive turns the boat to port.
TEST(Propulsion, RudderLiftsAsItsAspectRatioSays) {
  const wire::Rudder rudder{.position_m = {-3, 0, -1}, .area_m2 = 0.2, .aspect_ratio = 1.5};
  DriveState state;
  state.rudder_rad[0] = 0.1;
  const WaterPatch calm;
  const PropulsionForces got = Propel({}, {&rudder, 1}, state, {}, {{0, 0, -2}, {}}, {4, 0, 0}, {},
                                      WaterSampler(calm), 1000);
  const double normal = 0.5 * 1000 * 0.2 * 16 * 6.13 * 1.5 / (1.5 + 2.25) * std::sin(0.1);
  EXPECT_NEAR(got.force_n.y, -normal * std::cos(0.1), 1e-6 * normal);
  EXPECT_NEAR(got.force_n.x, -normal * std::sin(0.1), 1e-6 * normal);
  EXPECT_GT(got.torque_n_m.z, 0.0);
}

}  // namespace
}  // namespace onesea::world
