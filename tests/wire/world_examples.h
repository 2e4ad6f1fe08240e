#pragma once

#include <cmath>
#include <memory>

#include "common/wire/world_command.h"
#include "common/wire/world_update.h"

/// Domain objects of the world with every field used.
namespace onesea::wire {

inline BodyDescription FullBody() {
  BodyDescription body;
  body.preset = "work-boat";
  body.name = "tug";
  body.owner = "harbour";
  body.colour_rgb = 0xFF8000;
  body.control = BodyControl::kByOwner;
  body.radiation = Radiation::kGrid;
  body.shape =
      BodyShape{.kind = ShapeKind::kMesh, .mesh = "solid tug", .mesh_hash = MeshHash("solid tug")};
  body.mass_kg = 12345.6;
  body.centre_of_mass_m = Vec3d{0.1, -0.2, 0.3};
  body.inertia_kg_m2 = {1.0, 0.1, 0.2, 0.1, 2.0, 0.3, 0.2, 0.3, 3.0};
  body.added_mass.emplace().fill(1.5);
  body.radiation_damping.emplace().fill(2.5);
  body.viscous_damping.emplace().fill(3.5);
  body.quadratic_damping.emplace().fill(4.5);
  body.drag = Drag{0.01, 0.7, 0.5, 1.2};
  body.windage = Windage{3.0, 9.0, 0.9, 1.1, {0.0, 0.0, 2.0}};
  body.thrusters = {{{-3.0, 0.5, -1.0}, {1.0, 0.1, 0.0}, 0.8, 12.0, 0.3, 0.35, 1.5, 0.4}, {}};
  body.rudders = {{{-3.5, 0.0, -1.0}, 0.7, 1.8, 0.5, 0.9, 1}, {}};
  body.contact_friction = 0.6;
  body.contact_restitution = 0.2;
  return body;
}

inline Kinematics FullKinematics() {
  return {{1.0 / 3.0, -20.0, 0.5}, TurnBy({0.1, 0.2, 0.3}), {1.0, 2.0, 3.0}, {0.1, 0.2, -0.3}};
}

inline RegionSpec FullRegion() {
  return {.solver = RegionSolver::kShallowWater,
          .middle_m = {12.5, -7.25},
          .columns = 128,
          .rows = 96,
          .cell_m = 0.75,
          .follow_body_id = 1,
          .damping_per_s = 0.02,
          .height_step_m = 4e-3,
          .frames_per_update = 3,
          .rain_drops_per_m2_s = 0.25,
          .rest_after_s = 90.0};
}

inline WorldUpdate FullUpdate() {
  WorldUpdate update;
  update.tick = 600;
  update.tiles.layout = std::vector<RegionLayout>{
      {.id = 3,
       .cells = {.west = -64, .south = 1'000'000, .columns = 96, .rows = 64, .cell_m = 0.5},
       .height_step_m = 2e-3}};
  update.tiles.blobs = {"one", std::string("\0\1", 2)};
  update.bodies.removed_ids = {7, 300};
  BodyInfo info;
  info.id = 9;
  info.name = "buoy";
  info.owner = "harbour";
  info.colour_rgb = 0xFF0000;
  info.shape.kind = ShapeKind::kCylinder;
  info.shape.radius_m = 0.4;
  info.shape.length_m = 1.5;
  info.centre_of_mass_m = {0.0, 0.0, -0.3};
  info.mass_kg = 90.0;
  update.bodies.infos = {std::make_shared<const BodyInfo>(info)};
  update.bodies.states = "states";
  update.water_level_m = 1.25;
  update.spray = {{{1.0, 2.0, 0.5}, {0.0, 1.0, 3.0}, 2.5}};
  update.ropes = std::make_shared<const std::vector<TiedRope>>(std::vector<TiedRope>{
      {3, {{9, {0.0, 0.0, -0.45}}, {0, {330.0, -330.0, -16.0}}, 18.0, 3000.0, 300.0}},
      {12, {{4, {-3.0, 0.0, 0.5}}, {9, {0.5, 0.25, 0.0}}, 25.0, 1e4, 1e3}}});
  return update;
}

}  // namespace onesea::wire
